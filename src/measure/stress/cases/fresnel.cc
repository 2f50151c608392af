// Fresnel terms on their own, beside the same in double precision.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernels/probe/fresnel_probe.h"
#include "src/measure/stress/cases/cases.h"
#include "src/measure/stress/cases/points.h"
#include "src/measure/stress/closed_forms.h"

namespace lanelight::stress {
namespace {

constexpr double kRelative = 3e-5;  // error that kernels/bsdf/fresnel-inl.h promises

// Rounded as the kernels get it.
struct Incidence {
  float cosine, eta, k;  // k < 0: a dielectric
  double Exact(double c) const {
    return k < 0 ? FresnelDielectric(c, eta) : FresnelConductor(c, eta, k);
  }
};

float Kernel(SimdTarget target, const Incidence& at) {
  const std::vector<float> c(kFresnelPadding, at.cosine), eta(kFresnelPadding, at.eta),
      k(kFresnelPadding, at.k);
  std::vector<float> out(kFresnelPadding);
  ProbeFresnel(target,
               {1, c.data(), eta.data(), at.k < 0 ? nullptr : k.data(), out.data()});
  return out[0];
}

// What the term may be off by: of itself, and by what a rounding of the cosine does.
Point Compare(const std::string& series, SimdTarget target, const Incidence& at) {
  Point point;
  point.series = series;
  point.expected = at.Exact(at.cosine);
  point.measured = Kernel(target, at);
  const double rounded = std::min(1.0, at.cosine * (1 + 0x1p-22));
  const double slope = std::abs(at.Exact(rounded) - at.Exact(at.cosine * (1 - 0x1p-22)));
  point.tolerance = kRelative * point.expected + slope;
  return point;
}

std::vector<Point> Dielectric(double contrast, const Effort& effort) {
  std::vector<Point> points;
  for (double cosine : {1.0, 0.5, 0.01, 1e-4, 1e-7}) {
    for (const bool denser : {true, false}) {
      const double eta = denser ? 1 + contrast : 1 / (1 + contrast);
      points.push_back(Compare(
          fmt::format("into the {}, cosine {:g}", denser ? "denser" : "thinner", cosine),
          effort.target, {static_cast<float>(cosine), static_cast<float>(eta), -1}));
    }
  }
  return points;
}

std::vector<Point> Critical(double distance, const Effort& effort) {
  std::vector<Point> points;
  for (double eta : {0.999, 0.75, 0.1}) {
    const double critical = std::sqrt((1 - eta) * (1 + eta));
    const double cosine = critical + distance * (1 - critical);
    points.push_back(Compare(fmt::format("index {}", eta), effort.target,
                             {static_cast<float>(cosine), static_cast<float>(eta), -1}));
  }
  return points;
}

std::vector<Point> ByExtinction(double extinction, const Effort& effort) {
  std::vector<Point> points;
  for (double eta : {0.01, 1.0, 100.0}) {
    for (double cosine : {1.0, 0.1, 1e-4, 1e-7}) {
      points.push_back(Compare(fmt::format("index {}, cosine {:g}", eta, cosine),
                               effort.target,
                               {static_cast<float>(cosine), static_cast<float>(eta),
                                static_cast<float>(extinction)}));
    }
  }
  return points;
}

}  // namespace

void AddFresnelCases(std::vector<Case>& cases) {
  const CaseAdder add{cases, "materials", Truth::kTwin};
  add({"fresnel-dielectric",
       "index of refraction from 1 + 1e-7 to 1e3, cosines from 1 to 1e-7",
       "the reflectance is that of double precision, within 3e-5 of itself",
       LogAxis("index - 1", "", {1e-7, 99}, Decades(-7, 3), Decades(-7, 3, 0.1)),
       Dielectric, "Ignis #16"});
  add({"fresnel-critical-angle",
       "cosines from 1 to 1e-7 above that of the critical angle",
       "the reflectance is that of double precision, but for a rounding of the "
       "cosine",
       LogAxis("cosine above the critical", "", {1e-7, 1}, Decades(-7, 0),
               Decades(-7, 0, 0.1)),
       Critical});
  add({"fresnel-metal", "extinction from 1e-9 to 1e9",
       "the reflectance is that of complex numbers in double precision",
       LogAxis("extinction", "", {1e-9, 1e9}, Decades(-9, 9, 1.5), Decades(-9, 12, 0.25)),
       ByExtinction});
}

}  // namespace lanelight::stress
