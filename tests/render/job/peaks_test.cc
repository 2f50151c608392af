#include "src/render/job/profile_report.h"

#include <catch2/catch.hpp>

#include "kernels/peaks/peaks.h"
#include "src/base/core/aligned.h"
#include "tests/support/test_target.h"

namespace lanelight {

TEST_CASE("the loops that measure peaks compute the stated result on every target",
          "[peaks]") {
  AlignedVector<std::uint32_t> words(4096);
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i < words.size(); ++i) {
    words[i] = static_cast<std::uint32_t>(i * i * 2654435761u);
    sum += words[i];
  }
  for (const std::string& target : AvailableTargets()) {
    ForceTarget(target);
    INFO(target);
    CHECK(ReadSum(TestTarget(), words.data(), words.size(), 1) == sum);
    CHECK(ReadSum(TestTarget(), words.data(), words.size(), 7) == 7 * sum);
    CHECK(ReadSum(TestTarget(), words.data(), 1024, 0) == 0);
    CHECK(MultiplyAdds(TestTarget(), 0, 0.5f, 1) == Approx(6.5));  // mean of 1 to 12
    CHECK(MultiplyAdds(TestTarget(), 1, 0.5f, 1) == Approx(0.5 * 6.5 + 1));
    CHECK(MultiplyAdds(TestTarget(), 200, 0.5f, 1) == Approx(2));
    CHECK(MultiplyAdds(TestTarget(), 200, -0.25f, 5) == Approx(4));
    CHECK(MultiplyAddsOperations(TestTarget()) == 24 * TestTarget().lanes());
  }
  ForceTarget("");
}

TEST_CASE("peaks are listed from the nearest to the farthest memory level", "[peaks]") {
  const Peaks peaks = MeasurePeaks({}, false);
  REQUIRE(peaks.levels.size() >= 3);
  CHECK(peaks.levels.front().name == "L1");
  CHECK(peaks.levels.back().name == "memory");
  CHECK(peaks.flops > 1e8);
  for (std::size_t i = 0; i < peaks.levels.size(); ++i) {
    CHECK(peaks.levels[i].bytes_per_second > 1e8);
    CHECK(peaks.levels[i].probe <= peaks.levels[i].bytes);
    if (i > 0) CHECK(peaks.levels[i].bytes > peaks.levels[i - 1].bytes);
  }
}

TEST_CASE("a working set belongs to the nearest level that fits it", "[peaks]") {
  Peaks peaks;
  peaks.levels = {
      {"L1", 32 << 10, 0, 0}, {"L2", 1 << 20, 0, 0}, {"memory", 1 << 30, 0, 0}};
  CHECK(peaks.LevelOf(0).name == "L1");
  CHECK(peaks.LevelOf(32 << 10).name == "L1");
  CHECK(peaks.LevelOf((32 << 10) + 1).name == "L2");
  CHECK(peaks.LevelOf(2 << 20).name == "memory");
  CHECK(peaks.LevelOf(1e12).name == "memory");
}

}  // namespace lanelight
