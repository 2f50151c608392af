// Shading normals of displacement textures and normal maps against closed forms, on every
// kind of shape; footprints of pixels.
#include <catch2/catch.hpp>

#include "kernels/stages.h"
#include "src/base/core/pi.h"
#include "src/scene/prepare/prepared_scene.h"
#include "tests/kernels/surface/bump_files.h"
#include "tests/reference/bump_maps.h"
#include "tests/reference/scenes.h"
#include "tests/support/each_target.h"
#include "tests/support/wave_fixture.h"

namespace lanelight::test {
namespace {

// Surfaces at the ends of rays, all of which hit: rays are given in the world.
class Surfaces {
 public:
  Surfaces(const SceneDescription& description, const std::vector<TestRay>& rays)
      : scene_(PrepareScene(description)),
        fixture_(scene_.Parts(), static_cast<std::uint32_t>(rays.size())) {
    FeatureSet features = scene_.compiled->features;
    features.Add(Feature::kScatters);
    std::vector<TestRay> moved = rays;
    for (TestRay& ray : moved) {
      const Vec3d o = VecCast<double>(ray.o);
      ray.o = VecCast<float>((o - scene_.compiled->center) * scene_.compiled->scale);
      ray.d = Normalize(ray.d);
    }
    fixture_.SetRays(moved);
    Run({IntersectTrianglesStage, IntersectSpheresStage, IntersectDisksStage,
         IntersectPlanesStage},
        features);
    fixture_.QueueAll(QueueId::kSurface, static_cast<std::uint32_t>(rays.size()));
    Run({SurfaceTriangleStage, SurfaceSphereStage, SurfaceDiskStage, SurfacePlaneStage,
         FootprintsStage, BumpsStage, NormalMapsStage},
        features);
  }
  Vec3d Ns(std::uint32_t i) const { return VecCast<double>(fixture_.Ns(i)); }
  Vec3d Ng(std::uint32_t i) const { return VecCast<double>(fixture_.Ng(i)); }
  Vec3d World(std::uint32_t i) const {
    return VecCast<double>(fixture_.P(i)) * (1 / scene_.compiled->scale) +
           scene_.compiled->center;
  }
  const PathColumns& path() const { return fixture_.wave.path; }
  const CompiledScene& scene() const { return *scene_.compiled; }

 private:
  void Run(const std::vector<StageOn>& stages, const FeatureSet& features) {
    for (const StageOn stage : stages) {
      if (features.HasAll(stage(TestTarget()).needs)) fixture_.Run(stage, features);
    }
  }
  PreparedScene scene_;
  WaveFixture fixture_;
};

constexpr double kA = 0.9, kB = -0.6;  // slopes of the ramp in u and v

// A builder with a diffuse material whose height is kA u + kB v times `scale`.
struct Ramp {
  TemporaryFolder folder;
  SceneBuilder b{16, 16};
  Index material;

  explicit Ramp(double scale = 1) {
    WriteGreyImage(folder.File("ramp.exr"), 64,
                   [](double u, double v) { return 1 + kA * u + kB * v; });
    Material m;
    m.displacement.texture = AddHeights(b.scene(), folder.File("ramp.exr"));
    b.scene().textures.back().scale = scale;
    material = b.AddMaterial(m);
    b.Perspective({0.5, 0.5, 20}, {0.5, 0.5, 0}, {0, 1, 0}, 30);
    b.AddPoint({0, 0, 9}, {1, 1, 1});
  }
};

// Rays straight down to points of [lo, hi]^2.
std::vector<TestRay> Down(float lo, float hi, float z = 5) {
  std::vector<TestRay> rays;
  for (int i = 0; i < 25; ++i) {
    const float x = lo + (hi - lo) * static_cast<float>(i % 5) / 4;
    const float y = lo + (hi - lo) * static_cast<float>(i / 5) / 4;
    rays.push_back({{x, y, z}, {0, 0, -1}});
  }
  return rays;
}

void CheckNormals(const Surfaces& s, const std::function<Vec3d(Vec3d)>& expected) {
  for (std::uint32_t i = 0; i < 25; ++i) {
    const Vec3d n = s.Ns(i), e = expected(s.World(i));
    INFO("ray " << i << ": " << n.x << " " << n.y << " " << n.z << ", not " << e.x << " "
                << e.y << " " << e.z);
    CHECK(Length(n - e) < 2e-3);
    CHECK(std::abs(Length(n) - 1) < 1e-5);
  }
}

}  // namespace

TEST_CASE("a ramp tilts the normal by the angle of its slope", "[relief]") {
  const EachTarget target;
  Ramp ramp;
  ramp.b.AddQuad({0, 0, 0}, {2, 0, 0}, {0, 3, 0}, ramp.material);
  const Surfaces s(ramp.b.Build(), Down(0.2f, 1.6f));
  const Vec3d n = Normalize(Vec3d{-kA / 2, -kB / 3, 1});
  CheckNormals(s, [&](Vec3d) { return n; });
}

TEST_CASE("bump heights are lengths in world space at every scale", "[relief]") {
  for (const double unit : {1e-3, 1000.0}) {
    CAPTURE(unit);
    Ramp ramp(unit);
    ramp.b.Perspective({0, 0, 20 * unit}, {0, 0, 0}, {0, 1, 0}, 30);
    ramp.b.AddQuad({0, 0, 0}, {2 * unit, 0, 0}, {0, 2 * unit, 0}, ramp.material);
    std::vector<TestRay> rays = Down(0.4f, 1.6f);
    for (TestRay& ray : rays) {
      ray.o = ray.o * static_cast<float>(unit);
    }
    const Surfaces s(ramp.b.Build(), rays);
    CHECK(s.scene().scale != 1);
    CheckNormals(s, [&](Vec3d) { return Normalize(Vec3d{-kA / 2, -kB / 2, 1}); });
  }
}

TEST_CASE("bumps of spheres, disks and planes", "[relief]") {
  SECTION("sphere") {
    Ramp ramp(0.4);
    ramp.b.AddSphere({0.9, 0.9, 0}, 2, ramp.material);
    const Surfaces s(ramp.b.Build(), Down(1.1f, 1.7f));
    CheckNormals(s, [](Vec3d p) {
      const Vec3d out = Normalize(p - Vec3d{0.9, 0.9, 0});
      const double across = std::hypot(out.x, out.y);
      const Vec3d east = {-out.y / across, out.x / across, 0}, north = Cross(out, east);
      return Normalize(out - east * (0.4 * kA / (4 * kPi * across)) -
                       north * (0.4 * kB / (2 * kPi)));
    });
  }
  SECTION("disk") {
    Ramp ramp(0.4);
    Shape& disk = ramp.b.AddDisk({0, 0, 0}, {0, 0, 1}, 3, ramp.material);
    disk.world_from_object = Transform();
    disk.inner_radius = 0.1;
    const Surfaces s(ramp.b.Build(), Down(0.4f, 1.7f));
    CheckNormals(s, [](Vec3d p) {
      const double r = std::hypot(p.x, p.y);
      const Vec3d out = {p.x / r, p.y / r, 0}, around = {-out.y, out.x, 0};
      return Normalize(Vec3d{0, 0, 1} - around * (0.4 * kA / (2 * kPi * r)) +
                       out * (0.4 * kB / 2.9));
    });
  }
  SECTION("plane") {
    Ramp ramp;
    Shape& plane = ramp.b.AddPlane({0, 0, 0}, {0, 0, 1}, ramp.material);
    plane.world_from_object = Transform::Scale({2, 3, 1});
    const Surfaces s(ramp.b.Build(), Down(0.2f, 1.6f));
    CheckNormals(s, [](Vec3d) { return Normalize(Vec3d{-kA / 2, -kB / 3, 1}); });
  }
}

TEST_CASE("meshes with normals are bumped along orthogonal axes, as in pbrt",
          "[relief]") {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 0}};
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.normals.assign(4, {0, 0, 1});
  mesh.indices = {0, 1, 2, 0, 2, 3};
  Ramp ramp;
  SECTION("in the world") {
    ramp.b.AddMesh(mesh, ramp.material);
    const Surfaces s(ramp.b.Build(), Down(0.2f, 1.6f));
    CheckNormals(s, [](Vec3d) { return Normalize(Vec3d{-kA / 2, -kB / 2, 1}); });
  }
  SECTION("with coordinates that turn the other way round, v has the wrong sign") {
    mesh.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    ramp.b.AddMesh(mesh, ramp.material);
    const Surfaces s(ramp.b.Build(), Down(0.2f, 1.6f));
    CheckNormals(s, [](Vec3d) { return Normalize(Vec3d{-kA / 2, -kB / 2, 1}); });
  }
  SECTION("in an instance that mirrors") {
    ramp.b.AddMesh(mesh, ramp.material);
    ObjectDefinition object;
    object.shapes = ramp.b.scene().shapes;
    ramp.b.scene().shapes.clear();
    ramp.b.scene().objects.push_back(object);
    Instance instance;
    instance.object = 0;
    instance.world_from_object = Transform::Scale({1, -1, 1});
    ramp.b.scene().instances = {instance, instance};
    ramp.b.scene().instances[1].world_from_object = Transform::Translate({0, 0, -5});
    std::vector<TestRay> rays = Down(0.2f, 1.6f);
    for (TestRay& ray : rays) ray.o.y = -ray.o.y;
    const Surfaces s(ramp.b.Build(), rays);
    CheckNormals(s, [](Vec3d) { return Normalize(Vec3d{-kA / 2, kB / 2, 1}); });
  }
}

TEST_CASE("seen from behind, the bumped normal stays on the outer side", "[relief]") {
  Ramp ramp;
  ramp.b.AddQuad({0, 0, 0}, {2, 0, 0}, {0, 3, 0}, ramp.material);
  std::vector<TestRay> rays = Down(0.2f, 1.6f, -5);
  for (TestRay& ray : rays) ray.d = {0, 0, 1};
  const Surfaces s(ramp.b.Build(), rays);
  CheckNormals(s, [](Vec3d) { return Normalize(Vec3d{-kA / 2, -kB / 3, 1}); });
}

TEST_CASE("a normal map of one colour gives one normal", "[relief]") {
  TemporaryFolder folder;
  WriteColorImage(folder.File("n.exr"), {0.7, 0.4, 0.9});
  SceneBuilder b(16, 16);
  Material m;
  m.normal_map = folder.File("n.exr");
  b.Perspective({0.5, 0.5, 20}, {0.5, 0.5, 0}, {0, 1, 0}, 30);
  // u runs along y, v along -x.
  b.AddQuad({2, 0, 0}, {0, 3, 0}, {-2, 0, 0}, b.AddMaterial(m));
  b.AddPoint({0, 0, 9}, {1, 1, 1});
  const Surfaces s(b.Build(), Down(0.2f, 1.6f));
  const Vec3d local = Normalize(Vec3d{0.4, -0.2, 0.8});
  CheckNormals(s, [&](Vec3d) { return Vec3d{-local.y, local.x, local.z}; });
  CHECK(s.scene().materials.displacement_texture.empty());
}

TEST_CASE("shading normals are rotated until they face the viewer", "[relief]") {
  const bool metal = GENERATE(false, true);
  CAPTURE(metal);
  TemporaryFolder folder;
  WriteColorImage(folder.File("n.exr"), {0.99, 0.5, 0.6});  // 78 degrees toward +x
  SceneBuilder b(16, 16);
  Material m;
  if (metal) {
    m.kind = MaterialKind::kConductor;
    m.eta.constant = {0.2, 0.9, 1.1};
    m.k.constant = {3.9, 2.5, 2.2};
  }
  m.normal_map = folder.File("n.exr");
  b.Perspective({0.5, 0.5, 20}, {0.5, 0.5, 0}, {0, 1, 0}, 30);
  b.AddQuad({-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, b.AddMaterial(m));
  b.AddPoint({0, 0, 9}, {1, 1, 1});
  std::vector<TestRay> rays;
  for (int i = 0; i < 64; ++i) {
    const float angle = 0.02f + 3.1f * static_cast<float>(i) / 64;
    const Vec3f to_viewer = {std::cos(angle), 0.1f, std::sin(angle)};
    rays.push_back({to_viewer * 4.0f, -to_viewer});
  }
  const Surfaces s(b.Build(), rays);
  const Vec3d tilted = Normalize(Vec3d{0.98, 0, 0.2});
  int turned = 0, kept = 0;
  for (std::uint32_t i = 0; i < 64; ++i) {
    const Vec3d wo = -VecCast<double>(Normalize(rays[i].d)), n = s.Ns(i);
    const Vec3d mirrored = 2 * Dot(n, wo) * n - wo;
    CHECK(Dot(n, wo) >= 1.0 / 64 - 1e-5);
    CHECK(Dot(n, s.Ng(i)) > 0);
    if (metal) CHECK(mirrored.z >= std::min(1.0 / 64, wo.z) - 1e-5);
    const Vec3d from_tilted = 2 * Dot(tilted, wo) * tilted - wo;
    const bool valid = Dot(tilted, wo) > 1.0 / 64 && (!metal || from_tilted.z > 0.02);
    if (valid) CHECK(Length(n - tilted) < 1e-4);
    (valid ? kept : turned) += 1;
  }
  CHECK(kept > 5);
  CHECK(turned > 5);
}

TEST_CASE("footprints equal those of the camera's pixels", "[relief]") {
  for (const bool perspective : {true, false}) {
    CAPTURE(perspective);
    Ramp ramp;
    ramp.b.scene().sampler.spp = 9;
    if (perspective) {
      ramp.b.Perspective({3, -4, 5}, {0.8, 1, 0}, {0, 0, 1}, 50);
    } else {
      ramp.b.Orthographic({3, -4, 5}, {0.8, 1, 0}, {0, 0, 1}, 3);
    }
    ramp.b.AddQuad({0, 0, 0}, {2, 0, 0.3}, {0.5, 3, 0}, ramp.material);
    const Surfaces s(ramp.b.Build(), Down(0.6f, 1.6f));
    const PathColumns& p = s.path();
    for (std::uint32_t i = 0; i < 25; ++i) {
      reference::SurfacePoint at;
      at.p = s.World(i);
      at.ng = s.Ng(i);
      at.dpdu = {2, 0, 0.3};
      at.dpdv = {0.5, 3, 0};
      const reference::UvSteps half = reference::HalfFootprint(ramp.b.scene(), at);
      const double u = (std::abs(p.footprint_0[i]) + std::abs(p.footprint_1[i])) / 2;
      const double v = (std::abs(p.footprint_2[i]) + std::abs(p.footprint_3[i])) / 2;
      CHECK(u == Approx(half.u).epsilon(1e-3));
      CHECK(v == Approx(half.v).epsilon(1e-3));
    }
  }
}

}  // namespace lanelight::test
