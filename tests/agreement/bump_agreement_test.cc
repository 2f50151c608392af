// Images of bump and normal maps against the reference tracer; how much light bumps lose;
// scenes without them have nothing of them.
#include <catch2/catch.hpp>
#include <set>

#include "src/render/plan/plan.h"
#include "tests/agreement/agreement.h"
#include "tests/kernels/surface/bump_files.h"

namespace lanelight::test {
namespace {

// Smooth waves on a slope, whose tilt does not cancel in the mean of a tile.
void WriteWaves(const std::string& path, double slope) {
  WriteGreyImage(path, 64, [&](double u, double v) {
    return 2 + slope * (2 * u - v) +
           0.3 * std::sin(6.283185307 * u) * std::cos(6.283185307 * v);
  });
}

Material Metal() {
  Material m;
  m.kind = MaterialKind::kConductor;
  m.eta.constant = {0.2, 0.9, 1.1};
  m.k.constant = {3.9, 2.5, 2.2};
  m.uroughness.constant = 0.1;
  m.vroughness.constant = 0.3;
  m.remap_roughness = false;
  return m;
}

// Bumps on a quad, a smooth mesh, a ball, a disk, and a normal map on a metal plate, all
// before the camera, under lights that glance off them.
SceneDescription BumpMapScene(const TemporaryFolder& folder, double height = 1) {
  WriteWaves(folder.File("waves.exr"), 1);
  WriteColorImage(folder.File("n.exr"), {0.65, 0.45, 0.9});
  SceneBuilder b(12, 12);
  b.Depth(3).Perspective({0, -4, 2.5}, {0, 0, 0.2}, {0, 0, 1}, 40);
  Material bumpy;
  bumpy.reflectance.constant = {0.8, 0.6, 0.4};
  bumpy.displacement.texture = AddHeights(b.scene(), folder.File("waves.exr"));
  b.scene().textures[0].scale = 0.1 * height;
  b.scene().textures[0].mapping.su = b.scene().textures[0].mapping.sv = 6;
  const Index diffuse = b.AddMaterial(bumpy);
  b.AddQuad({-3, -1.5, 0}, {6, 0, 0}, {0, 5, 0}, diffuse);
  b.AddSphere({-0.8, 0, 0.5}, 0.4, diffuse);
  b.AddDisk({0.1, 0.6, 0.6}, {0.2, -1, 0.4}, 0.4, diffuse);
  Material metal = Metal();
  metal.displacement = bumpy.displacement;
  TriangleMesh roof;
  roof.positions = {{0.5, -0.4, 0.2}, {1.3, -0.4, 0.2}, {1.3, 0.4, 0.7}, {0.5, 0.4, 0.7}};
  roof.uvs = {{0, 0}, {2, 0}, {2, 1}, {0, 1}};
  for (const Vec3d n :
       {Vec3d{-0.3, -0.6, 1}, {0.3, -0.6, 1}, {0.3, -0.2, 1}, {0, 0, 1}}) {
    roof.normals.push_back(Normalize(n));
  }
  roof.indices = {0, 1, 2, 0, 2, 3};
  b.AddMesh(roof, b.AddMaterial(metal));
  Material mapped = Metal();
  mapped.normal_map = folder.File("n.exr");
  b.AddQuad({-0.5, -1.2, 0.1}, {1, 0, 0}, {0, 0.7, 0.2}, b.AddMaterial(mapped));
  b.AddSphere({1, -1, 3}, 0.5, diffuse, b.AddEmission({3, 3, 2}));
  b.AddDistant({-3, -1, 1}, {1.8, 2.1, 2.7});
  b.AddEnvironment({0.2, 0.25, 0.3});
  return b.Build();
}

// A floor with an image of noise, of which a pixel sees many texels.
SceneDescription NoisyFloor(const TemporaryFolder& folder, ImageFilter filter) {
  std::uint32_t state = 1;
  WriteGreyImage(folder.File("noise.exr"), 64, [&](double, double) {
    state = state * 1664525u + 1013904223u;
    return state >> 31;
  });
  SceneBuilder b(12, 12);
  b.Depth(1).Perspective({0, -6, 3}, {0, 0, 0}, {0, 0, 1}, 40);
  b.scene().sampler.spp = 1;  // footprints of whole pixels
  Texture texture = ImageTexture(folder.File("noise.exr"));
  texture.filter = filter;
  texture.mapping.su = texture.mapping.sv = 8;
  b.scene().textures.push_back(texture);
  Material m;
  m.reflectance.texture = 0;
  b.AddQuad({-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, b.AddMaterial(m));
  b.AddDistant({0, 0, 1}, Grey(2));
  return b.Build();
}

}  // namespace

TEST_CASE("bump and normal maps agree with the reference", "[relief][agreement]") {
  const TemporaryFolder folder;
  const SceneDescription scene = BumpMapScene(folder);
  stat::CheckSame(CompareWithReference(scene, 16384, 4000, 2e-3));
}

TEST_CASE("bumps of twice the height are detected", "[relief][agreement]") {
  const TemporaryFolder folder, other;
  const SceneDescription scene = BumpMapScene(folder), wrong = BumpMapScene(other, 2);
  const auto result = stat::CompareMeans(RenderWavefront(scene, 4096),
                                         RenderWavefront(wrong, 4096), {4, 1e-6, 2e-3});
  INFO(result.ToString());
  CHECK_FALSE(result.same);
}

TEST_CASE("a white bumped ball in a white world stays nearly white", "[relief]") {
  const TemporaryFolder folder;
  WriteWaves(folder.File("waves.exr"), 0);
  SceneBuilder b(16, 16);
  b.Depth(40).Orthographic({0, -5, 0}, {0, 0, 0}, {0, 0, 1}, 0.9);
  Material bumpy;
  bumpy.reflectance.constant = Grey(1);
  bumpy.displacement.texture = AddHeights(b.scene(), folder.File("waves.exr"));
  b.scene().textures[0].scale = 0.1;
  b.scene().textures[0].mapping.su = b.scene().textures[0].mapping.sv = 8;
  b.AddSphere({0, 0, 0}, 1, b.AddMaterial(bumpy));
  b.AddEnvironment(Grey(1));
  TestRender options;
  options.spp = 400;
  const Rendered render = RenderDescription(b.Build(), options);
  const double mean = ImageMean(render.film).x;
  CAPTURE(mean);
  // What is scattered below the horizon goes on inside the ball, and all of it comes out
  // again sooner or later; 40 bounces see the most of it.
  CHECK(mean > 0.985);
  CHECK(mean < 1.001);
}

TEST_CASE("filtered textures keep the mean and reduce the noise", "[relief]") {
  const TemporaryFolder folder;
  TestRender options;
  options.spp = 1024;
  const auto render = [&](ImageFilter filter) {
    return RenderDescription(NoisyFloor(folder, filter), options).film;
  };
  const auto bilinear = render(ImageFilter::kBilinear);
  const Rgb noise = ImageStandardError(bilinear);
  for (const ImageFilter filter : {ImageFilter::kTrilinear, ImageFilter::kEwa}) {
    const auto filtered = render(filter);
    CAPTURE(filter, noise.x, ImageMean(bilinear).x, ImageMean(filtered).x);
    // Six standard errors: false alarms in 2e-9.
    CHECK(std::abs(ImageMean(filtered).x - ImageMean(bilinear).x) < 6 * noise.x);
    CHECK(ImageStandardError(filtered).x < noise.x / 3);
  }
}

TEST_CASE("footprints exist where an image is filtered", "[relief][plan]") {
  const TemporaryFolder folder;
  const auto plan = [&](ImageFilter filter) {
    return MakePlan(PrepareScene(NoisyFloor(folder, filter)), {});
  };
  CHECK_FALSE(plan(ImageFilter::kBilinear).features.Has(Feature::kTextureFootprints));
  CHECK_FALSE(plan(ImageFilter::kPoint).features.Has(Feature::kTextureFootprints));
  CHECK(plan(ImageFilter::kTrilinear).features.Has(Feature::kTextureFootprints));
  CHECK(plan(ImageFilter::kEwa).features.Has(Feature::kTextureFootprints));
}

TEST_CASE("scenes without bump and normal maps have no stages for them",
          "[relief][plan]") {
  SceneBuilder b(8, 8);
  b.AddSphere({0, 0, 5}, 1, b.AddDiffuse(Grey(0.5)));
  b.AddPoint({0, 0, 0}, Grey(1));
  const PreparedScene scene = PrepareScene(b.Build());
  CHECK(scene.compiled->materials.displacement_texture.empty());
  CHECK(scene.compiled->materials.normal_map_texture.empty());
  const Plan plan = MakePlan(scene, {});
  for (const PlannedStage& s : plan.paths().stages) {
    const std::set<std::string> bump_stages = {"footprints", "bumps", "normal_maps"};
    CHECK(bump_stages.count(s.stage.name) == 0);
  }
  for (const Field field : {Field::ns_x, Field::tg_x, Field::tv_x, Field::footprint_0}) {
    CHECK(std::count(plan.absent_fields.begin(), plan.absent_fields.end(), field) == 1);
  }
}

}  // namespace lanelight::test
