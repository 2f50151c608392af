// The film's sums over ten million samples of a pixel, beside the same sums in twice the
// precision: what is added late counts as much as what came first.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "src/render/films/accumulator.h"

namespace lanelight {
namespace {

// Neumaier's compensated sum: what rounding drops is added up beside. `size`: of all that
// was added, without signs.
struct Compensated {
  double sum = 0, rest = 0, size = 0;

  void Add(double value) {
    const double next = sum + value;
    rest +=
        std::abs(sum) >= std::abs(value) ? (sum - next) + value : (value - next) + sum;
    sum = next;
    size += std::abs(value);
  }
};

constexpr int kPlanes = kColorPlanes;
constexpr std::uint32_t kTask = 2047;  // no multiple of a turn: pairs stay open between

// Lognormal, an eighth black, a few fireflies.
class Planes {
 public:
  Planes() {
    std::mt19937 random(7);
    std::lognormal_distribution<float> lognormal(-1, 1.5f);
    for (auto& values : values_) {
      values.resize(kLength + kTask);
      for (std::size_t i = 0; i < kLength; ++i) {
        values[i] = random() % 8 == 0 ? 0 : lognormal(random);
        if (random() % 4096 == 0) values[i] *= 1e4f;
      }
      std::copy_n(values.begin(), kTask, values.begin() + kLength);
    }
  }
  float At(int plane, std::uint64_t sample) const {
    return values_[plane][sample % kLength];
  }
  // Returns kTask samples from this one on.
  const float* From(int plane, std::uint64_t sample) const {
    return values_[plane].data() + sample % kLength;
  }

 private:
  static constexpr std::size_t kLength = 65521;  // prime: no pattern of groups repeats
  std::vector<float> values_[kPlanes];
};

struct Case {
  std::uint32_t unit;
  bool replicates;
};

// The sums that the film keeps, in the order of its columns, without incomplete units.
std::vector<Compensated> Twin(const Planes& planes, const Case& c, std::uint64_t spp) {
  const SampleGroups groups = {c.unit, c.replicates};
  std::vector<Compensated> replicates(3 * kReplicates), units(6);
  for (int channel = 0; channel < 3; ++channel) {
    double value = 0;  // of the open unit
    for (std::uint64_t i = 0; i < spp; ++i) {
      const double f = planes.At(channel, i);
      const std::size_t row = 3 * groups.Replicate(i) + static_cast<std::size_t>(channel);
      replicates[row].Add(f);
      units[static_cast<std::size_t>(channel)].Add(f);
      value += f / c.unit;
      if ((i + 1) % c.unit != 0) continue;
      units[static_cast<std::size_t>(3 + channel)].Add(value * value);
      value = 0;
    }
  }
  return c.replicates ? replicates : units;
}

std::vector<double> FilmSums(const Planes& planes, const Case& c, std::uint64_t spp) {
  FilmAccumulator film(0, 0, 1, 1, {c.unit, c.replicates}, Auxiliary::kNone);
  for (std::uint64_t i = 0; i < spp; i += kTask) {
    const float* from[kPlanes];
    for (int p = 0; p < kPlanes; ++p) from[p] = planes.From(p, i);
    film.AddSamples(0, 0, from,
                    static_cast<std::uint32_t>(std::min<std::uint64_t>(kTask, spp - i)));
  }
  REQUIRE(film.Samples(0, 0) == spp);
  std::vector<double> sums;
  for (const MutableStateColumn& column : film.Columns()) {
    if (column.type != StateType::kFloat64) continue;
    if (column.name.find("open") != std::string::npos) continue;
    const double* values = static_cast<const double*>(column.data);
    sums.insert(sums.end(), values, values + column.rows * column.ValuesPerRow());
  }
  return sums;
}

void CheckSums(const Case& c, std::uint64_t spp) {
  CAPTURE(c.unit, c.replicates, spp);
  static const Planes planes;
  const std::vector<double> sums = FilmSums(planes, c, spp);
  const std::vector<Compensated> twin = Twin(planes, c, spp);
  REQUIRE(sums.size() == twin.size());
  // One sample in ten million is 1e-7, and single precision 6e-8.
  double worst = 0;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double error = std::abs((sums[i] - twin[i].sum) - twin[i].rest) / twin[i].size;
    worst = std::isfinite(error) ? std::max(worst, error) : error;
  }
  CHECK(worst < 1e-12);
}

constexpr Case kCases[] = {{1, false}, {1, true}, {2, false}, {2, true}};

}  // namespace

TEST_CASE("film: sums of a million samples lose no precision", "[film]") {
  for (const Case& c : kCases) CheckSums(c, 1'000'003);
}

TEST_CASE("film: sums of ten million samples lose no precision", "[film][slow]") {
  for (const Case& c : kCases) CheckSums(c, 10'000'019);
}

}  // namespace lanelight
