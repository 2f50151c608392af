// Views that are very narrow or wide, from very far, of one pixel or a hundred million.
#include <fmt/format.h>

#include <numbers>

#include "src/stress/cases/cases.h"
#include "src/stress/cases/points.h"
#include "src/stress/scene_point.h"
#include "src/stress/shapes_text.h"

namespace lanelight::stress {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// A glowing disk across the view, `radius` at `distance` straight ahead of the origin.
std::string GlowingDisk(double distance, double radius) {
  return fmt::format(
      "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [1 1 1] \"bool twosided\" "
      "true\nTranslate 0 0 {:.17g}\nShape \"disk\" \"float radius\" {:.17g}\n"
      "AttributeEnd\n",
      distance, radius);
}

// The disk fills pi / 16 of the square view: half as wide as the view.
Point HalfWideDisk(const std::string& camera, double distance, double radius,
                   SceneText scene) {
  scene.text = camera +
               "PixelFilter \"box\"\nWorldBegin\nMaterial \"diffuse\" \"rgb "
               "reflectance\" [0 0 0]\n" +
               GlowingDisk(distance, radius);
  Point point = MeanOf(RenderText(scene));
  point.expected = std::numbers::pi / 16;
  point.tolerance = 1e-6 * point.expected;
  return point;
}

SceneText Square(int size, std::uint64_t spp, const Effort& effort) {
  SceneText scene;
  scene.settings.resolution = {size, size};
  scene.settings.spp = spp;
  scene.settings.seed = effort.seed;
  return scene;
}

std::string Perspective(double fov) {
  return fmt::format("Camera \"perspective\" \"float fov\" {:.17g}\n", fov);
}

std::vector<Point> FieldOfView(double fov, const Effort& effort) {
  const double half = std::tan(fov / 2 * kDegree);
  return {
      HalfWideDisk(Perspective(fov), 1, half / 2,
                   Square(64, effort(std::uint64_t{16}, std::uint64_t{4096}), effort))};
}

// As above, with the view just wide enough for a unit disk far away.
std::vector<Point> FarObject(double distance, const Effort& effort) {
  const double fov = 2 * std::atan(2 / distance) / kDegree;
  return {
      HalfWideDisk(Perspective(fov), distance, 1,
                   Square(64, effort(std::uint64_t{16}, std::uint64_t{4096}), effort))};
}

// The same for a camera whose own coordinates are scaled.
std::vector<Point> ScaledCamera(double scale, const Effort& effort) {
  const std::string camera =
      fmt::format("Scale {0:.17g} {0:.17g} {0:.17g}\n", scale) + Perspective(90);
  return {
      HalfWideDisk(camera, 1, 0.5,
                   Square(64, effort(std::uint64_t{16}, std::uint64_t{4096}), effort))};
}

std::vector<Point> Orthographic(double distance, const Effort& effort) {
  return {
      HalfWideDisk("Camera \"orthographic\"\n", distance, 0.5,
                   Square(64, effort(std::uint64_t{16}, std::uint64_t{4096}), effort))};
}

// All of it in one pixel.
std::vector<Point> OnePixel(double, const Effort& effort) {
  return {HalfWideDisk(
      Perspective(60), 1, std::tan(30 * kDegree) / 2,
      Square(1, effort(std::uint64_t{65536}, std::uint64_t{1 << 22}), effort))};
}

// 1e8 pixels, of which a few at the edge of the disk are rendered: across it there the
// light falls from 1 to 0, symmetrically within 1e-4 (its curvature). At the foot of the
// crop's centre half of it is lit.
std::vector<Point> HundredMillion(double, const Effort& effort) {
  SceneText scene = Square(10000, effort(std::uint64_t{64}, std::uint64_t{4096}), effort);
  // The disk's rim crosses y = 0 at film x = 1/2, that is pixel 7500 of 10000.
  scene.settings.crop = {7484, 4984, 7516, 5016};
  const double half = std::tan(30 * kDegree);
  Point point = HalfWideDisk(Perspective(60), 1, half / 2, scene);
  // The rim leaves the line x = 7500 by y^2 / (2 r) pixels, r = 2500, |y| < 16.
  point.expected = 0.5 - (16.0 * 16 / 3) / (2 * 2500) / 32;
  point.tolerance = 2e-5;
  return {point};
}

// The quarters of an image, rendered as crops, are the image.
std::vector<Point> Crops(double, const Effort& effort) {
  SceneText whole = Square(32, 16, effort);
  const std::string camera = Perspective(60);
  Point point = HalfWideDisk(camera, 1, std::tan(30 * kDegree) / 2, whole);
  double sum = 0;
  for (const int x : {0, 16}) {
    for (const int y : {0, 16}) {
      SceneText part = Square(32, 16, effort);
      part.settings.crop = {x, y, x + 16, y + 16};
      sum += HalfWideDisk(camera, 1, std::tan(30 * kDegree) / 2, part).measured / 4;
    }
  }
  point.expected = sum;
  point.tolerance = 1e-12;
  point.standard_error = 0;  // the same samples
  return {point};
}

// A lens of any size in front of what is in focus all over the view.
std::vector<Point> Lens(double radius, const Effort& effort) {
  const std::string camera = fmt::format(
      "Camera \"perspective\" \"float fov\" 60 \"float focaldistance\" 1 \"float "
      "lensradius\" {:.17g}\n",
      radius);
  return {
      HalfWideDisk(camera, 1, std::tan(30 * kDegree) / 2,
                   Square(32, effort(std::uint64_t{64}, std::uint64_t{4096}), effort))};
}

}  // namespace

void AddCameraCases(std::vector<Case>& cases) {
  const std::string half = "a disk half as wide as the view is pi / 16 of it";
  Axis fov{"field of view",
           "degrees",
           false,
           1e-4,
           179.99,
           {1e-4, 1e-2, 1, 30, 90, 150, 179, 179.9, 179.99},
           {}};
  fov.full = {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1,     10,     30,
              60,   90,   120,  150,  170,  179, 179.9, 179.99, 179.999};
  cases.push_back({"field-of-view", "geometry", "a view of 1e-4 to 179.99 degrees", half,
                   "", Truth::kClosedForm, fov, FieldOfView});
  cases.push_back({"far-object", "geometry",
                   "a unit disk seen from 1 to 1e9 away, in a view made for it", half,
                   "povray #469: distances above 1e7", Truth::kClosedForm,
                   Decades("distance of the eye", "radii", 0, 10, 2, 0, 8), FarObject});
  cases.push_back({"scaled-camera", "geometry", "a camera under a scale of 1e-8 to 1e8",
                   half, "", Truth::kClosedForm, Decades("scale", "", -8, 8, 4, -8, 8),
                   ScaledCamera});
  cases.push_back({"orthographic-distance", "geometry",
                   "an orthographic camera 1 to 1e6 away", half, "", Truth::kClosedForm,
                   Decades("distance", "", 0, 8, 2, 0, 6), Orthographic});
  cases.push_back({"one-pixel", "geometry", "an image of one pixel", half, "",
                   Truth::kClosedForm, Single(), OnePixel});
  cases.push_back({"hundred-million-pixels", "geometry",
                   "an image of 10000 x 10000 pixels, 32 x 32 of them at a disk's rim",
                   "half of them are lit", "", Truth::kClosedForm, Single(),
                   HundredMillion});
  cases.push_back({"crops", "geometry", "an image in four crops",
                   "they have the same mean, to the last bit of a double", "",
                   Truth::kInvariance, Single(), Crops});
  cases.push_back({"lens-in-focus", "geometry",
                   "a lens of radius 1e-6 to 1e4 at a distance of 1 from what is sharp",
                   half, "", Truth::kClosedForm,
                   Decades("lens radius", "", -6, 4, 2, -6, 3), Lens});
}

}  // namespace lanelight::stress
