#include "src/render/job/profile_report.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "kernels/peaks/peaks.h"
#include "src/base/core/aligned.h"
#include "src/base/core/check.h"
#include "src/base/core/hardware_counters.h"
#include "src/base/core/stopwatch.h"
#include "src/render/job/memory.h"

namespace lanelight {
namespace {

constexpr std::size_t kKiB = 1024, kMiB = 1024 * kKiB;
constexpr int kTrials = 5;

std::size_t CacheBytes(int name, std::size_t otherwise) {
  const long bytes = sysconf(name);
  return bytes > 0 ? std::size_t(bytes) : otherwise;
}

// Words 0, 1, 2, ... whose sum is known.
class ReadBuffer {
 public:
  ReadBuffer(SimdTarget target, std::size_t bytes)
      : target_(target), words_(RoundedWords(bytes)) {
    data_ = static_cast<std::uint32_t*>(
        ::operator new(words_ * sizeof(std::uint32_t), std::align_val_t(kCacheLine)));
    // The pages of a buffer this large should not be what is measured.
    AdviseHugePages(data_, words_ * sizeof(std::uint32_t));
    for (std::size_t i = 0; i < words_; ++i) data_[i] = std::uint32_t(i);
  }
  ~ReadBuffer() { ::operator delete(data_, std::align_val_t(kCacheLine)); }
  ReadBuffer(const ReadBuffer&) = delete;
  ReadBuffer& operator=(const ReadBuffer&) = delete;

  // Best rate of reading the first `bytes`, in trials of about `seconds` each.
  double Rate(std::size_t bytes, double seconds) const {
    const std::size_t words = std::min(RoundedWords(bytes), words_);
    double passes = 1, best = 0;
    for (int trial = 0; trial < kTrials;) {
      const auto count = std::size_t(passes);
      const double elapsed = Read(words, count);
      best = std::max(best, double(count) * double(words) * 4 / elapsed);
      // The first trials find out how many passes there have to be.
      if (elapsed < 0.5 * seconds && trial == 0) {
        passes = std::ceil(passes * std::clamp(seconds / elapsed, 2.0, 1000.0));
      } else {
        ++trial;
      }
    }
    return best;
  }

 private:
  static std::size_t RoundedWords(std::size_t bytes) {
    return std::max<std::size_t>(bytes / 4 / 1024, 1) * 1024;
  }

  double Read(std::size_t words, std::size_t passes) const {
    const Stopwatch watch;
    const std::uint32_t sum = ReadSum(target_, data_, words, passes);
    const double elapsed = watch.Seconds();
    const std::uint64_t once = std::uint64_t{words} * (words - 1) / 2;
    LL_CHECK_EQ(sum, std::uint32_t(once * passes));
    return std::max(elapsed, 1e-9);
  }

  SimdTarget target_;
  std::size_t words_;
  std::uint32_t* data_ = nullptr;
};

void MeasureMultiplyAdds(SimdTarget target, bool counters, Peaks& peaks) {
  constexpr std::uint64_t kIterations = 1'000'000;
  constexpr float kFactor = 0.5f, kAddend = 1;  // tends to 2
  CounterEvents events = HardwareEvents();
  const CounterGroup group(events);
  CounterValues before{}, after{};
  for (int trial = 0; trial < kTrials; ++trial) {
    const bool read = counters && group.Read(&before);
    const Stopwatch watch;
    const float x = MultiplyAdds(target, kIterations, kFactor, kAddend);
    const double elapsed = watch.Seconds();
    LL_CHECK(std::abs(x - 2) < 1e-5f);
    peaks.flops = std::max(
        peaks.flops, double(kIterations) * MultiplyAddsOperations(target) / elapsed);
    if (!read || !group.Read(&after) || after[0] <= before[0]) continue;
    peaks.fma_ipc = std::max(peaks.fma_ipc,
                             double(after[1] - before[1]) / double(after[0] - before[0]));
  }
}

}  // namespace

const MemoryLevel& Peaks::LevelOf(double bytes) const {
  for (const MemoryLevel& level : levels) {
    if (bytes <= double(level.bytes)) return level;
  }
  return levels.back();
}

Peaks MeasurePeaks(SimdTarget target, bool counters) {
  const Stopwatch watch;
  Peaks peaks;
  MeasureMultiplyAdds(target, counters, peaks);
  const std::size_t l1 = CacheBytes(_SC_LEVEL1_DCACHE_SIZE, 32 * kKiB);
  const std::size_t l2 = std::max(CacheBytes(_SC_LEVEL2_CACHE_SIZE, kMiB), 2 * l1);
  const std::size_t l3 = CacheBytes(_SC_LEVEL3_CACHE_SIZE, 0);
  const std::uint64_t machine = PhysicalMemory();
  // Twice the last cache, within limits: what fits nowhere comes from main memory.
  const std::size_t far = std::min<std::size_t>(
      std::clamp<std::size_t>(2 * std::max(l2, l3), 64 * kMiB, 256 * kMiB), machine / 8);
  const ReadBuffer buffer(target, far);
  const auto add = [&](const char* name, std::size_t bytes, std::size_t probe) {
    peaks.levels.push_back({name, bytes, probe, buffer.Rate(probe, 0.008)});
  };
  add("L1", l1, l1 / 2);
  add("L2", l2, l2 / 2);
  // A part that other programs leave to us.
  if (l3 > 2 * l2) add("L3", l3, std::min(l3 / 4, 8 * l2));
  add("memory", machine, far);
  peaks.seconds = watch.Seconds();
  return peaks;
}

}  // namespace lanelight
