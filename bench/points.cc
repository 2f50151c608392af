// Nanoseconds of processor time per random number of each sampler, one thread: points of
// two numbers, lanes are neighbouring pixels, results stay in the first cache. Samplers
// are interleaved; median and spread of the repetitions are printed. Before, the bits are
// compared with those of the plain C++ target, and the means with 1/2.
#include <fmt/format.h>

#include <algorithm>
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>

#include "bench/cpu_clock.h"
#include "tests/kernels/probe/sampler_probe.h"
#include "kernels/simd/target.h"
#include "src/base/core/machine_info.h"
#include "src/vocabulary/strategy/strategy.h"

namespace lanelight::bench {
namespace {

struct Options {
  std::string target;
  int repeat = 15, calls = 200;
};

constexpr SampleSequence kSamplers[] = {
    SampleSequence::kIndependent, SampleSequence::kStratified, SampleSequence::kPmj02,
    SampleSequence::kSobol,       SampleSequence::kHalton,     SampleSequence::kLattice};
constexpr std::uint32_t kPixels = 256, kSamples = 8;
constexpr std::size_t kPoints = kPixels * kSamples;

struct Batch {
  SampleSequence sampler;
  SamplerParameters parameters;
  std::vector<float> u0 = std::vector<float>(kPoints + 16), u1 = u0;
  std::vector<double> seconds = {};

  void Run(SimdTarget target, std::uint32_t call) {
    const SamplerQuery query = {
        sampler, 1, call * kPixels, call % 50, call % 7 * kSamples, kSamples, kPixels};
    ProbeSampler(target, query, parameters, u0.data(), u1.data());
  }
  double Sum() const {
    double sum = 0;
    for (std::size_t i = 0; i < kPoints; ++i) sum += double(u0[i]) + u1[i];
    return sum;
  }
};

// Throws unless the numbers are those of EMU128 and their mean is 1/2 within six standard
// deviations of independent numbers.
void Verify(Batch& batch, const std::string& target) {
  double sum = 0;
  for (std::uint32_t call = 0; call < 50; ++call) {
    batch.Run(SimdTarget(target), call);
    const std::vector<float> u0 = batch.u0, u1 = batch.u1;
    sum += batch.Sum();
    const std::vector<std::string> all = AvailableTargets();
    batch.Run(SimdTarget(all.back()), call);
    if (!std::equal(u0.begin(), u0.begin() + kPoints, batch.u0.begin()) ||
        !std::equal(u1.begin(), u1.begin() + kPoints, batch.u1.begin())) {
      throw std::runtime_error(
          fmt::format("{}: differs from target {}", Name(batch.sampler), all.back()));
    }
  }
  const double n = 50.0 * 2 * kPoints;
  if (std::abs(sum / n - 0.5) > 6 * std::sqrt(1 / (12 * n))) {
    throw std::runtime_error(fmt::format("{}: mean {}", Name(batch.sampler), sum / n));
  }
}

int Main(int argc, char** argv) {
  Options o;
  CLI::App app("ns per random number of each sampler");
  app.add_option("--target", o.target, "SIMD target");
  app.add_option("--repeat", o.repeat, "repetitions")->check(CLI::PositiveNumber);
  app.add_option("--calls", o.calls, "batches per repetition")
      ->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  const SimdTarget target(o.target);
  std::vector<Batch> batches;
  for (SampleSequence sampler : kSamplers) {
    batches.push_back({sampler, MakeSamplerParameters(sampler)});
    Verify(batches.back(), o.target);
  }
  for (int r = 0; r < o.repeat; ++r) {
    for (Batch& batch : batches) {
      const CpuTimer timer;
      for (int call = 0; call < o.calls; ++call) {
        batch.Run(target, static_cast<std::uint32_t>(call));
      }
      batch.seconds.push_back(timer.Seconds());
    }
  }
  fmt::print("{}\n", MachineText(ThisMachine()));
  fmt::print("target {}, {} lanes, {} repetitions\n", target.name(), target.lanes(),
             o.repeat);
  fmt::print("{:12} {:>11} {:>9} {:>9}\n", "points", "ns/number", "lowest", "highest");
  for (Batch& batch : batches) {
    std::sort(batch.seconds.begin(), batch.seconds.end());
    const double scale = 1e9 / (2.0 * kPoints * o.calls);
    fmt::print("{:12} {:11.3f} {:9.3f} {:9.3f}\n", Name(batch.sampler),
               scale * batch.seconds[batch.seconds.size() / 2],
               scale * batch.seconds.front(), scale * batch.seconds.back());
  }
  return 0;
}

}  // namespace
}  // namespace lanelight::bench

int main(int argc, char** argv) {
  try {
    return lanelight::bench::Main(argc, argv);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
}
