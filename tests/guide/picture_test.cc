// The picture of a guide: what it must be whatever has been learned, and that it shows
// it.
#include "tests/support/guide_picture.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "src/core/error.h"

namespace lanelight {
namespace {

Job Scene(const char* name) {
  RenderSettings settings;
  settings.resolution = {32, 32};
  return PrepareJob(std::string(LANELIGHT_SOURCE_DIR) + "/scenes/" + name, settings);
}

// Of half the picture: left or right.
double MeanInDisk(const GuidePicture& picture, int left, int side) {
  double sum = 0, n = 0;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      if (std::hypot(2 * x + 1 - side, 2 * y + 1 - side) >= side) continue;
      sum += double{picture.image.At(left + x, y, 0)}, n += 1;
    }
  }
  return sum / n;
}

}  // namespace

TEST_CASE("the picture of a guide shows densities, and those that arrive", "[guide]") {
  const Job job = Scene("cornell-box.pbrt");
  GuidePictureOptions options;
  options.x = 16, options.y = 28;  // the floor, in front
  options.samples = 1u << 20;
  options.side = 256;
  const GuidePicture picture = PictureOfGuide(job, options);
  const int right = picture.image.width - options.side;
  REQUIRE(picture.image.height == options.side);
  // Over the cosine's, whose measure is the area of the picture: 1 on average. Squares
  // end at pixels, and the rim is cut.
  CHECK(MeanInDisk(picture, 0, options.side) == Approx(1).epsilon(0.02));
  CHECK(MeanInDisk(picture, right, options.side) == Approx(1).epsilon(0.02));
  CHECK(picture.cells > 10);
  CHECK(picture.bright_cosine > 1.2);
  CHECK(std::abs(Length(picture.normal) - 1) < 1e-3);
  // What has been learned is what arrives: correlated, by far more than chance.
  double xy = 0, xx = 0, yy = 0;
  for (int y = 0; y < options.side; y += 4) {
    for (int x = 0; x < options.side; x += 4) {
      if (std::hypot(2 * x + 1 - options.side, 2 * y + 1 - options.side) >=
          options.side) {
        continue;
      }
      const double a = double{picture.image.At(x, y, 0)} - 1;
      const double b = double{picture.image.At(right + x, y, 0)} - 1;
      xy += a * b, xx += a * a, yy += b * b;
    }
  }
  CHECK(xy / std::sqrt(xx * yy) > 0.4);
  const Image colors = ColoredGuide(picture);
  CHECK(colors.width == picture.image.width);
  CHECK(colors.At(0, 0, 0) == 0);  // outside: black
}

TEST_CASE("pixels without a guide are refused", "[guide]") {
  GuidePictureOptions options;
  options.samples = 1u << 18;
  options.x = 32, options.y = 0;
  const Job box = Scene("cornell-box.pbrt");
  CHECK_THROWS_AS(PictureOfGuide(box, options), InputError);
  options.x = -1;
  CHECK_THROWS_AS(PictureOfGuide(box, options), InputError);
  // What is behind everything.
  options.x = options.y = 0;
  CHECK_THROWS_AS(PictureOfGuide(Scene("furnace.pbrt"), options), InputError);
}

}  // namespace lanelight
