#include "src/wavefront/path_records.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "src/core/check.h"
#include "src/wavefront/pilot_comparison.h"

namespace lanelight {
namespace {

// What a pixel adds without roulette, and what roulette adds to it.
struct Part {
  double variance, added;
  bool operator<(const Part& o) const { return variance + added < o.variance + o.added; }
};

Part PartOf(const PathRecord* records, std::uint32_t spp) {
  double sum = 0, squares = 0, risk = 0;
  for (std::uint32_t k = 0; k < spp; ++k) {
    const PathRecord& r = records[k];
    sum += r.end, squares += double{r.end} * r.end, risk += r.Risk();
  }
  return {std::max(0.0, squares - sum * sum / spp) / (spp - 1), risk / spp};
}

PathRecord ReadRecord(const float* next) {
  PathRecord record;
  for (PathRecord::Vertex& v : record.vertices) {
    v.cell = std::bit_cast<std::uint32_t>(*next++);
    v.at = *next++;
    v.got = *next++;
  }
  record.end = *next++;
  record.depth = *next++;
  for (float& risk : record.risk) risk = *next++;
  return record;
}

}  // namespace

PathSamples ReadRecords(TrainingSamples samples) {
  PathSamples out{std::move(samples), {}};
  if (out.planes == 0) return out;
  LL_CHECK_EQ(out.planes, NumPlanes(PlaneGroup::kRecord));
  for (std::size_t i = 0; i < out.colors.size(); ++i) {
    out.records.push_back(
        ReadRecord(out.recorded.data() + i * static_cast<std::size_t>(out.planes)));
  }
  out.recorded = {};
  return out;
}

std::vector<double> RelativeVariances(const TrainingSamples& samples,
                                      const TrainingWork& work, const ImageGuess& image) {
  const std::uint32_t n = samples.observations;  // of a pixel
  std::vector<double> variances(work.pixels.size());
  for (std::size_t i = 0; i < variances.size(); ++i) {
    const Vec3f* const colors = samples.colors.data() + i * work.spp;
    Vec3d sum, squares;
    for (std::uint32_t k = 0; k < n; ++k) {
      Vec3d of_one;
      // Randomisations take turns (src/path/replicates.h).
      for (std::uint32_t j = k; j < work.spp; j += n) {
        of_one += {colors[j].x, colors[j].y, colors[j].z};
      }
      sum += of_one;
      squares += {of_one.x * of_one.x, of_one.y * of_one.y, of_one.z * of_one.z};
    }
    for (int c = 0; c < 3; ++c) {
      // Of the sum over an observation; per sample.
      const double scatter = std::max(0.0, squares[c] - sum[c] * sum[c] / n) * n;
      variances[i] +=
          scatter / (n - 1) / work.spp * image.ErrorWeight(work.pixels[i], c) / 3;
    }
  }
  return variances;
}

double RouletteVarianceRatio(const PathSamples& samples, const TrainingWork& work,
                             const ImageGuess& image) {
  std::vector<Part> parts;
  for (std::size_t i = 0; i < work.pixels.size(); ++i) {
    double weight = 0;
    for (int c = 0; c < 3; ++c) weight += image.ErrorWeight(work.pixels[i], c);
    const Part part = PartOf(samples.records.data() + i * work.spp, work.spp);
    parts.push_back({part.variance * weight, part.added * weight});
  }
  std::sort(parts.begin(), parts.end());
  parts.resize(KeptOf(parts.size()));
  double variance = 0, added = 0;
  for (const Part& p : parts) variance += p.variance, added += p.added;
  return added > 0 ? 1 + added / std::max(variance, 1e-9 * added) : 1;
}

}  // namespace lanelight
