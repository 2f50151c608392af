// Embree's builds with the memory that they take.
#include <algorithm>
#include <atomic>

#include "bench/intersect/build_clock.h"
#include "bench/intersect/embree_scene.h"
#include "src/base/core/machine.h"
#include "src/base/core/parallel.h"

namespace lanelight::bench {
namespace {

/// The memory that Embree reports as allocated and freed.
struct Memory {
  std::atomic<std::int64_t> now{0}, peak{0};

  static bool Monitor(void* self, ssize_t bytes, bool) {
    auto& memory = *static_cast<Memory*>(self);
    const std::int64_t now = memory.now.fetch_add(bytes) + bytes;
    std::int64_t before = memory.peak.load();
    while (now > before && !memory.peak.compare_exchange_weak(before, now)) {
    }
    return true;
  }
};

class EmbreeBuilder : public Builder {
 public:
  EmbreeBuilder(const Mesh& mesh, const char* name, RTCBuildQuality quality, bool robust,
                const std::string& target)
      : mesh_(mesh), name_(name), quality_(quality), robust_(robust), target_(target) {}

  std::string Name() const override { return name_; }
  BuildRun Run(int threads) const override {
    const ThreadLimit limit(threads);
    const FlushToZero flush;
    Memory memory;
    RTCDevice device = rtcNewDevice(EmbreeConfig(target_, threads, "").c_str());
    rtcSetDeviceMemoryMonitorFunction(device, Memory::Monitor, &memory);
    RTCScene scene = NewEmbreeScene(device, mesh_, quality_, robust_);
    const std::int64_t mesh_bytes = memory.now;
    memory.peak = mesh_bytes;
    const BuildClock clock;
    rtcCommitScene(scene);
    BuildRun run = clock.Stop();
    run.result = static_cast<std::size_t>(memory.now - mesh_bytes);
    run.peak = static_cast<std::size_t>(memory.peak - mesh_bytes);
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
    return run;
  }

 private:
  const Mesh& mesh_;
  const char* name_;
  RTCBuildQuality quality_;
  bool robust_;
  std::string target_;
};

}  // namespace

std::vector<std::unique_ptr<Builder>> EmbreeBuilders(const Mesh& mesh,
                                                     const std::string& target) {
  std::vector<std::unique_ptr<Builder>> rows;
  const auto add = [&](const char* name, RTCBuildQuality quality, bool robust) {
    rows.push_back(std::make_unique<EmbreeBuilder>(mesh, name, quality, robust, target));
  };
  add("high", RTC_BUILD_QUALITY_HIGH, false);
  add("medium", RTC_BUILD_QUALITY_MEDIUM, false);
  add("high robust", RTC_BUILD_QUALITY_HIGH, true);
  add("medium robust", RTC_BUILD_QUALITY_MEDIUM, true);
  return rows;
}

}  // namespace lanelight::bench
