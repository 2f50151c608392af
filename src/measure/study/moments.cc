#include "src/measure/study/moments.h"

#include "src/base/core/check.h"

namespace lanelight {
namespace {

constexpr char kColumn[] = "moments";
constexpr char kMeaning[] =
    "sums over the renders, then of their squares: R, G, B, their mean";

}  // namespace

void Moments::Add(const std::vector<Rgb>& image) {
  LL_CHECK_EQ(image.size(), pixels_.size());
  for (std::size_t i = 0; i < image.size(); ++i) {
    const Rgb c = image[i];
    const double planes[kPlanes] = {c.x, c.y, c.z, (c.x + c.y + c.z) / 3};
    for (int p = 0; p < kPlanes; ++p) {
      pixels_[i].sum[p] += planes[p];
      pixels_[i].squares[p] += planes[p] * planes[p];
    }
  }
  ++count_;
}

double Moments::PlaneVariance(const Pixel& pixel, int plane) const {
  if (count_ < 2) return 0;
  const double n = double(count_), mean = pixel.sum[plane] / n;
  const double scatter = pixel.squares[plane] / n - mean * mean;
  // Equal values leave a remainder of rounding.
  return scatter > 1e-14 * mean * mean ? scatter * n / (n - 1) : 0;
}

Rgb Moments::Mean(std::size_t pixel) const {
  const auto& sum = pixels_[pixel].sum;
  return Rgb{sum[0], sum[1], sum[2]} / double(count_);
}

Rgb Moments::Variance(std::size_t pixel) const {
  const Pixel& p = pixels_[pixel];
  return {PlaneVariance(p, 0), PlaneVariance(p, 1), PlaneVariance(p, 2)};
}

stat::MeanEstimate Moments::GreyEstimate(std::size_t pixel) const {
  const double n = double(count_);
  return {pixels_[pixel].sum[3] / n, GreyVariance(pixel) / n, n - 1};
}

double Moments::GreyVariance(std::size_t pixel) const {
  return PlaneVariance(pixels_[pixel], 3);
}

StateColumn Moments::Column() const {
  return MakeStateColumn<double>(kColumn, kMeaning, pixels_, {2, kPlanes});
}

MutableStateColumn Moments::Restore(std::uint64_t count) {
  count_ = count;
  return MakeStateColumn<double>(kColumn, kMeaning, pixels_, {2, kPlanes});
}

}  // namespace lanelight
