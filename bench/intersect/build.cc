#include "bench/intersect/build.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "bench/intersect/build_clock.h"
#include "bench/intersect/compare.h"
#include "bench/intersect/counted_new.h"
#include "src/base/core/parallel.h"
#include "tests/support/wave_fixture.h"

namespace lanelight::bench {
namespace {

class OurBuilder : public Builder {
 public:
  OurBuilder(const Geometry& geometry, std::string name, const AccelOptions& options)
      : geometry_(geometry), name_(std::move(name)), options_(options) {}

  std::string Name() const override { return name_; }
  BuildRun Run(int threads) const override {
    const ThreadLimit limit(threads);
    const std::size_t before = AllocatedBytes();
    ResetPeak();
    const BuildClock clock;
    const Accel accel = BuildAccel(geometry_, options_);
    BuildRun run = clock.Stop();
    run.result = accel.Bytes();
    run.peak = PeakBytes() - before;
    return run;
  }

 private:
  const Geometry& geometry_;
  std::string name_;
  AccelOptions options_;
};

std::vector<std::unique_ptr<Builder>> OurBuilders(const Geometry& geometry,
                                                  AccelOptions options) {
  std::vector<std::unique_ptr<Builder>> rows;
  const auto add = [&](const char* name, BuildQuality quality) {
    options.quality = quality;
    rows.push_back(std::make_unique<OurBuilder>(geometry, name, options));
  };
  add("ours", BuildQuality::kHigh);
  add("ours fast", BuildQuality::kFast);
  return rows;
}

BuildResult Summary(const Mesh& mesh, const Builder& builder,
                    const std::vector<BuildRun>& one, const std::vector<BuildRun>& two) {
  const auto triangles = static_cast<double>(mesh.triangles.size());
  BuildResult out{mesh.name, builder.Name(), mesh.triangles.size()};
  std::vector<double> cpu;
  for (const BuildRun& run : one) cpu.push_back(run.cpu);
  out.cpu = MedianRangeOf(cpu).median;
  // Other programs only ever add to these.
  out.wall_one = std::ranges::min(one, {}, &BuildRun::wall).wall;
  out.wall_two = std::ranges::min(two, {}, &BuildRun::wall).wall;
  out.bytes = static_cast<double>(one.front().result) / triangles;
  out.peak =
      static_cast<double>(std::ranges::max(one, {}, &BuildRun::peak).peak) / triangles;
  return out;
}

}  // namespace

std::vector<BuildResult> BenchBuilds(const Mesh& mesh, const Geometry& geometry,
                                     const AccelOptions& options,
                                     const std::string& target, bool embree, int repeat) {
  std::vector<std::unique_ptr<Builder>> builders = OurBuilders(geometry, options);
  if (embree) {
    for (auto& b : EmbreeBuilders(mesh, target)) builders.push_back(std::move(b));
  }
  std::vector<std::vector<BuildRun>> one(builders.size()), two(builders.size());
  for (int r = 0; r < repeat; ++r) {
    for (std::size_t b = 0; b < builders.size(); ++b) {
      one[b].push_back(builders[b]->Run(1));
      two[b].push_back(builders[b]->Run(2));
    }
  }
  std::vector<BuildResult> results;
  for (std::size_t b = 0; b < builders.size(); ++b) {
    results.push_back(Summary(mesh, *builders[b], one[b], two[b]));
  }
  return results;
}

void PrintBuildHeader() {
  fmt::print("{:12} {:14} {:>9} {:>8} {:>8} {:>8} {:>8} {:>9} {:>9}\n", "mesh", "build",
             "triangles", "CPU s", "1 thread", "2", "speed-up", "bytes/tri", "peak/tri");
}

void PrintBuild(const BuildResult& r) {
  fmt::print("{:12} {:14} {:9} {:8.3f} {:8.3f} {:8.3f} {:8.2f} {:9.1f} {:9.1f}\n", r.mesh,
             r.name, r.triangles, r.cpu, r.wall_one, r.wall_two, r.SpeedUp(), r.bytes,
             r.peak);
  std::fflush(stdout);
}

}  // namespace lanelight::bench
