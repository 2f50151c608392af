#include "src/study/moments.h"

#include <cstring>

#include "src/core/check.h"

namespace lanelight {

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

std::string Moments::Save() const {
  std::string bytes(pixels_.size() * sizeof(Pixel), '\0');
  std::memcpy(bytes.data(), pixels_.data(), bytes.size());
  return bytes;
}

void Moments::Load(std::string_view bytes, std::uint64_t count) {
  LL_CHECK_EQ(bytes.size(), pixels_.size() * sizeof(Pixel));
  std::memcpy(static_cast<void*>(pixels_.data()), bytes.data(), bytes.size());
  count_ = count;
}

}  // namespace lanelight
