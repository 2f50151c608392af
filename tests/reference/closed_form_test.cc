// The reference tracer against closed forms, with both estimators. Where an estimator has
// no variance at all (every path carries the same value), equality is to rounding.
#include <catch2/catch.hpp>

#include "tests/reference/closed_forms.h"
#include "tests/reference/compare.h"
#include "tests/reference/scenes.h"

namespace lanelight::test {
namespace {

constexpr ReferenceEstimator kEstimators[] = {ReferenceEstimator::kMaterialSampling,
                                              ReferenceEstimator::kLightSampling};

// Pixels of these images vary over their area: the midpoint rule of PixelMean is good to
// 1e-4.
constexpr stat::ImageTestOptions kMidpoint = {4, 1e-6, 2e-4, 1e-9};
constexpr stat::ImageTestOptions kRounding = {4, 1e-6, 1e-12, 0};

}  // namespace

TEST_CASE("reference: white furnace of every diffuse model", "[reference]") {
  for (Scattering s :
       {Scattering::kLambertian, Scattering::kUniform, Scattering::kInSphere}) {
    for (double albedo : {0.0, 0.5, 1.0}) {
      Material m;
      m.scattering = s;
      m.reflectance.constant = Grey(albedo);
      for (ReferenceEstimator e : kEstimators) {
        const auto result = CompareWithClosedForm(
            Furnace(m, 4), Options(e, 256),
            ConstantImage(closed_form::Furnace(albedo, 1)), {4, 1e-6, 1e-12, 0});
        stat::CheckSame(result);
      }
    }
  }
}

TEST_CASE("reference: lossless materials vanish in the furnace", "[reference]") {
  Material glass, thin, leaf;
  glass.kind = MaterialKind::kDielectric;
  thin.kind = MaterialKind::kThinDielectric;
  leaf.kind = MaterialKind::kDiffuseTransmission;
  leaf.reflectance.constant = {0.7, 0.5, 0};
  leaf.transmittance.constant = {0.3, 0.5, 1};
  for (const Material& m : {glass, thin, leaf}) {
    for (ReferenceEstimator e : kEstimators) {
      // A leaf's path stays inside with probability below one per bounce; 200 is plenty.
      stat::CheckSame(CompareWithClosedForm(Furnace(m, 200, 4), Options(e, 64),
                                            ConstantImage(1), {4, 1e-6, 1e-6, 0}));
    }
  }
}

TEST_CASE("reference: closed rooms of albedo 0.5, 0.9 and 0.99", "[reference]") {
  for (double albedo : {0.5, 0.9}) {
    for (int depth : {0, 1, 3, 300}) {
      // Material sampling meets the emission at every vertex: no variance.
      const double series = closed_form::ClosedRoom(1, albedo, depth);
      const auto a = Options(ReferenceEstimator::kMaterialSampling, 8);
      stat::CheckSame(CompareWithClosedForm(ClosedRoom(albedo, depth), a,
                                            ConstantImage(series), kRounding));
      stat::CheckSame(CompareWithClosedForm(ClosedBox(albedo, depth), a,
                                            ConstantImage(series), kRounding));
      const auto b = Options(ReferenceEstimator::kLightSampling, depth > 3 ? 10 : 400);
      stat::CheckSame(CompareWithClosedForm(ClosedRoom(albedo, depth), b,
                                            ConstantImage(series), kRounding));
      stat::CheckSame(CompareWithClosedForm(ClosedBox(albedo, depth), b,
                                            ConstantImage(series), kRounding));
    }
    CHECK(closed_form::ClosedRoom(1, albedo, 300) ==
          Approx(closed_form::ClosedRoom(1, albedo)).epsilon(1e-12));
  }
  stat::CheckSame(CompareWithClosedForm(ClosedRoom(0.99, 4000),
                                        Options(ReferenceEstimator::kMaterialSampling, 4),
                                        ConstantImage(100), kRounding));
}

TEST_CASE("reference: point light over a plane", "[reference]") {
  for (Scattering s :
       {Scattering::kLambertian, Scattering::kUniform, Scattering::kInSphere}) {
    const int size = 8;
    const auto exact = PixelMean(size, [&](Vec3d p) {
      const double distance = Length(Vec3d{0, 0, 2} - p);
      return closed_form::PointLightOnPlane(s, 0.5, 1, distance, 2 / distance) *
             Rgb{1, 2, 3};
    });
    for (ReferenceEstimator e : kEstimators) {
      stat::CheckSame(CompareWithClosedForm(PointOverPlane(s, size), Options(e, 400),
                                            exact, kMidpoint));
    }
  }
}

TEST_CASE("reference: irradiance of a sphere light", "[reference]") {
  const int size = 8;
  const auto exact = PixelMean(size, [&](Vec3d p) {
    const Vec3d to = Vec3d{0.5, 0, 2} - p;
    return Grey(
        0.5 / std::numbers::pi *
        closed_form::SphereLightIrradiance(3, 0.5, Length(to), to.z / Length(to)));
  });
  stat::CheckSame(CompareWithClosedForm(SphereLight(size),
                                        Options(ReferenceEstimator::kLightSampling, 2000),
                                        exact, kMidpoint));
  stat::CheckSame(CompareWithClosedForm(
      SphereLight(size), Options(ReferenceEstimator::kMaterialSampling, 8000), exact,
      kMidpoint));
}

TEST_CASE("reference: Lambert's polygon formula", "[reference]") {
  const int size = 8;
  const auto exact = PixelMean(size, [&](Vec3d p) {
    const std::vector<Vec3d> corners = PolygonCorners();
    return Grey(0.5 / std::numbers::pi *
                closed_form::PolygonIrradiance(3, corners, p, {0, 0, 1}));
  });
  stat::CheckSame(CompareWithClosedForm(PolygonLight(size),
                                        Options(ReferenceEstimator::kLightSampling, 2000),
                                        exact, kMidpoint));
  const auto other = CompareWithClosedForm(
      PolygonLight(size), Options(ReferenceEstimator::kMaterialSampling, 8000), exact,
      kMidpoint);
  stat::CheckSame(other);
  CHECK(other.detectable_bias < 0.05);
}

TEST_CASE("reference: a mirror at normal incidence", "[reference]") {
  SceneBuilder b(4, 4);
  b.Depth(2).Orthographic({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 1);
  b.AddPlane({0, 0, 0}, {0, 0, 1}, b.AddConductor({0.2, 0.9, 1.1}, {3.9, 2.5, 2.2}));
  b.AddEnvironment({1, 2, 3});
  const Rgb exact = {closed_form::ConductorNormal(0.2, 3.9),
                     2 * closed_form::ConductorNormal(0.9, 2.5),
                     3 * closed_form::ConductorNormal(1.1, 2.2)};
  for (ReferenceEstimator e : kEstimators) {
    stat::CheckSame(CompareWithClosedForm(
        b.Build(), Options(e, 4), [&](int, int) { return exact; }, kRounding));
  }
}

TEST_CASE("reference: a slab of glass splits and displaces a beam", "[reference]") {
  // One ray meets a slab of thickness 0.25 at 45 degrees. Emitting screens far above and
  // below count what is reflected and transmitted.
  const double eta = 1.5, thickness = 0.25, cosine = std::sqrt(0.5);
  SceneDescription scene = GlassSlab(400);
  scene.lights.clear();
  stat::CheckSame(CompareWithClosedForm(
      GlassSlab(400), Options(ReferenceEstimator::kMaterialSampling, 64),
      ConstantImage(1), {4, 1e-6, 1e-9, 0}));
  const reference::Geometry geometry(scene, nullptr);
  reference::Random random(17);
  const Vec3d start = {-1, 0, 1}, direction = Normalize(Vec3d{1, 0, -1});
  // The straight-through path, by the tracer's own geometry and refraction.
  const reference::Ray ray = {start, direction, kNone};
  const auto top = geometry.Intersect(ray, reference::kInfinity, random);
  const Vec3d inside = {std::sqrt(0.5) / eta, 0, -closed_form::Snell(cosine, eta)};
  const Vec3d entry = geometry.Describe(ray, top).p;
  const auto bottom =
      geometry.Intersect({entry, inside, top.primitive}, reference::kInfinity, random);
  const Vec3d exit = geometry.Describe({entry, inside, top.primitive}, bottom).p;
  CHECK(exit.x - entry.x == Approx(closed_form::SlabShift(cosine, eta, thickness)));
  // Distance of the exit point from the straight line.
  const Vec3d offset = exit - entry;
  CHECK(Length(offset - Dot(offset, direction) * direction) ==
        Approx(closed_form::SlabDisplacement(cosine, eta, thickness)));

  // Emission only above (z > 2), so that the image is the reflected part; then below.
  for (const bool above : {true, false}) {
    SceneBuilder b(2, 2);
    b.Depth(400).Orthographic({-1, 0, 1}, {0, 0, 0}, {0, 1, 0}, 1e-3);
    b.scene().materials = scene.materials;
    b.scene().shapes = scene.shapes;
    const Index black = b.AddDiffuse(Grey(0));
    b.AddDisk({0, 0, above ? 3.0 : -3.0}, {0, 0, above ? -1.0 : 1.0}, 40, black,
              b.AddEmission(Grey(1)));
    const double exact = above ? closed_form::SlabReflectance(cosine, eta)
                               : closed_form::SlabTransmittance(cosine, eta);
    const auto result = CompareWithClosedForm(
        b.Build(), Options(ReferenceEstimator::kLightSampling, 20000),
        ConstantImage(exact));
    stat::CheckSame(result);
    CHECK(result.detectable_bias < (above ? 0.1 : 0.02));
  }
}

}  // namespace lanelight::test
