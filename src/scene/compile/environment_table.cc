// Tables of environment images sample a texel by its row, then by its column in that row.
//   density     pdf_sa = P(texel) * texels / (4 pi); all texels fill the same solid angle
// compensated P ~ max(0, L - mean L). With two techniques of equal sample counts and the
// balance heuristic, the sum of densities is sampled. This P brings p_light + p_bsdf
// closest to L if p_bsdf is uniform
//   unbiased    scattered rays must find what has no probability any more: with
//               directions=mis only, where their weight is 1 there
//   variance    falls where the sky is much dimmer than a sun; at most slightly higher
//               for narrow lobes, which find little of the dim part
//   cost        none per sample
//   source      Karlik et al. 2019
#include "src/scene/compile/environment.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include "src/base/core/vec.h"

namespace lanelight {
namespace {

// A smaller fraction of an image above its mean is rounding.
constexpr double kMinExcess = 1e-5;

// Running sums of `weights`, normalised, as `size + 1` floats that start at 0 and end
// at 1. Without any weight the distribution is uniform.
void StoreCdf(const double* weights, std::size_t size, float* cdf) {
  double total = 0;
  for (std::size_t i = 0; i < size; ++i) total += weights[i];
  double sum = 0;
  for (std::size_t i = 0; i < size; ++i) {
    cdf[i] = static_cast<float>(total > 0 ? sum / total : double(i) / double(size));
    sum += weights[i];
  }
  cdf[size] = 1;
}

// Bits of a guide: about four steps of the distribution for each of its parts.
int GuideBits(std::size_t size) {
  int bits = 0;
  while ((std::size_t{4} << bits) < size) ++bits;
  return bits;
}

// See EnvironmentTable::guide_bits. Parts are powers of two, so that u finds its part
// exactly.
void StoreGuide(const float* cdf, std::size_t size, int bits, std::int32_t* guide) {
  const std::size_t parts = std::size_t{1} << bits;
  std::size_t step = 0;
  for (std::size_t k = 0; k <= parts; ++k) {
    const double u = double(k) / double(parts);
    while (step + 1 < size && cdf[step + 1] <= u) ++step;
    guide[k] = static_cast<std::int32_t>(step);
  }
}

std::vector<double> Luminances(const Environment& e) {
  std::vector<double> luminance(e.rgb.size() / 3);
  for (std::size_t i = 0; i < luminance.size(); ++i) {
    luminance[i] = Luminance({e.rgb[3 * i], e.rgb[3 * i + 1], e.rgb[3 * i + 2]});
  }
  return luminance;
}

double Sum(const std::vector<double>& weights) {
  return std::accumulate(weights.begin(), weights.end(), 0.0);
}

// Returns the excess over the mean, or the luminance itself if nothing exceeds the mean.
std::vector<double> AboveMean(const std::vector<double>& luminance) {
  const double sum = Sum(luminance), mean = sum / static_cast<double>(luminance.size());
  std::vector<double> above(luminance.size());
  for (std::size_t i = 0; i < above.size(); ++i) {
    above[i] = std::max(0.0, luminance[i] - mean);
  }
  return Sum(above) > kMinExcess * sum ? above : luminance;
}

// The probabilities are those of the rounded sums, which is what the kernel samples.
void StoreProbabilities(std::size_t size, EnvironmentTable& table) {
  for (std::size_t y = 0; y < size; ++y) {
    const float* columns = table.column_cdf.data() + y * (size + 1);
    const double row = double(table.row_cdf[y + 1]) - double(table.row_cdf[y]);
    for (std::size_t x = 0; x < size; ++x) {
      const double column = double(columns[x + 1]) - double(columns[x]);
      table.probability[y * size + x] = static_cast<float>(row * column);
    }
  }
}

}  // namespace

std::shared_ptr<const EnvironmentTable> MakeEnvironmentTable(
    bool compensated, const Environment& environment) {
  auto table = std::make_shared<EnvironmentTable>();
  const auto size = static_cast<std::size_t>(environment.size);
  std::vector<double> weights = Luminances(environment), rows(size);
  if (!(Sum(weights) > 0)) return table;
  if (compensated) weights = AboveMean(weights);
  for (std::size_t i = 0; i < weights.size(); ++i) rows[i / size] += weights[i];
  table->row_cdf.resize(size + 1);
  table->column_cdf.resize((size + 1) * size);
  table->probability.resize(size * size);
  StoreCdf(rows.data(), size, table->row_cdf.data());
  const int bits = GuideBits(size);
  const std::size_t guide = (std::size_t{1} << bits) + 1;
  table->guide_bits = bits;
  table->row_guide.resize(guide);
  table->column_guide.resize(guide * size);
  StoreGuide(table->row_cdf.data(), size, bits, table->row_guide.data());
  for (std::size_t y = 0; y < size; ++y) {
    float* columns = table->column_cdf.data() + y * (size + 1);
    StoreCdf(weights.data() + y * size, size, columns);
    StoreGuide(columns, size, bits, table->column_guide.data() + y * guide);
  }
  StoreProbabilities(size, *table);
  return table;
}

}  // namespace lanelight
