// Path reuse (reuse=block): first and second vertices at any distance, in a corner, and
// behind metals on both sides of the least alpha that is shared.
#include <fmt/format.h>

#include <cmath>

#include "src/measure/stress/cases/cases.h"
#include "src/measure/stress/cases/points.h"
#include "src/measure/stress/cases/scene_text.h"
#include "src/measure/stress/closed_forms.h"

namespace lanelight::stress {
namespace {

const char* const kLayouts[] = {"block:64", "block:16:compact"};

constexpr int kSeeds = 32;

// Pixels of a tile depend on each other: the error is what images of several seeds differ
// by.
Point ReusePoint(const std::string& reuse, double expected, const std::string& text,
                 int depth, const Effort& effort) {
  Quality quality = {16, 512, depth, 16};
  quality.strategy = "roulette=none,reuse=" + reuse;
  SceneText scene = Setup(text, quality, effort);
  Point sum;
  double mean = 0, squares = 0;
  for (int i = 1; i <= kSeeds; ++i) {
    scene.settings.seed = effort.seed * kSeeds + i;
    const Point one = Expect(expected, scene);
    const double delta = one.measured - mean;
    mean += delta / i;
    squares += delta * (one.measured - mean);
    sum.invalid += one.invalid;
    sum.samples += one.samples, sum.rays += one.rays;
    sum.lanes_used += one.lanes_used, sum.lane_slots += one.lane_slots;
    sum.seconds += one.seconds;
    sum.expected = one.expected, sum.tolerance = one.tolerance;
  }
  sum.series = reuse;
  sum.measured = mean;
  sum.standard_error = std::sqrt(squares / (kSeeds - 1) / kSeeds);
  sum.degrees_of_freedom = kSeeds - 1;
  return sum;
}

// All distances of a closed room at once: densities by area go with their square.
std::vector<Point> ByDistance(double radius, const Effort& effort) {
  const std::string room = ViewFrom({0.05 * radius, 0.08 * radius, 0.75 * radius}, 50) +
                           Walls(0.2, 0.8, radius);
  std::vector<Point> points;
  for (const char* layout : kLayouts) {
    points.push_back(
        ReusePoint(layout, ClosedRoom(double(0.2f), double(0.8f), 8), room, 8, effort));
  }
  return points;
}

// The right angle between two planes, which sees `half` to each side of the edge.
std::string Corner(double half, const std::string& wall) {
  return fmt::format(
             "LookAt 1 0 1  0 0 0  0 1 0\nCamera \"orthographic\" \"float "
             "screenwindow\" [{0:.17g} {1:.17g} {0:.17g} {1:.17g}]\n"
             "PixelFilter \"box\"\nWorldBegin\n",
             -half, half) +
         Sky(1) + Plane(Diffuse(0.8)) + Block("Rotate 90 0 1 0\n" + Plane(wall));
}

// Nothing in a corner has a size: each plane has the radiance of the series of albedo /
// 2, as each sees half of the sky and half of the other. At the edge both vertices of a
// path come together.
std::vector<Point> ByCorner(double half, const Effort& effort) {
  double expected = 0, term = 1;
  for (int event = 1; event <= 8; ++event) expected += term *= 0.5 * double(0.8f);
  std::vector<Point> points;
  for (const char* layout : kLayouts) {
    points.push_back(ReusePoint(layout, expected, Corner(half, Diffuse(0.8)), 8, effort));
  }
  return points;
}

// A room whose walls emit inwards, with black stripes around it that reflect nothing. The
// camera in the middle sees as much of the black as of the rest. From every point of a
// sphere all others are seen alike, so that what arrives is the series of half the
// albedo. A black first vertex finds nothing: a density that it had would take from the
// others.
std::vector<Point> ByBlackStripes(double stripes, const Effort& effort) {
  const double albedo = double(0.8f), emission = double(0.2f);
  const std::string text = fmt::format(
      "LookAt 0 0 0  1 0 0  0 0 1\nCamera \"perspective\" \"float fov\" 80\n"
      "PixelFilter \"box\"\nWorldBegin\n"
      "Texture \"stripes\" \"spectrum\" \"checkerboard\" \"float uscale\" {:.17g}\n"
      "  \"float vscale\" 0.5 {} {}\n",
      stripes, Grey("tex1", 0), Grey("tex2", albedo));
  const std::string walls =
      Block(AreaLightText(emission) + "ReverseOrientation\n" +
            Sphere({}, 4, "\"diffuse\" \"texture reflectance\" \"stripes\""));
  const double arrives = ClosedRoom(emission, albedo / 2, 7);
  std::vector<Point> points;
  for (const char* layout : kLayouts) {
    points.push_back(
        ReusePoint(layout, emission + albedo / 2 * arrives, text + walls, 8, effort));
  }
  return points;
}

// A metal in the corner, seen from the diffuse floor, held against paths of their own.
std::vector<Point> BySharedAlpha(double alpha, const Effort& effort) {
  const std::string scene = Corner(1, Metal(0.8, alpha, alpha));
  const Point alone = ReusePoint("none", 1, scene, 4, effort);
  std::vector<Point> points;
  for (const char* layout : kLayouts) {
    points.push_back(ReusePoint(layout, alone.measured, scene, 4, effort));
    Point& point = points.back();
    point.standard_error = std::hypot(point.standard_error, alone.standard_error);
  }
  return points;
}

}  // namespace

void AddReuseCases(std::vector<Case>& cases) {
  const CaseAdder closed{cases, "transport", Truth::kClosedForm};
  const CaseAdder twins{cases, "transport", Truth::kTwin};
  closed({"reuse-distance", "path vertices 1e-6 to 1e6 apart, with reuse=block",
          "the radiance in a closed box is 1",
          LogAxis("radius of the room", "", {1e-6, 1e6}, Decades(-6, 6, 3),
                  Decades(-12, 12, 2)),
          ByDistance});
  closed({"reuse-corner", "first and second vertices that converge in a corner",
          "both planes have the radiance of the series, at any distance",
          LogAxis("half of the radiance", "", {1e-4, 100}, Decades(-4, 2, 2),
                  Decades(-6, 4)),
          ByCorner});
  closed({"reuse-black", "black surfaces that emit on one side, beside diffuse ones",
          "every stripe has the radiance of the series",
          LogAxis("stripes", "", {2, 512}, {2, 16, 128}, {2, 4, 8, 16, 32, 64, 128, 512}),
          ByBlackStripes});
  twins({"reuse-alpha",
         "metal at the second vertex, across the smallest alpha that paths share",
         "the image of reuse=none",
         LogAxis("alpha", "", {1e-3, 1}, {1e-3, 0.09, 0.11, 0.3},
                 {1e-3, 0.03, 0.09, 0.0999, 0.1001, 0.11, 0.3, 1}),
         BySharedAlpha});
}

}  // namespace lanelight::stress
