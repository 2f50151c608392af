// Building acceleration structures, ours and Embree's: time, memory, threads.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/intersect/mesh.h"

#include "src/scene/accel/build.h"

namespace lanelight::bench {

/// The result of one build.
struct BuildRun {
  double wall = 0, cpu = 0;          // seconds; cpu of all threads together
  std::size_t result = 0, peak = 0;  // bytes, without the mesh itself
};

/// A way to build, a row of the table.
class Builder {
 public:
  virtual ~Builder() = default;
  virtual std::string Name() const = 0;
  virtual BuildRun Run(int threads) const = 0;
};

/// Embree's qualities, robust scenes (what watertight tracing takes) apart; empty if
/// Embree 3 was not found when this was built.
std::vector<std::unique_ptr<Builder>> EmbreeBuilders(const Mesh& mesh,
                                                     const std::string& target);

struct BuildResult {
  std::string mesh, name;
  std::size_t triangles = 0;
  double cpu = 0;                     // one thread, median
  double wall_one = 0, wall_two = 0;  // 1 and 2 threads, least
  double bytes = 0, peak = 0;         // per triangle; peak while building
  double SpeedUp() const { return wall_one / wall_two; }
};

/// Builds `repeat` times in each way with 1 and with 2 threads, interleaved; ours as
/// `options` say in all but the quality.
std::vector<BuildResult> BenchBuilds(const Mesh& mesh, const Geometry& geometry,
                                     const AccelOptions& options,
                                     const std::string& target, bool embree, int repeat);

void PrintBuildHeader();
void PrintBuild(const BuildResult& result);

}  // namespace lanelight::bench
