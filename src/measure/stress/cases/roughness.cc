// Microfacets from alpha 1 to nothing, and materials seen at grazing angles.
#include <fmt/format.h>

#include <cmath>

#include "src/base/core/pi.h"
#include "src/measure/stress/cases/cases.h"
#include "src/measure/stress/cases/points.h"
#include "src/measure/stress/cases/scene_text.h"
#include "src/measure/stress/closed_forms.h"

namespace lanelight::stress {
namespace {

constexpr double kMetalK = 6;          // extinction of a metal of reflectance 0.9
constexpr double kQuadrature = 1e-4;   // error of IntegrateGgx
constexpr double kSmoothAlpha = 1e-3;  // below it surfaces are smooth (docs/numbers.md)

std::string GlossyMetal(double alpha_x, double alpha_y) {
  return Metal(0.9, alpha_x, alpha_y);
}

double MetalFresnel(double c) { return FresnelConductor(c, 1, kMetalK); }

// Returns what a plane of metal reflects of a sky of radiance 1.
double MetalFurnace(double alpha_x, double alpha_y, double cosine) {
  if (std::max(alpha_x, alpha_y) < kSmoothAlpha) return MetalFresnel(cosine);
  return IntegrateGgx(alpha_x, alpha_y, cosine, 0, MetalFresnel).reflected;
}

// Returns the radiance of a glass surface under a sky of radiance 1 on both sides.
// Refraction from above divides radiance by eta^2.
double GlassFurnace(double alpha, double eta, double cosine) {
  const auto fresnel = [eta](double c) { return FresnelDielectric(c, eta); };
  const double f = fresnel(cosine);
  if (alpha < kSmoothAlpha) return f + (1 - f) / (eta * eta);
  const GgxAlbedo albedo = IntegrateGgx(alpha, alpha, cosine, eta, fresnel);
  return albedo.reflected + albedo.transmitted / (eta * eta);
}

Point Integrated(const std::string& series, const std::string& material, double expected,
                 double cosine, const Effort& effort) {
  Point point = PlaneFurnace(expected, material, cosine, effort);
  point.tolerance = kQuadrature * expected;
  return Named(series, point);
}

std::vector<Point> MetalByAlpha(double alpha, const Effort& effort) {
  std::vector<Point> points;
  for (double cosine : {1.0, 0.5, 0.05}) {
    points.push_back(Integrated(fmt::format("cosine {}", cosine),
                                GlossyMetal(alpha, alpha),
                                MetalFurnace(alpha, alpha, cosine), cosine, effort));
  }
  return points;
}

std::vector<Point> GlassByAlpha(double alpha, const Effort& effort) {
  std::vector<Point> points;
  for (double cosine : {1.0, 0.3}) {
    for (double eta : {1.5, 0.75}) {
      points.push_back(Integrated(fmt::format("index {}, cosine {}", eta, cosine),
                                  Glass(eta, alpha), GlassFurnace(alpha, eta, cosine),
                                  cosine, effort));
    }
  }
  return points;
}

std::vector<Point> ByAnisotropy(double ratio, const Effort& effort) {
  // The narrow side is at least the least alpha that there is.
  const double narrow = std::max(1 / ratio, 1e-4);
  return {Integrated("rough along x", GlossyMetal(1, 1 / ratio),
                     MetalFurnace(1, narrow, 0.5), 0.5, effort),
          Integrated("rough along y", GlossyMetal(1 / ratio, 1),
                     MetalFurnace(narrow, 1, 0.5), 0.5, effort)};
}

// A metal plane shows a lamp that fills a cone of 20 degrees around the mirrored view.
// GGX puts at most the share (alpha / tan 10 deg)^2 of its normals farther out.
std::vector<Point> AgainstMirror(double alpha, const Effort& effort) {
  const std::string text = ViewOfPlane(std::sqrt(0.5)) +
                           SphereLight({-10 * std::sqrt(0.5), 0, 10 * std::sqrt(0.5)},
                                       10 * std::sin(20 * kPi / 180), 1) +
                           Plane(GlossyMetal(alpha, alpha));
  const double mirror = MetalFresnel(std::sqrt(0.5));
  Point point = Expect(mirror, text, {.depth = 1}, effort);
  const double tail = std::pow(alpha / std::tan(10 * kPi / 180), 2);
  point.tolerance += mirror * std::min(1.0, 2 * tail);
  return {point};
}

std::vector<Point> Grazing(double cosine, const Effort& effort) {
  const double glass = GlassFurnace(0, 1.5, cosine);
  std::vector<Point> points = {
      Integrated("diffuse", Diffuse(0.5), 0.5, cosine, effort),
      Integrated("mirror", GlossyMetal(0, 0), MetalFurnace(0, 0, cosine), cosine, effort),
      Integrated("metal, alpha 0.1", GlossyMetal(0.1, 0.1),
                 MetalFurnace(0.1, 0.1, cosine), cosine, effort),
      Integrated("glass", Glass(1.5), glass, cosine, effort),
      Integrated("glass, alpha 0.1", Glass(1.5, 0.1), GlassFurnace(0.1, 1.5, cosine),
                 cosine, effort),
      Integrated("coat",
                 "\"coateddiffuse\" \"float roughness\" 0 \"float thickness\" 0 "
                 "\"integer maxdepth\" 1000 \"rgb reflectance\" [0.5 0.5 0.5]",
                 CoatFurnace({0.5, 1.5, 0, 500}, cosine), cosine, effort)};
  // Light that a face transmits weakly is carried by as few samples.
  for (Point& point : points) {
    const bool glass = point.series == "glass" || point.series == "coat";
    if (glass && cosine < 0.01) point = AllowForRareSamples(point, 1 - point.expected, 1);
  }
  return points;
}

}  // namespace

void AddRoughnessCases(std::vector<Case>& cases) {
  const CaseAdder twins{cases, "materials", Truth::kTwin};
  const CaseAdder invariant{cases, "materials", Truth::kInvariance};
  twins({"ggx-metal-alpha", "roughness of a metal, alpha from 1e-8 to 1",
         "white furnace test: the albedo of single scattering, integrated over slopes",
         LogAxis("GGX alpha", "", {0, 1}, Decades(-8, 0, 1), Decades(-8, 0, 0.5)),
         MetalByAlpha});
  twins({"ggx-glass-alpha", "roughness of glass, alpha from 1e-8 to 1",
         "white furnace test: reflection and refraction equal the integral over slopes",
         LogAxis("GGX alpha", "", {0, 1}, Decades(-8, 0, 2), Decades(-8, 0, 0.5)),
         GlassByAlpha});
  twins({"ggx-anisotropy", "roughness 1 along one axis, 1 to 1e-8 along the other",
         "white furnace test: the integral over slopes",
         LogAxis("ratio of the alphas", "", {1, 1e8}, Decades(0, 8, 2), Decades(0, 8)),
         ByAnisotropy});
  invariant({"roughness-against-mirror", "alpha so small that the metal is a mirror",
             "a lamp of 20 degrees reflects as in a mirror, except for the tail of GGX",
             LogAxis("GGX alpha", "", {0, 0.01}, Decades(-8, -2)), AgainstMirror,
             "pbrt-v3 #214"});
  twins({"grazing-view", "materials seen under a cosine of 1 to 1e-7",
         "white furnace test: every material returns its albedo for that angle",
         LogAxis("cosine of the view", "", {1e-7, 1}, Decades(-7, 0, 1)), Grazing});
}

}  // namespace lanelight::stress
