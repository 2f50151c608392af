// In which order tiles are rendered, and their samples merged.
#include <atomic>
#include <catch2/catch.hpp>
#include <thread>

#include "src/render/run/tile_queue.h"

namespace lanelight {
namespace {

struct Watch : TaskWatcher {
  bool Stopped() const override { return stopped; }
  void TaskDone() override {}
  std::atomic<bool> stopped{false};
};

TaskSamples SamplesOf(const TileRange& range) {
  TaskSamples samples;
  samples.count = static_cast<std::uint32_t>(range.end - range.begin);
  samples.counts.samples = range.begin;  // to know them by
  return samples;
}

bool Is(const std::optional<TileRange>& range, std::size_t tile, std::uint64_t begin,
        std::uint64_t end) {
  return range && range->tile == tile && range->begin == begin && range->end == end;
}

}  // namespace

TEST_CASE("tiles take turns, and none is begun twice at once", "[tile_queue]") {
  std::vector<std::uint64_t> done = {0, 10, 4};
  TileQueue queue(done, {10, 4, 1});
  const Watch watch;
  const auto end = [&](const TileRange& range) {
    TaskSamples samples = SamplesOf(range);
    queue.Ended(range, samples, [](TaskSamples&) {});
  };
  const auto a = queue.Next(watch), b = queue.Next(watch);
  CHECK(Is(a, 0, 0, 4));
  CHECK(Is(b, 2, 4, 8));
  end(*b);
  const auto c = queue.Next(watch);
  CHECK(Is(c, 2, 8, 10));
  end(*a);
  const auto d = queue.Next(watch);
  CHECK(Is(d, 0, 4, 8));
  end(*d);
  end(*c);
  const auto e = queue.Next(watch);
  CHECK(Is(e, 0, 8, 10));
  CHECK_FALSE(queue.Next(watch));
  end(*e);
  CHECK(done == std::vector<std::uint64_t>{10, 10, 10});
}

TEST_CASE("samples that come early wait for their turn", "[tile_queue]") {
  std::vector<std::uint64_t> done = {0};
  TileQueue queue(done, {20, 4, 4});
  const Watch watch;
  std::vector<TileRange> ranges;
  for (int i = 0; i < 4; ++i) ranges.push_back(*queue.Next(watch));
  std::vector<std::uint64_t> merged;
  const auto end = [&](const TileRange& range) {
    TaskSamples samples = SamplesOf(range);
    queue.Ended(range, samples,
                [&](TaskSamples& ready) { merged.push_back(ready.counts.samples); });
  };
  end(ranges[2]);
  end(ranges[1]);
  CHECK(merged.empty());
  CHECK(done[0] == 0);
  end(ranges[0]);
  CHECK(merged == std::vector<std::uint64_t>{0, 4, 8});
  CHECK(done[0] == 12);
  end(ranges[3]);
  end(*queue.Next(watch));
  CHECK(merged.size() == 5);
  CHECK(done[0] == 20);
}

TEST_CASE("a thread that has to wait goes on, or is let go", "[tile_queue]") {
  for (const bool stops : {false, true}) {
    std::vector<std::uint64_t> done = {0};
    TileQueue queue(done, {8, 4, 1});
    const Watch watch;
    const auto first = queue.Next(watch);
    std::optional<TileRange> second;
    std::thread other([&] { second = queue.Next(watch); });
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    TaskSamples samples = SamplesOf(*first);
    if (stops) {
      queue.Stop();
    } else {
      queue.Ended(*first, samples, [](TaskSamples&) {});
    }
    other.join();
    CHECK(second.has_value() == !stops);
  }
}

TEST_CASE("nothing begins once the watcher has stopped it", "[tile_queue]") {
  std::vector<std::uint64_t> done = {0, 0};
  TileQueue queue(done, {8, 4, 1});
  Watch watch;
  CHECK(queue.Next(watch));
  watch.stopped = true;
  CHECK_FALSE(queue.Next(watch));
}

}  // namespace lanelight
