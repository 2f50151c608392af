#include "src/render/train/single_path_variances.h"

#include <cmath>

#include "src/base/core/check.h"

namespace lanelight {
namespace {

double Square(double x) { return x * x; }

// From the square of what kernels call brightness to that of a sample's: the exposure,
// and the weight of the pixel filter.
double ScaleOf(const TrainingSamples& samples, const float channel[3]) {
  double of_colors = 0, of_records = 0;
  for (std::size_t i = 0; i < samples.colors.size(); ++i) {
    const Vec3f& c = samples.colors[i];
    of_colors += Square(channel[0] * c.x + channel[1] * c.y + channel[2] * c.z);
    of_records += Square(samples.recorded[2 * i]);
  }
  return of_records > 0 ? of_colors / of_records : 0;
}

}  // namespace

double MomentsAbout(const PathValues& values, float exposure, std::uint32_t pixel) {
  double about = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double inverse = values.inverse_pixel[std::size_t{pixel} * 3 + c];
    if (!(inverse > 0)) return 0;
    about += 1 / (3 * std::sqrt(3.0) * inverse);
  }
  return about / exposure;
}

std::vector<double> SinglePathVariances(const TrainingSamples& samples,
                                        const TrainingWork& work, const ImageGuess& image,
                                        const PathValues& values, float exposure,
                                        std::vector<double> variances) {
  LL_CHECK_EQ(samples.planes, NumPlanes(PlaneGroup::kSinglePath));
  const double scale = ScaleOf(samples, values.channel);
  for (std::size_t i = 0; i < variances.size(); ++i) {
    const double about = MomentsAbout(values, exposure, work.pixels[i]);
    double weight = 0, added = 0;
    for (int c = 0; c < 3; ++c) {
      weight += image.ErrorWeight(work.pixels[i], c) / 3 / Square(3 * values.channel[c]);
    }
    for (std::size_t k = i * work.spp; k < (i + 1) * work.spp; ++k) {
      added += samples.recorded[2 * k + 1] - Square(samples.recorded[2 * k] - about);
    }
    variances[i] += added / work.spp * scale * weight;
  }
  return variances;
}

}  // namespace lanelight
