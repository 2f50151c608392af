// The wavefront against the closed forms of tests/reference/closed_forms.h.
#include <catch2/catch.hpp>

#include "tests/agreement/agreement.h"
#include "tests/reference/closed_forms.h"

namespace lanelight::test {
namespace {

// Rounding, and the midpoint rule of PixelMean.
constexpr stat::ImageTestOptions kTolerant = {4, 1e-6, 3e-4, 1e-6};

void CheckClosedForm(const SceneDescription& scene, std::uint64_t spp, const Exact& exact,
                     double power = 0.02) {
  const auto image = RenderWavefront(scene, spp);
  const auto result = stat::CompareMeans(
      image, stat::ExpectedImage(image.width, image.height, exact), kTolerant);
  INFO(result.ToString());
  CHECK(result.same);
  if (exact(0, 0).x > 0) CHECK(result.detectable_bias < power);
}

constexpr Scattering kModels[] = {Scattering::kLambertian, Scattering::kUniform,
                                  Scattering::kInSphere};

}  // namespace

TEST_CASE("wavefront: white furnace of every diffuse model", "[closed_form]") {
  for (Scattering s : kModels) {
    for (double albedo : {0.0, 0.5, 1.0}) {
      Material m;
      m.scattering = s;
      m.reflectance.constant = Grey(albedo);
      INFO("model " << static_cast<int>(s) << ", albedo " << albedo);
      CheckClosedForm(Furnace(m, 4), 1024,
                      ConstantImage(closed_form::Furnace(albedo, 1)));
    }
  }
}

TEST_CASE("wavefront: lossless materials are invisible in the furnace", "[closed_form]") {
  Material glass, thin, leaf, diamond;
  glass.kind = diamond.kind = MaterialKind::kDielectric;
  diamond.interface_eta = 2.4;
  thin.kind = MaterialKind::kThinDielectric;
  leaf.kind = MaterialKind::kDiffuseTransmission;
  leaf.reflectance.constant = {0.7, 0.5, 0};
  leaf.transmittance.constant = {0.3, 0.5, 1};
  for (const Material& m : {glass, diamond, thin, leaf}) {
    CheckClosedForm(Furnace(m, 200, 4), 4096, ConstantImage(1));
  }
}

TEST_CASE("wavefront: closed rooms of albedo 0.5, 0.9 and 0.99", "[closed_form]") {
  for (double albedo : {0.5, 0.9}) {
    for (int depth : {0, 1, 3, 300}) {
      INFO("albedo " << albedo << ", depth " << depth);
      const Exact series = ConstantImage(closed_form::ClosedRoom(1, albedo, depth));
      CheckClosedForm(ClosedRoom(albedo, depth), 4096, series, 0.03);
      CheckClosedForm(ClosedBox(albedo, depth), 4096, series, 0.03);
    }
  }
  CheckClosedForm(ClosedRoom(0.99, 4000), 2048, ConstantImage(100), 0.05);
}

TEST_CASE("wavefront: point light over a plane", "[closed_form]") {
  for (Scattering s : kModels) {
    const auto exact = PixelMean(8, [&](Vec3d p) {
      const double distance = Length(Vec3d{0, 0, 2} - p);
      return closed_form::PointLightOnPlane(s, 0.5, 1, distance, 2 / distance) *
             Rgb{1, 2, 3};
    });
    CheckClosedForm(PointOverPlane(s, 8), 1024, exact);
  }
}

TEST_CASE("wavefront: irradiance of a sphere light and of a polygon", "[closed_form]") {
  const auto sphere = PixelMean(8, [&](Vec3d p) {
    const Vec3d to = Vec3d{0.5, 0, 2} - p;
    return Grey(
        0.5 / std::numbers::pi *
        closed_form::SphereLightIrradiance(3, 0.5, Length(to), to.z / Length(to)));
  });
  CheckClosedForm(SphereLight(8), 4096, sphere);
  const auto polygon = PixelMean(8, [&](Vec3d p) {
    const std::vector<Vec3d> corners = PolygonCorners();
    return Grey(0.5 / std::numbers::pi *
                closed_form::PolygonIrradiance(3, corners, p, {0, 0, 1}));
  });
  CheckClosedForm(PolygonLight(8), 4096, polygon);
}

TEST_CASE("wavefront: a mirror at normal incidence", "[closed_form]") {
  SceneBuilder b(4, 4);
  b.Depth(2).Orthographic({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 1);
  b.AddPlane({0, 0, 0}, {0, 0, 1}, b.AddConductor({0.2, 0.9, 1.1}, {3.9, 2.5, 2.2}));
  b.AddEnvironment({1, 2, 3});
  const Rgb exact = {closed_form::ConductorNormal(0.2, 3.9),
                     2 * closed_form::ConductorNormal(0.9, 2.5),
                     3 * closed_form::ConductorNormal(1.1, 2.2)};
  CheckClosedForm(b.Build(), 16, [&](int, int) { return exact; });
}

TEST_CASE("wavefront: a slab of glass splits and displaces a beam", "[closed_form]") {
  const double eta = 1.5, thickness = 0.25, cosine = std::sqrt(0.5);
  CheckClosedForm(GlassSlab(400), 256, ConstantImage(1));
  const SceneDescription slab = GlassSlab(400);
  const auto with_emitter = [&](Vec3d center, Vec3d normal, double radius, int depth) {
    SceneBuilder b(2, 2);
    b.Depth(depth).Orthographic({-1, 0, 1}, {0, 0, 0}, {0, 1, 0}, 1e-3);
    b.scene().materials = slab.materials;
    b.scene().shapes = slab.shapes;
    b.AddDisk(center, normal, radius, b.AddDiffuse(Grey(0)), b.AddEmission(Grey(1)));
    return b.Build();
  };
  CheckClosedForm(with_emitter({0, 0, 3}, {0, 0, -1}, 40, 400), 20000,
                  ConstantImage(closed_form::SlabReflectance(cosine, eta)), 0.1);
  CheckClosedForm(with_emitter({0, 0, -3}, {0, 0, 1}, 40, 400), 20000,
                  ConstantImage(closed_form::SlabTransmittance(cosine, eta)));
  // A small emitter just below, where the straight beam leaves the slab: it meets the top
  // at the origin and the bottom one shift further on. Displaced by less than the
  // emitter's radius it shows (1 - R)^2, and nothing where the beam does not come out.
  const double shift = closed_form::SlabShift(cosine, eta, thickness);
  const double below = -thickness - 1e-4;
  CheckClosedForm(with_emitter({shift + 1e-4, 0, below}, {0, 0, 1}, 5e-3, 2), 20000,
                  ConstantImage(closed_form::SlabOrder(cosine, eta, 0)));
  CheckClosedForm(with_emitter({thickness, 0, below}, {0, 0, 1}, 5e-3, 2), 200,
                  ConstantImage(0), 1e300);
}

TEST_CASE("wavefront: a clear coat conserves energy", "[closed_form]") {
  // An orthographic view straight down on a coated plane. Ten events in the coat are five
  // bounces off its bottom.
  for (int events : {10, 400}) {
    for (double albedo : {1.0, 0.5}) {
      SceneBuilder b(4, 4);
      b.Depth(2).Orthographic({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 1);
      Material coat;
      coat.kind = MaterialKind::kCoatedDiffuse;
      coat.reflectance.constant = Grey(albedo);
      coat.thickness = 0;
      coat.coat_max_depth = events;
      b.AddPlane({0, 0, 0}, {0, 0, 1}, b.AddMaterial(coat));
      b.AddEnvironment(Grey(1));
      const double exact = closed_form::CoatedFurnace(albedo, 1.5, 1, events / 2);
      stat::CheckSame(stat::CompareMeans(RenderWavefront(b.Build(), 4096),
                                         stat::ExpectedImage(4, 4, ConstantImage(exact)),
                                         {4, 1e-6, 0.005, 0}),
                      fmt::format("events {}, albedo {}", events, albedo));
    }
  }
}

}  // namespace lanelight::test
