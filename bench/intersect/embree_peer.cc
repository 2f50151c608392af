// Embree 3 as a peer: every call, quality and mode.
#include <fmt/format.h>

#include "bench/cpu_clock.h"
#include "bench/intersect/embree_calls.h"
#include "bench/intersect/embree_scene.h"
#include "bench/intersect/tracer.h"
#include "src/base/core/error.h"
#include "src/base/core/machine.h"

namespace lanelight::bench {
namespace {

struct Call {
  const char* name;
  EmbreeCall call;
  bool coherent;
};
constexpr Call kCalls[] = {
    {"1", EmbreeCall::kOne, false},
    {"4", EmbreeCall::kFour, false},
    {"4c", EmbreeCall::kFour, true},
    {"8", EmbreeCall::kEight, false},
    {"8c", EmbreeCall::kEight, true},
    {"16", EmbreeCall::kSixteen, false},
    {"16c", EmbreeCall::kSixteen, true},
    {"1M", EmbreeCall::kStreamAos, false},
    {"1Mc", EmbreeCall::kStreamAos, true},
    {"NM", EmbreeCall::kStreamPackets, false},
    {"Np", EmbreeCall::kStreamPointers, false},
    {"Npc", EmbreeCall::kStreamPointers, true},
};
constexpr std::size_t kNumCalls = std::size(kCalls);

struct Tree {
  const char* name;
  RTCBuildQuality quality;
  bool robust;
};
constexpr Tree kTrees[] = {{"high", RTC_BUILD_QUALITY_HIGH, false},
                           {"medium", RTC_BUILD_QUALITY_MEDIUM, false},
                           {"high robust", RTC_BUILD_QUALITY_HIGH, true},
                           {"medium robust", RTC_BUILD_QUALITY_MEDIUM, true}};

class Embree : public Peer {
 public:
  Embree(const Mesh& mesh, const std::string& config)
      : config_(config), device_(rtcNewDevice(config.c_str())) {
    if (!device_) throw InputError("Embree does not take \"" + config + "\"");
    const FlushToZero flush;
    for (const Tree& tree : kTrees) {
      scenes_.push_back(NewEmbreeScene(device_, mesh, tree.quality, tree.robust));
      rtcCommitScene(scenes_.back());
    }
  }
  ~Embree() override {
    for (RTCScene scene : scenes_) rtcReleaseScene(scene);
    rtcReleaseDevice(device_);
  }

  // Embree does not tell the instruction set that it chose, but which packets are native.
  std::string Name() const override {
    const auto has = [&](RTCDeviceProperty p) {
      return rtcGetDeviceProperty(device_, p) != 0;
    };
    const char* widest = has(RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED)  ? "AVX-512"
                         : has(RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED) ? "AVX/AVX2"
                                                                          : "SSE";
    return fmt::format("Embree {}, \"{}\": {}", RTC_VERSION_STRING, config_, widest);
  }

  std::vector<PeerEntry> Entries() const override {
    std::vector<PeerEntry> entries;
    for (const Tree& tree : kTrees) {
      for (const Call& call : kCalls) {
        entries.push_back({fmt::format("{} {}", tree.name, call.name), tree.robust});
      }
    }
    return entries;
  }

  double Trace(std::size_t entry, const RaySet& set, int wave,
               std::vector<BenchHit>* hits) override {
    const Call& call = kCalls[entry % kNumCalls];
    const RTCScene scene = scenes_[entry / kNumCalls];
    const auto size = static_cast<std::size_t>(wave);
    EmbreeWave packed(call.call, set.shadow, LargestWave(set, size));
    if (hits) hits->resize(set.rays.size());
    const FlushToZero flush;
    double seconds = 0;
    ForEachWave(set, size, [&](std::size_t begin, std::size_t end) {
      packed.CopyRays(set.rays.data() + begin, end - begin);
      const CpuTimer timer;
      packed.Trace(scene, call.coherent);
      seconds += timer.Seconds();
      if (hits) packed.Unpack(hits->data() + begin);
    });
    return seconds;
  }

 private:
  std::string config_;
  RTCDevice device_;
  std::vector<RTCScene> scenes_;
};

}  // namespace

std::unique_ptr<Peer> MakeEmbree(const Mesh& mesh, const std::string& target,
                                 const std::string& config) {
  return std::make_unique<Embree>(mesh, EmbreeConfig(target, 1, config));
}

}  // namespace lanelight::bench
