#include "src/measure/compare/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/base/image/pixel_rect.h"
#include "src/measure/compare/linear_image.h"

namespace lanelight {
namespace {

constexpr int kColumns = 4, kGap = 4;  // pictures in a row; pixels between them
constexpr Vec3d kGapColor = {1, 1, 1}, kInvalid = {0.2, 0.2, 0.2};
// Linear colours.
constexpr Vec3d kDarker = {0.02, 0.1, 0.55}, kBrighter = {0.55, 0.03, 0.03},
                kEqual = {0.9, 0.9, 0.9};
constexpr Vec3d kFlipColors[] = {
    {0, 0, 0}, {0.35, 0.01, 0.08}, {0.9, 0.3, 0.02}, {1, 1, 0.8}};

Vec3d Mix(Vec3d a, Vec3d b, double weight) { return a * (1 - weight) + b * weight; }

// x from -1 to 1.
Vec3d DifferenceColor(double x) {
  if (!std::isfinite(x)) return kInvalid;
  return Mix(kEqual, x < 0 ? kDarker : kBrighter, std::min(1.0, std::abs(x)));
}

// x from 0 to 1.
Vec3d FlipColor(double x) {
  constexpr int kSteps = std::size(kFlipColors) - 1;
  const double at = std::clamp(x, 0.0, 1.0) * kSteps;
  const int step = std::min(kSteps - 1, int(at));
  return Mix(kFlipColors[step], kFlipColors[step + 1], at - step);
}

void Put(Image& image, int x, int y, Vec3d color) {
  for (int c = 0; c < 3; ++c) image.At(x, y, c) = float(color[c]);
}

// Fills `place` with color(i).
template <class Color>
void Draw(Image& image, const PixelRect& place, const Color& color) {
  std::size_t i = 0;
  for (int y = place.y0; y < place.y1; ++y) {
    for (int x = place.x0; x < place.x1; ++x) Put(image, x, y, color(i++));
  }
}

auto Colors(const LinearImage& image) {
  return [&image](std::size_t i) {
    return Vec3d{image.planes[0][i], image.planes[1][i], image.planes[2][i]};
  };
}

}  // namespace

ComparisonSheet SheetOf(const std::vector<SheetRow>& rows) {
  const int w = rows.front().test.image.width, h = rows.front().test.image.height;
  const int count = int(rows.size());
  std::vector<Plane> differences;
  ComparisonSheet out;
  for (const SheetRow& row : rows) {
    differences.push_back(
        ErrorMapsOf(LinearOf(row.test.image), LinearOf(row.reference.image)).difference);
    out.difference_scale = std::max(out.difference_scale, ScaleOf(differences.back()));
    out.flip_scale =
        std::max(out.flip_scale, std::min(1.0, ScaleOf(row.comparison.flip->map())));
  }
  const int width = kColumns * (w + kGap) - kGap, height = count * (h + kGap) - kGap;
  CheckImageSize("the image of the comparison", width, height);
  out.image = MakeImage(width, height, {"R", "G", "B"});
  Draw(out.image, {0, 0, width, height}, [](std::size_t) { return kGapColor; });
  for (int r = 0; r < count; ++r) {
    const LinearImage test = LinearOf(rows[r].test.image);
    const LinearImage reference = LinearOf(rows[r].reference.image);
    const Plane& flip = rows[r].comparison.flip->map();
    const auto place = [&](int column) -> PixelRect {
      const int x = column * (w + kGap), y = r * (h + kGap);
      return {x, y, x + w, y + h};
    };
    Draw(out.image, place(0), Colors(test));
    Draw(out.image, place(1), Colors(reference));
    Draw(out.image, place(2), [&](std::size_t i) {
      return DifferenceColor(differences[r][i] / out.difference_scale);
    });
    Draw(out.image, place(3),
         [&](std::size_t i) { return FlipColor(flip[i] / out.flip_scale); });
  }
  return out;
}

std::string SheetText(const ComparisonSheet& sheet) {
  return fmt::format(
      "from left to right: the image; the reference; their difference, relative to it: "
      "blue -{0:.3g} %, white 0, red +{0:.3g} %; FLIP: black 0, white {1:.3g}",
      100 * sheet.difference_scale, sheet.flip_scale);
}

}  // namespace lanelight
