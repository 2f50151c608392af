// Views that are very narrow or wide or from very far, lenses and filters of any radius.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "tests/extremes/check_points.h"

namespace lanelight::stress {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
const double kHalf = std::tan(30 * kDegree);  // of a view of 60 degrees, at distance 1

const Quality kViewQuality = {.quick = 16, .full = 4096, .size = 64, .relative = 1e-6};

std::string Perspective(double fov) {
  return fmt::format("Camera \"perspective\" \"float fov\" {:.17g}\n", fov);
}

// A glowing disk across the view, `radius` at `distance` straight ahead of the origin.
std::string DiskAhead(const std::string& camera, double distance, double radius) {
  return camera + "PixelFilter \"box\"\nWorldBegin\nMaterial " + Diffuse(0) + "\n" +
         Block(AreaLightText(1, true) +
               fmt::format("Translate 0 0 {:.17g}\nShape \"disk\" "
                           "\"float radius\" {:.17g}",
                           distance, radius));
}

// The disk fills pi / 16 of the square view: half as wide as the view.
std::vector<Point> HalfWideDisk(const std::string& text, const Quality& quality,
                                const Effort& effort) {
  return {Expect(std::numbers::pi / 16, text, quality, effort)};
}

std::vector<Point> FieldOfView(double fov, const Effort& effort) {
  const double half = std::tan(fov / 2 * kDegree);
  return HalfWideDisk(DiskAhead(Perspective(fov), 1, half / 2), kViewQuality, effort);
}

// As above, with the view just wide enough for a unit disk far away.
std::vector<Point> FarObject(double distance, const Effort& effort) {
  const double fov = 2 * std::atan(2 / distance) / kDegree;
  return HalfWideDisk(DiskAhead(Perspective(fov), distance, 1), kViewQuality, effort);
}

// The same for a camera whose own coordinates are scaled.
std::vector<Point> ScaledCamera(double scale, const Effort& effort) {
  const std::string camera =
      fmt::format("Scale {0:.17g} {0:.17g} {0:.17g}\n", scale) + Perspective(90);
  return HalfWideDisk(DiskAhead(camera, 1, 0.5), kViewQuality, effort);
}

std::vector<Point> Orthographic(double distance, const Effort& effort) {
  return HalfWideDisk(DiskAhead("Camera \"orthographic\"\n", distance, 0.5), kViewQuality,
                      effort);
}

// 1e8 pixels, of which a few at the edge of the disk are rendered: across it there the
// light falls from 1 to 0, symmetrically within 1e-4 (its curvature). At the foot of the
// crop's centre half of it is lit.
std::vector<Point> HundredMillion(double, const Effort& effort) {
  SceneText scene = Setup(DiskAhead(Perspective(60), 1, kHalf / 2),
                          {.quick = 64, .full = 4096, .size = 10000}, effort);
  // The disk's rim crosses y = 0 at film x = 1/2, that is pixel 7500 of 10000.
  scene.settings.crop = {7484, 4984, 7516, 5016};
  // The rim leaves the line x = 7500 by y^2 / (2 r) pixels, r = 2500, |y| < 16.
  Point point = Expect(0.5 - (16.0 * 16 / 3) / (2 * 2500) / 32, scene);
  point.tolerance = 2e-5;
  return {point};
}

// Something that is not in view.
std::string Aside() { return Sphere({50, 0, 0}, 1, Diffuse(0)); }

std::vector<Point> BySamples(double spp, const Effort& effort) {
  SceneText scene = Setup(ViewOfPlane() + Sky(1.0 / 3) + Aside(), {1, 1, 1, 2}, effort);
  scene.settings.spp = static_cast<std::uint64_t>(spp);
  Point point = Expect(1.0 / 3, scene);
  point.tolerance = 1e-7;
  point.standard_error = 0;  // all samples are equal; a single one shows no scatter
  return {point};
}

std::vector<Point> ByFilterRadius(double radius, const Effort& effort) {
  std::vector<Point> points;
  for (const char* kind : {"box", "triangle", "gaussian", "mitchell", "sinc"}) {
    std::string text = ViewOfPlane() + Sky(1) + Aside();
    const std::string filter = fmt::format(
        "PixelFilter \"{}\" \"float xradius\" {:.17g} \"float yradius\" {:.17g}", kind,
        radius, radius);
    const std::string box = "PixelFilter \"box\"";
    text.replace(text.find(box), box.size(), filter);
    points.push_back(Named(kind, Expect(1, text, {256, 16384, 1, 4}, effort)));
  }
  return points;
}

// The edge of a lamp through the middle of the image: half of what any round lens sees.
Point HalfPlane(const std::string& series, double lens, double focus,
                const Effort& effort) {
  // Rays meet the lamp's plane up to the radius times |1 - 1 / focus| aside.
  const double wide = 2 * (1 + lens * std::abs(1 - 1 / focus));
  const std::string text =
      fmt::format(
          "LookAt 0 0 0  0 0 1  0 1 0\nCamera \"perspective\" \"float fov\" 40 "
          "\"float lensradius\" {:.17g} \"float focaldistance\" {:.17g}\n",
          lens, focus) +
      "PixelFilter \"box\"\nWorldBegin\n" + AreaLightText(1, true) +
      Rectangle({0, -wide, 1}, {wide, wide, 1});
  return Named(series, Expect(0.5, text, {64, 4096, 1}, effort));
}

std::vector<Point> ByLens(double lens, const Effort& effort) {
  return {HalfPlane("in focus", lens, 1, effort),
          HalfPlane("focus at 1e6", lens, 1e6, effort),
          HalfPlane("focus at 1e-3", lens, 1e-3, effort)};
}

std::vector<Point> ByFocus(double focus, const Effort& effort) {
  return {HalfPlane("lens 0.1", 0.1, focus, effort),
          HalfPlane("lens 10", 10, focus, effort)};
}

std::string Lamp(double x0, double x1) {
  return Block(AreaLightText(1, true) + Rectangle({x0, -2, 0}, {x1, 2, 0}));
}

// One pixel, half of it covered by a lamp: to one side of its middle (the other sample of
// a pair is on the other side), around its middle (the same side), or slightly aside.
std::vector<Point> ByEdge(double aside, const Effort& effort) {
  std::vector<Point> points;
  for (const char* pairs : {"none", "antithetic"}) {
    Quality quality = {1024, 65536, 1, 1};
    quality.strategy = fmt::format("points=independent,pairs={}", pairs);
    const auto measure = [&](const char* name, double expected, const std::string& lamp) {
      points.push_back(
          Named(fmt::format("{}, {}", name, quality.strategy),
                Expect(expected, ViewOfPlane(1, 1) + lamp, quality, effort)));
    };
    measure("odd", (1 - aside) / 2, Lamp(-2, -aside));
    // Few samples fall between the edge and the middle, where pairs do not cancel.
    points.back() = AllowForRareSamples(points.back(), aside, 1);
    measure("even", 0.5 - aside / 2, Lamp(-0.5 + aside / 2, 0.5 - aside / 2));
  }
  return points;
}

}  // namespace

TEST_CASE("extremes: fields of view of 1e-4 to 179.99 degrees") {
  CheckPoints({1e-4, 1e-2, 1, 30, 90, 150, 179, 179.9, 179.99}, FieldOfView);
}
// povray #469: distances above 1e7.
TEST_CASE("extremes: a disk 1 to 1e8 radii away, in a view made for it") {
  CheckPoints(Decades(0, 8, 2), FarObject);
}
TEST_CASE("extremes: cameras under a scale of 1e-8 to 1e8") {
  CheckPoints(Decades(-8, 8, 4), ScaledCamera);
}
TEST_CASE("extremes: orthographic cameras 1 to 1e6 away") {
  CheckPoints(Decades(0, 6, 2), Orthographic);
}
TEST_CASE("extremes: a crop of an image of 1e8 pixels") { CheckPoints(HundredMillion); }
TEST_CASE("extremes: a sky has its radiance after 1 to 1e5 samples per pixel") {
  CheckPoints(Decades(0, 5), BySamples);
}
TEST_CASE("extremes: every pixel filter of radius 1e-3 to 100") {
  CheckPoints({1e-3, 0.5, 2, 10, 100}, ByFilterRadius);
}
TEST_CASE("extremes: lenses of radius 1e-6 to 1e3, in focus and out of it") {
  CheckPoints(Decades(-6, 3, 3), ByLens);
}
TEST_CASE("extremes: focal distances of 1e-6 to 1e9") {
  CheckPoints(Decades(-6, 9, 3), ByFocus);
}
TEST_CASE(
    "extremes: antithetic pairs keep the mean of edges 1e-6 to 0.5 pixels off centre") {
  CheckPoints({1e-6, 1e-4, 0.01, 0.1, 0.5}, ByEdge);
}

}  // namespace lanelight::stress
