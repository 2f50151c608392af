#include "src/scene/compile/camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "src/base/core/error.h"
#include "src/base/core/pi.h"
#include "src/scene/compile/light_texels.h"

namespace lanelight {
namespace {

constexpr int kBuiltInSize = 256;

// Returns a value above 0 inside a regular polygon with a corner at (0, radius).
double InPolygon(double x, double y, int sides, double radius) {
  double minimum = 1;
  for (int i = 0; i < sides; ++i) {
    const double a = kPi / 2 + (2 * i + 1) * kPi / sides;
    const double inner = radius * std::cos(kPi / sides);
    minimum = std::min(minimum, 1 - (x * std::cos(a) + y * std::sin(a)) / inner);
  }
  return minimum;
}

// A star of five tips, one at (-1, 0): inside at least four of the lines along its sides.
bool InStar(double x, double y) {
  const double inner = std::cos(2 * kPi / 5);  // of the lines from the middle
  int inside = 0;
  for (int i = 0; i < 5; ++i) {
    const double a = (2 * i + 1) * kPi / 5;
    inside += x * std::cos(a) + y * std::sin(a) <= inner;
  }
  return inside >= 4;
}

using Coverage = std::function<double(double x, double y)>;

// pbrt flips its images vertically, so its pentagon stands on a tip.
Coverage BuiltIn(const std::string& name) {
  if (name == "gaussian") {
    return [](double x, double y) {
      return std::max(0.0, std::exp(-x * x - y * y) - std::exp(-1.0));
    };
  }
  if (name == "square") {
    return [](double x, double y) { return std::max(std::abs(x), std::abs(y)) < 0.5; };
  }
  if (name == "pentagon") {
    return [](double x, double y) { return InPolygon(x, -y, 5, 0.8) > 0; };
  }
  if (name == "star") return InStar;
  return nullptr;
}

void Rasterise(const Coverage& coverage, LensSystem& lenses) {
  lenses.aperture_size = kBuiltInSize;
  for (int row = 0; row < kBuiltInSize; ++row) {
    for (int column = 0; column < kBuiltInSize; ++column) {
      lenses.aperture.push_back(static_cast<float>(coverage(
          (2 * column + 1.0) / kBuiltInSize - 1, (2 * row + 1.0) / kBuiltInSize - 1)));
    }
  }
}

void ReadPicture(const Camera& camera, LensSystem& lenses) {
  LightTable table;
  std::vector<Note> notes;
  const LightFile file = {camera.where, "aperture", camera.aperture};
  const LightImage image =
      LightImageTable(table, notes).Load(file, LightImageTable::Use::kGrey);
  if (image.width != image.height) {
    FailAtLight(file, fmt::format("{} x {} pixels; supported are square images",
                                  image.width, image.height));
  }
  lenses.aperture_size = image.width;
  for (int row = image.height - 1; row >= 0; --row) {
    for (int column = 0; column < image.width; ++column) {
      lenses.aperture.push_back(
          table.texels[3 * static_cast<std::size_t>(image.first + row * image.width +
                                                    column)]);
    }
  }
}

}  // namespace

void StoreAperture(const Camera& camera, LensSystem& lenses) {
  if (camera.aperture.empty()) return;
  if (const Coverage coverage = BuiltIn(camera.aperture)) {
    Rasterise(coverage, lenses);
  } else {
    ReadPicture(camera, lenses);
  }
  double sum = 0;
  for (const float v : lenses.aperture) sum += v;
  if (!(sum > 0))
    throw InputError(camera.where,
                     "the image \"" + camera.aperture +
                         "\" of the aperture is black: white lets light through");
  const double scale = kPi / 4 * static_cast<double>(lenses.aperture.size()) / sum;
  for (float& v : lenses.aperture) v = static_cast<float>(v * scale);
}

double ApertureReach(const LensSystem& lenses) {
  if (lenses.aperture.empty()) return 1;
  const int n = lenses.aperture_size;
  double reach = 0;
  for (int row = 0; row < n; ++row) {
    for (int column = 0; column < n; ++column) {
      if (lenses.aperture[static_cast<std::size_t>(row * n + column)] == 0) continue;
      // Bilinear lookup extends a texel to the centres of its neighbours.
      const double x = std::abs(2 * column + 1.0 - n) + 2;
      const double y = std::abs(2 * row + 1.0 - n) + 2;
      reach = std::max(reach, std::hypot(x, y) / n);
    }
  }
  return reach;
}

}  // namespace lanelight
