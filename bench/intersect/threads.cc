#include "bench/intersect/threads.h"

#include <fmt/format.h>

#include <barrier>
#include <cstdio>
#include <thread>

namespace lanelight::bench {
namespace {

double Mrays(const CompiledScene& scene, const std::vector<RaySet>& parts, int wave) {
  std::vector<double> rates(parts.size());
  std::barrier together(static_cast<std::ptrdiff_t>(parts.size()));
  std::vector<std::jthread> threads;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    threads.emplace_back([&, i] {
      OurTracer tracer(scene, wave);
      together.arrive_and_wait();
      rates[i] = static_cast<double>(parts[i].rays.size()) /
                 tracer.Trace(parts[i], nullptr) * 1e-6;
    });
  }
  threads.clear();  // joins
  double sum = 0;
  for (const double rate : rates) sum += rate;
  return sum;
}

}  // namespace

ThreadsResult BenchThreads(const Mesh& mesh, const CompiledScene& scene,
                           const RaySet& set, const CompareOptions& options) {
  const auto wave = static_cast<std::size_t>(options.wave);
  const std::vector<RaySet> whole = {set};
  const std::vector<RaySet> halves = {EveryWave(set, wave, 2, 0),
                                      EveryWave(set, wave, 2, 1)};
  std::vector<double> rates, ratios;
  for (int r = 0; r < options.repeat; ++r) {
    rates.push_back(Mrays(scene, whole, options.wave));
    ratios.push_back(Mrays(scene, halves, options.wave) / rates.back());
  }
  return {mesh.name, set.name, MedianRangeOf(rates).median, MedianRangeOf(ratios)};
}

void PrintThreads(const ThreadsResult& r) {
  fmt::print(
      "{:12} {:14} 1 thread {:6.2f} Mray/s, 2 threads {:.2f} times as many "
      "[{:.2f}, {:.2f}]\n",
      r.mesh, r.set, r.one, r.scaling.median, r.scaling.low, r.scaling.high);
  std::fflush(stdout);
}

}  // namespace lanelight::bench
