// The building blocks of the reference: each sampler against its own evaluation, and both
// against closed forms.
#include "src/base/core/pi.h"
#include "tests/reference/bsdf.h"

#include <array>
#include <catch2/catch.hpp>

#include "src/base/stat/hypothesis.h"
#include "tests/reference/closed_forms.h"
#include "tests/reference/material.h"
#include "tests/reference/scenes.h"

namespace lanelight::reference {
namespace {

LocalMaterial Local(const Material& material) {
  SceneDescription scene;
  scene.materials.push_back(material);
  Random random(1);
  return EvaluateMaterial(scene, 0, {}, nullptr, random);
}

struct Sum {
  double n = 0, sum = 0, squares = 0;
  void Add(double v) { n += 1, sum += v, squares += v * v; }
  stat::MeanEstimate Estimate() const {
    const double mean = sum / n;
    return {mean, (squares / n - mean * mean) / (n - 1), n - 1};
  }
};

Vec3d UniformDirection(Random& random) {
  const double z = 2 * random.Uniform() - 1, phi = 2 * kPi * random.Uniform();
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

// Smooth functions of the direction whose integrals against the BSDF are compared.
double Moment(int which, Vec3d w) {
  switch (which) {
    case 0:
      return 1;
    case 1:
      return w.z > 0 ? 1 : 0;
    case 2:
      return w.x;
    case 3:
      return w.z * w.z;
    default:
      return w.x * w.y + w.y;
  }
}

}  // namespace

TEST_CASE("reference: mean cosines of the diffuse models", "[reference]") {
  for (Scattering s :
       {Scattering::kLambertian, Scattering::kUniform, Scattering::kInSphere}) {
    Random random(static_cast<std::uint64_t>(s) + 3);
    Sum cosine, square, azimuth;
    for (int i = 0; i < 200000; ++i) {
      const Vec3d w = SampleDiffuse(s, random);
      cosine.Add(w.z);
      square.Add(w.z * w.z);
      azimuth.Add(w.x * w.y);
    }
    INFO("model " << static_cast<int>(s));
    const auto is = [](const Sum& sum, double value) {
      return stat::WelchPValue(sum.Estimate(), {value, 0, 0});
    };
    CHECK(is(cosine, closed_form::MeanCosine(s)) > 1e-5);
    CHECK(is(square, closed_form::MeanSquaredCosine(s)) > 1e-5);
    CHECK(is(azimuth, 0) > 1e-5);
    // Power: 1 % off would be seen.
    CHECK(is(cosine, closed_form::MeanCosine(s) * 1.01) < 1e-5);
    // The density integrates to one, its first moments to the closed forms.
    double total = 0, first = 0;
    for (int i = 0; i < 1000; ++i) {
      const double c = (i + 0.5) / 1000, density = DiffuseDensity(s, c);
      total += 2 * kPi * density / 1000;
      first += 2 * kPi * density * c / 1000;
      CHECK(density == Approx(closed_form::ScatteringDensity(s, c)));
    }
    CHECK(total == Approx(1).epsilon(1e-5));
    CHECK(first == Approx(closed_form::MeanCosine(s)).epsilon(1e-5));
  }
}

TEST_CASE("reference: Fresnel against the angle form and known limits", "[reference]") {
  for (double eta : {1.0001, 1.33, 1.5, 2.4, 1 / 1.5}) {
    for (double c : {1.0, 0.9, 0.5, 0.1, 1e-3}) {
      CHECK(FresnelDielectric(c, eta) ==
            Approx(closed_form::Fresnel(c, eta)).epsilon(1e-6).margin(1e-12));
      CHECK(FresnelConductor(c, eta, 0) ==
            Approx(FresnelDielectric(c, eta)).epsilon(1e-9).margin(1e-14));
    }
  }
  CHECK(FresnelDielectric(0.1, 1 / 1.5) == 1);  // total internal reflection
  CHECK(FresnelDielectric(std::cos(std::atan(1.5)), 1.5) < 0.5);
  CHECK(FresnelConductor(1, 0.2, 3.9) == Approx(closed_form::ConductorNormal(0.2, 3.9)));
  CHECK(FresnelConductor(1e-9, 0.2, 3.9) == Approx(1).epsilon(1e-6));
  // Reciprocity of the diffuse reflectance of the two sides.
  const double out = closed_form::DiffuseFresnel(1.5);
  CHECK(closed_form::DiffuseFresnel(1 / 1.5) ==
        Approx(1 - (1 - out) / 2.25).epsilon(1e-4));
  CHECK(out == Approx(0.0918).epsilon(2e-3));  // tabulated for glass
}

TEST_CASE("reference: GGX normals are normalised and sampled as they say",
          "[reference]") {
  for (const Ggx ggx : {Ggx{0.5, 0.5}, Ggx{0.2, 0.7}, Ggx{1, 1}}) {
    Random random(9);
    // Projected area of the microsurface is one: int D(m) m.z dm = 1.
    Sum area, sampled, integrated;
    for (int i = 0; i < 200000; ++i) {
      Vec3d m = UniformDirection(random);
      m.z = std::abs(m.z);
      area.Add(2 * kPi * ggx.D(m) * m.z);
      integrated.Add(2 * kPi * ggx.D(m) * m.z * m.x * m.x);
      const Vec3d n = ggx.SampleNormal(random);
      sampled.Add(n.x * n.x);
    }
    CHECK(stat::WelchPValue(area.Estimate(), {1, 0, 0}) > 1e-5);
    CHECK(stat::WelchPValue(sampled.Estimate(), integrated.Estimate()) > 1e-5);
    // Masking: the visible area seen along w is cos w (Heitz 2014, eq. 14):
    // int D(m) (w.m)+ dm = cos w (1 + Lambda(w)), here by the midpoint rule.
    for (const Vec3d w :
         {Normalize(Vec3d{0.98, 0.1, 0.12}), Normalize(Vec3d{0.1, 0.6, 0.5})}) {
      constexpr int kSteps = 400;
      double visible = 0;
      for (int i = 0; i < kSteps * kSteps; ++i) {
        const double z = (i % kSteps + 0.5) / kSteps, r = std::sqrt(1 - z * z);
        const double phi = 2 * kPi * (i / kSteps + 0.5) / kSteps;
        const Vec3d m = {r * std::cos(phi), r * std::sin(phi), z};
        visible += ggx.D(m) * std::max(0.0, Dot(w, m)) * 2 * kPi / (kSteps * kSteps);
      }
      CHECK(visible == Approx(w.z * (1 + ggx.Lambda(w))).epsilon(2e-3));
    }
  }
}

TEST_CASE("reference: samples agree with the evaluation", "[reference]") {
  for (const Material& material : test::MaterialZoo()) {
    LocalMaterial local = Local(material);
    local.thickness = 0.4;  // of coats: an absorption that would be missed if forgotten
    for (const Vec3d wo :
         {Normalize(Vec3d{0.3, -0.4, 0.8}), Normalize(Vec3d{0.8, 0.1, -0.3})}) {
      Random random(21);
      std::array<Sum, 5> sampled, evaluated;
      for (int i = 0; i < 40000; ++i) {
        const auto s = SampleBsdf(local, wo, random);
        const double weight = s && !s->specular ? s->weight.y : 0;
        const Vec3d wi = UniformDirection(random);
        const double value = 4 * kPi * EvaluateCos(local, wo, wi, random).y;
        for (int moment = 0; moment < 5; ++moment) {
          sampled[moment].Add(weight > 0 ? weight * Moment(moment, s->wi) : 0);
          evaluated[moment].Add(value * Moment(moment, wi));
        }
      }
      for (int moment = 0; moment < 5; ++moment) {
        const auto a = sampled[moment].Estimate(), b = evaluated[moment].Estimate();
        INFO(material.name << ", wo.z " << wo.z << ", moment " << moment << ": " << a.mean
                           << " vs " << b.mean << ", standard error "
                           << std::sqrt(a.variance + b.variance));
        CHECK(stat::WelchPValue(a, b) > 1e-5);
      }
    }
  }
}

TEST_CASE("reference: rough reflection and transmission are reciprocal", "[reference]") {
  const Ggx ggx = {0.3, 0.6};
  const Vec3d a = Normalize(Vec3d{0.3, -0.4, 0.8}), b = Normalize(Vec3d{0.5, 0.6, 0.7});
  const Vec3d below = Normalize(Vec3d{-0.1, 0.2, -0.9});
  // f(a, b) = f(b, a); across the interface n_b^2 f(a, b) = n_a^2 f(b, a), where f(a, b)
  // sends radiance from the side of b to that of a.
  CHECK(EvaluateDielectricCos(ggx, 1.5, a, b) / b.z ==
        Approx(EvaluateDielectricCos(ggx, 1.5, b, a) / a.z));
  CHECK(EvaluateDielectricCos(ggx, 1.5, a, below) / -below.z * 2.25 ==
        Approx(EvaluateDielectricCos(ggx, 1.5, below, a) / a.z));
  const Rgb eta = {0.2, 0.9, 1.1}, k = {3.9, 2.5, 2.2};
  CHECK(EvaluateConductorCos(ggx, eta, k, a, b).y / b.z ==
        Approx(EvaluateConductorCos(ggx, eta, k, b, a).y / a.z));
}

TEST_CASE("reference: a lossless clear coat loses nothing", "[reference]") {
  Material coat;
  coat.kind = MaterialKind::kCoatedDiffuse;
  coat.thickness = 0;
  coat.coat_max_depth = 400;
  for (double albedo : {1.0, 0.6}) {
    coat.reflectance.constant = {albedo, albedo, albedo};
    const LocalMaterial local = Local(coat);
    const Vec3d wo = Normalize(Vec3d{0.6, 0, 0.5});
    Random random(4);
    Sum sum;
    for (int i = 0; i < 100000; ++i) {
      const auto s = SampleBsdf(local, wo, random);
      sum.Add(s ? s->weight.x : 0);
    }
    const double expected = closed_form::CoatedFurnace(albedo, 1.5, wo.z);
    INFO(albedo << ": " << sum.Estimate().mean << " vs " << expected);
    CHECK(stat::WelchPValue(sum.Estimate(), {expected, 0, 0}, 1e-5) > 1e-5);
    CHECK(stat::WelchPValue(sum.Estimate(), {expected * 0.99, 0, 0}, 1e-5) < 1e-5);
  }
}

}  // namespace lanelight::reference
