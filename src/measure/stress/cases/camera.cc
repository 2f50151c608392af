// Views that are very narrow or wide, from very far, of one pixel or a hundred million.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "src/measure/stress/cases/cases.h"
#include "src/measure/stress/cases/points.h"
#include "src/measure/stress/cases/scene_text.h"

namespace lanelight::stress {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
const double kHalf = std::tan(30 * kDegree);  // of a view of 60 degrees, at distance 1

const Quality kQuality = {.quick = 16, .full = 4096, .size = 64, .relative = 1e-6};

std::string Perspective(double fov) {
  return fmt::format("Camera \"perspective\" \"float fov\" {:.17g}\n", fov);
}

// A glowing disk across the view, `radius` at `distance` straight ahead of the origin.
std::string DiskAhead(const std::string& camera, double distance, double radius) {
  return camera + "PixelFilter \"box\"\nWorldBegin\nMaterial " + Diffuse(0) + "\n" +
         Block(Glow(1, true) + fmt::format("Translate 0 0 {:.17g}\nShape \"disk\" "
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
  return HalfWideDisk(DiskAhead(Perspective(fov), 1, half / 2), kQuality, effort);
}

// As above, with the view just wide enough for a unit disk far away.
std::vector<Point> FarObject(double distance, const Effort& effort) {
  const double fov = 2 * std::atan(2 / distance) / kDegree;
  return HalfWideDisk(DiskAhead(Perspective(fov), distance, 1), kQuality, effort);
}

// The same for a camera whose own coordinates are scaled.
std::vector<Point> ScaledCamera(double scale, const Effort& effort) {
  const std::string camera =
      fmt::format("Scale {0:.17g} {0:.17g} {0:.17g}\n", scale) + Perspective(90);
  return HalfWideDisk(DiskAhead(camera, 1, 0.5), kQuality, effort);
}

std::vector<Point> Orthographic(double distance, const Effort& effort) {
  return HalfWideDisk(DiskAhead("Camera \"orthographic\"\n", distance, 0.5), kQuality,
                      effort);
}

// All of it in one pixel.
std::vector<Point> OnePixel(double, const Effort& effort) {
  Quality quality = kQuality;
  quality.quick = 65536, quality.full = 1 << 22, quality.size = 1;
  return HalfWideDisk(DiskAhead(Perspective(60), 1, kHalf / 2), quality, effort);
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

// The quarters of an image, rendered as crops, are the image.
std::vector<Point> Crops(double, const Effort& effort) {
  SceneText scene = Setup(DiskAhead(Perspective(60), 1, kHalf / 2),
                          {.quick = 16, .full = 16, .size = 32}, effort);
  Point point = MeanOf(RenderText(scene));
  for (const int x : {0, 16}) {
    for (const int y : {0, 16}) {
      scene.settings.crop = {x, y, x + 16, y + 16};
      point.expected += MeanOf(RenderText(scene)).measured / 4;
    }
  }
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
  return HalfWideDisk(DiskAhead(camera, 1, kHalf / 2),
                      {.quick = 64, .full = 4096, .size = 32, .relative = 1e-6}, effort);
}

}  // namespace

void AddCameraCases(std::vector<Case>& cases) {
  const auto add = [&](const char* name, const char* extreme, const Axis& axis,
                       auto measure, const char* source = "") {
    cases.push_back({name, "geometry", extreme,
                     "a disk half as wide as the view is pi / 16 of it", source,
                     Truth::kClosedForm, axis, measure});
  };
  Axis fov{"field of view",
           "degrees",
           false,
           1e-4,
           179.99,
           {1e-4, 1e-2, 1, 30, 90, 150, 179, 179.9, 179.99},
           {}};
  fov.full = {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1,     10,     30,
              60,   90,   120,  150,  170,  179, 179.9, 179.99, 179.999};
  add("field-of-view", "a view of 1e-4 to 179.99 degrees", fov, FieldOfView);
  add("far-object", "a unit disk seen from 1 to 1e9 away, in a view made for it",
      DecadesAxis("distance of the eye", "radii", {0, 10, 2}, {0, 8}), FarObject,
      "povray #469: distances above 1e7");
  add("scaled-camera", "a camera under a scale of 1e-8 to 1e8",
      DecadesAxis("scale", "", {-8, 8, 4}, {-8, 8}), ScaledCamera);
  add("orthographic-distance", "an orthographic camera 1 to 1e6 away",
      DecadesAxis("distance", "", {0, 8, 2}, {0, 6}), Orthographic);
  add("one-pixel", "an image of one pixel", Single(), OnePixel);
  cases.push_back({"hundred-million-pixels", "geometry",
                   "an image of 10000 x 10000 pixels, 32 x 32 of them at a disk's rim",
                   "half of them are lit", "", Truth::kClosedForm, Single(),
                   HundredMillion});
  cases.push_back({"crops", "geometry", "an image in four crops",
                   "they have the same mean, to the last bit of a double", "",
                   Truth::kInvariance, Single(), Crops});
  add("lens-in-focus",
      "a lens of radius 1e-6 to 1e4 at a distance of 1 from what is sharp",
      DecadesAxis("lens radius", "", {-6, 4, 2}, {-6, 3}), Lens);
}

}  // namespace lanelight::stress
