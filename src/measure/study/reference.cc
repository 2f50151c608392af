#include "src/measure/study/reference.h"

#include <array>
#include <cmath>

#include "src/base/core/check.h"
#include "src/base/core/error.h"
#include "src/base/image/exr.h"
#include "src/base/image/image.h"
#include "src/measure/compare/agreement.h"
#include "src/render/estimate/estimate.h"
#include "src/render/films/colors.h"

namespace lanelight {
namespace {

// Returns the window, whose corner is (x0, y0) in the image, of three channels.
std::vector<Rgb> Cut(const Image& image, const std::array<int, 3>& channels, int x0,
                     int y0, const PixelRect& window) {
  std::vector<Rgb> pixels;
  pixels.reserve(window.pixels());
  for (int y = y0; y < y0 + window.height(); ++y) {
    for (int x = x0; x < x0 + window.width(); ++x) {
      Rgb value;
      for (int c = 0; c < 3; ++c) {
        value[c] = LinearValue(image, x, y, channels[std::size_t(c)]);
      }
      pixels.push_back(value);
    }
  }
  return pixels;
}

void CheckFinite(const std::string& path, const std::vector<Rgb>& pixels) {
  std::size_t bad = 0;
  for (const Rgb& p : pixels) {
    bad += !(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
  }
  if (bad == 0) return;
  throw InputError(
      "reference '{}': {} of {} pixels are not finite numbers; "
      "errors against it are meaningless",
      path, bad, pixels.size());
}

struct Piece {
  std::vector<Rgb> mean, variance;
};

Piece ReadPiece(const std::string& path, const PixelRect& window, int full_width,
                int full_height) {
  const Image image = ReadImage(path);
  const auto color = ColorChannels(image);
  if (!color) throw InputError("reference '" + path + "': " + NoColorChannels(image));
  const bool whole = image.width == full_width && image.height == full_height;
  if (!whole && (image.width != window.width() || image.height != window.height())) {
    throw InputError(
        "reference '{}' has {}x{} pixels and the render {}x{}; give a "
        "reference of that size, or --resolution {}x{}",
        path, image.width, image.height, window.width(), window.height(), image.width,
        image.height);
  }
  const int x0 = whole ? window.x0 : 0, y0 = whole ? window.y0 : 0;
  Piece piece = {Cut(image, *color, x0, y0, window), {}};
  CheckFinite(path, piece.mean);
  if (const std::vector<int> v = FindNoisyChannels(image).variances; !v.empty()) {
    piece.variance = Cut(image, {v.front(), v[v.size() / 2], v.back()}, x0, y0, window);
    const double unit = VarianceUnit(image);
    for (Rgb& v : piece.variance) {
      v *= unit;
      if (v.x >= 0 && v.y >= 0 && v.z >= 0 && std::isfinite(v.x + v.y + v.z)) continue;
      piece.variance.clear();
      break;
    }
  }
  return piece;
}

// Sets the mean of the pieces, and the variance of that mean from their scatter.
void Combine(const std::vector<Piece>& pieces, Reference& reference) {
  const double n = double(pieces.size());
  reference.mean.assign(pieces[0].mean.size(), Rgb{});
  reference.variance.assign(pieces[0].mean.size(), Rgb{});
  for (std::size_t i = 0; i < reference.mean.size(); ++i) {
    for (const Piece& piece : pieces) reference.mean[i] += piece.mean[i] / n;
    for (const Piece& piece : pieces) {
      const Rgb d = piece.mean[i] - reference.mean[i];
      reference.variance[i] += d * d / (n * (n - 1));
    }
  }
}

}  // namespace

stat::MeanEstimate Reference::GreyEstimate(std::size_t pixel) const {
  const Rgb m = mean[pixel], v = Variance(pixel);
  const double deviation = (std::sqrt(v.x) + std::sqrt(v.y) + std::sqrt(v.z)) / 3;
  return {(m.x + m.y + m.z) / 3, deviation * deviation, 1};
}

Rgb Reference::Weight(std::size_t pixel) const {
  Rgb weight;
  for (int c = 0; c < 3; ++c) {
    weight[c] = 1 / (mean[pixel][c] * mean[pixel][c] + kRelativeEpsilon);
  }
  return weight;
}

double Reference::OwnMse() const {
  double sum = 0;
  for (const Rgb& v : variance) sum += (v.x + v.y + v.z) / 3;
  return sum / double(mean.size());
}

double Reference::OwnRelMse() const {
  double sum = 0;
  for (std::size_t i = 0; i < variance.size(); ++i) {
    sum += Dot(variance[i], Weight(i)) / 3;
  }
  return sum / double(mean.size());
}

Reference ReadReference(const std::vector<std::string>& files, const PixelRect& window,
                        int full_width, int full_height) {
  LL_CHECK(!files.empty());
  Reference reference;
  reference.width = window.width();
  reference.height = window.height();
  reference.files = files;
  std::vector<Piece> pieces;
  for (const std::string& file : files) {
    pieces.push_back(ReadPiece(file, window, full_width, full_height));
  }
  if (pieces.size() > 1) {
    Combine(pieces, reference);
    return reference;
  }
  reference.mean = std::move(pieces[0].mean);
  reference.variance = std::move(pieces[0].variance);
  if (!reference.has_variance()) {
    reference.note =
        "the reference file has no variances and is treated as exact: its own error "
        "counts "
        "as error and bias of every strategy (use two independent renders, --reference A "
        "--reference B, to measure it)";
  }
  return reference;
}

void WriteReference(const std::string& path, const Reference& reference) {
  WriteColors(path, reference.width, reference.height,
              {{"", &reference.mean}, {"variance.", &reference.variance}});
}

}  // namespace lanelight
