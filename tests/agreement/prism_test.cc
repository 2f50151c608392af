// A prism against Snell's law and the dispersion of its glass: one ray, whose colours
// part, and a light that only some of them meet.
#include <catch2/catch.hpp>

#include "src/base/image/spectrum.h"
#include "src/base/image/wavelengths.h"
#include "tests/agreement/agreement.h"

namespace lanelight::test {
namespace {

constexpr double kApex = 60, kScreen = 4;  // degrees; where the light stands
constexpr double kRadiance = 2;
const Vec3d kStart = {-3, 0, -1.26};
const Vec3d kToward = {3, 0, 1.95};

// In the plane of x and z: the apex at (0, 1), the base at z = 0.
struct Prism {
  Vec3d apex{0, 0, 1}, left, right;
  Prism() {
    const double half = std::tan(kApex / 2 * 3.14159265358979323846 / 180);
    left = {-half, 0, 0};
    right = {half, 0, 0};
  }
};

struct Bent {
  Vec3d direction;
  double passes = 0;  // share of the light
};

// Snell and Fresnel: from index a into b at a surface whose normal n faces the ray.
Bent Refracted(Vec3d d, Vec3d n, double a, double b) {
  const double ci = -Dot(d, n), ratio = a / b;
  const double ct = std::sqrt(1 - ratio * ratio * (1 - ci * ci));
  const double s = (a * ci - b * ct) / (a * ci + b * ct);
  const double p = (b * ci - a * ct) / (b * ci + a * ct);
  return {d * ratio + n * (ratio * ci - ct), 1 - (s * s + p * p) / 2};
}

// Returns the point at which o + t d meets the line through a and b.
Vec3d Meet(Vec3d o, Vec3d d, Vec3d a, Vec3d b) {
  const Vec3d normal = {b.z - a.z, 0, a.x - b.x};
  return o + d * (Dot(normal, a - o) / Dot(normal, d));
}

struct Arrival {
  double height = 0, passes = 0;
};

// Where light of an index reaches the screen, and how much of it.
Arrival Through(double index) {
  const Prism prism;
  const double half = kApex / 2 * 3.14159265358979323846 / 180;
  const Vec3d n_left = {-std::cos(half), 0, std::sin(half)};
  const Vec3d n_right = {std::cos(half), 0, std::sin(half)};
  const Vec3d d = Normalize(kToward);
  const Vec3d in = Meet(kStart, d, prism.apex, prism.left);
  const Bent inside = Refracted(d, n_left, 1, index);
  const Vec3d out = Meet(in, inside.direction, prism.apex, prism.right);
  const Bent outside = Refracted(inside.direction, -n_right, index, 1);
  const double t = (kScreen - out.x) / outside.direction.x;
  return {out.z + outside.direction.z * t, inside.passes * outside.passes};
}

SceneDescription PrismScene(double cut) {
  SceneBuilder b(8, 8);
  b.Depth(2).Orthographic(kStart, kStart + kToward, {0, 1, 0}, 1e-5);
  Material glass;
  glass.kind = MaterialKind::kDielectric;
  const Spectrum index = *SpectrumOfName("glass-F11");
  glass.interface_eta = index(587.6);
  glass.dispersion = std::make_shared<const Spectrum>(index);
  const Index material = b.AddMaterial(glass);
  const Prism prism;
  const auto side = [&](Vec3d from, Vec3d to) {
    b.AddQuad(from + Vec3d{0, -1, 0}, to - from, {0, 2, 0}, material);
  };
  side(prism.left, prism.apex);
  side(prism.apex, prism.right);
  side(prism.right, prism.left);
  // Faces the prism, above the cut.
  b.AddQuad({kScreen, -2, cut}, {0, 0, 9}, {0, 4, 0}, b.AddDiffuse(Grey(0)),
            b.AddEmission(Grey(kRadiance), true));
  b.scene().integrator.transport = Transport::kSpectral;
  return b.Build();
}

// Returns the light that reaches the camera from above the cut.
Rgb ByLaw(double cut) {
  const Spectrum index = *SpectrumOfName("glass-F11");
  constexpr double kStep = 0.02;
  Rgb sum, all;
  for (double nm = kFirstCarriedNm; nm < kLastCarriedNm - 0.5 * kStep; nm += kStep) {
    const Rgb fraction = WhiteFraction(nm) * kStep;
    all += fraction;
    const Arrival at = Through(index(nm));
    if (at.height > cut) sum += fraction * (kRadiance * at.passes);
  }
  return {sum.x / all.x, sum.y / all.y, sum.z / all.z};
}

}  // namespace

TEST_CASE("prism: colours are refracted by Snell's law", "[spectral]") {
  const Spectrum index = *SpectrumOfName("glass-F11");
  // Blue is bent more, towards the base.
  REQUIRE(Through(index(450)).height < Through(index(650)).height - 0.05);
  for (double edge : {480.0, 530.0, 580.0, 620.0}) {
    const double cut = Through(index(edge)).height;
    const Rgb exact = ByLaw(cut);
    const auto image = RenderWavefront(PrismScene(cut), 16384);
    Rgb mean, error;
    const double pixels = double(image.mean.size());
    for (std::size_t i = 0; i < image.mean.size(); ++i) {
      mean += image.mean[i] / pixels;
      error += image.variance[i] / (pixels * pixels);
    }
    INFO("light above " << edge << " nm: " << mean.x << " " << mean.y << " " << mean.z
                        << ", by Snell " << exact.x << " " << exact.y << " " << exact.z);
    for (int c = 0; c < 3; ++c) {
      // Six standard errors: 2e-9 for each; and half a percent of white.
      CHECK(mean[c] == Approx(exact[c]).margin(6 * std::sqrt(error[c]) + 1e-3));
      CHECK(6 * std::sqrt(error[c]) < 0.03);
    }
  }
}

TEST_CASE("prism: RGB rendering uses one index of refraction", "[spectral]") {
  const Spectrum index = *SpectrumOfName("glass-F11");
  SceneDescription scene = PrismScene(Through(index(587.6)).height - 0.01);
  scene.integrator.transport = Transport::kRgb;
  const auto image = RenderWavefront(scene, 4096);
  const double expected = kRadiance * Through(index(587.6)).passes;
  Rgb mean;
  for (const Rgb& c : image.mean) mean += c / double(image.mean.size());
  for (int c = 0; c < 3; ++c) CHECK(mean[c] == Approx(expected).margin(0.02));
}

}  // namespace lanelight::test
