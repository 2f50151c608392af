#include "src/measure/report/shrink.h"

#include <algorithm>
#include <cmath>

namespace lanelight {
namespace {

ReportImage Shrunk(const ReportImage& image, int side) {
  ReportImage out;
  out.name = image.name;
  out.width = (image.width + side - 1) / side;
  out.height = (image.height + side - 1) / side;
  out.channels = image.channels;
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      const int x1 = std::min(image.width, (x + 1) * side);
      const int y1 = std::min(image.height, (y + 1) * side);
      for (int c = 0; c < image.channels; ++c) {
        double sum = 0;
        for (int yy = y * side; yy < y1; ++yy) {
          for (int xx = x * side; xx < x1; ++xx) {
            sum +=
                image.values[(std::size_t(yy) * image.width + xx) * image.channels + c];
          }
        }
        const double count = double(x1 - x * side) * double(y1 - y * side);
        out.values.push_back(static_cast<float>(sum / count));
      }
    }
  }
  return out;
}

}  // namespace

int ShrinkImages(std::vector<ReportImage>& images, std::size_t most) {
  std::size_t values = 0;
  for (const ReportImage& image : images) values += image.values.size();
  const int side =
      std::max(1, static_cast<int>(std::ceil(std::sqrt(double(values) / double(most)))));
  if (side == 1) return side;
  for (ReportImage& image : images) image = Shrunk(image, side);
  return side;
}

}  // namespace lanelight
