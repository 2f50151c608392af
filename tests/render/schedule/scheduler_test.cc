// In which order tiles are rendered, and their samples merged.
#include <atomic>
#include <catch2/catch.hpp>
#include <thread>

#include "src/render/schedule/scheduler.h"

namespace lanelight {
namespace {

struct Watch : TaskWatcher {
  bool IsStopped() const override { return stopped; }
  void TaskDone() override {}
  std::atomic<bool> stopped{false};
};

TaskSamples SamplesOf(const SampleRange& range) {
  TaskSamples samples;
  samples.count = range.count;
  samples.counts.samples = range.first;  // identifies them
  return samples;
}

bool Is(const std::optional<SampleRange>& range, std::size_t tile, std::uint64_t first,
        std::uint64_t end) {
  return range && range->tile == tile && range->first == first && range->end() == end;
}

std::vector<PixelRect> Tiles(int count) {
  std::vector<PixelRect> tiles;
  for (int i = 0; i < count; ++i) tiles.push_back({i, 0, i + 1, 1});
  return tiles;
}

std::vector<std::uint64_t> Levels(const Scheduler& scheduler) {
  std::vector<std::uint64_t> done;
  for (const TileProgress& tile : scheduler.Snapshot()) done.push_back(tile.done);
  return done;
}

}  // namespace

TEST_CASE("tiles are scheduled in order, each by one thread at a time", "[scheduler]") {
  Scheduler scheduler(Tiles(3));
  scheduler.Resume({{0, 0}, {1, 10}, {2, 4}});
  scheduler.Begin({0, 10, 4}, {});
  const Watch watch;
  const auto end = [&](const SampleRange& range) {
    TaskSamples samples = SamplesOf(range);
    scheduler.FinishRange(range, samples, [](TaskSamples&) {});
  };
  const auto a = scheduler.Next(watch), b = scheduler.Next(watch);
  CHECK(Is(a, 0, 0, 4));
  CHECK(Is(b, 2, 4, 8));
  end(*b);
  const auto c = scheduler.Next(watch);
  CHECK(Is(c, 2, 8, 10));
  end(*a);
  const auto d = scheduler.Next(watch);
  CHECK(Is(d, 0, 4, 8));
  end(*d);
  end(*c);
  const auto e = scheduler.Next(watch);
  CHECK(Is(e, 0, 8, 10));
  CHECK_FALSE(scheduler.Next(watch));
  end(*e);
  CHECK(Levels(scheduler) == std::vector<std::uint64_t>{10, 10, 10});
}

TEST_CASE("samples that finish early are merged in order", "[scheduler]") {
  Scheduler scheduler(Tiles(1));
  scheduler.Begin({0, 20, 4}, {4, false});
  const Watch watch;
  std::vector<SampleRange> ranges;
  for (int i = 0; i < 4; ++i) ranges.push_back(*scheduler.Next(watch));
  std::vector<std::uint64_t> merged;
  const auto end = [&](const SampleRange& range) {
    TaskSamples samples = SamplesOf(range);
    scheduler.FinishRange(range, samples, [&](TaskSamples& ready) {
      merged.push_back(ready.counts.samples);
    });
  };
  end(ranges[2]);
  end(ranges[1]);
  CHECK(merged.empty());
  CHECK(Levels(scheduler)[0] == 0);
  end(ranges[0]);
  CHECK(merged == std::vector<std::uint64_t>{0, 4, 8});
  CHECK(Levels(scheduler)[0] == 12);
  end(ranges[3]);
  end(*scheduler.Next(watch));
  CHECK(merged.size() == 5);
  CHECK(Levels(scheduler)[0] == 20);
}

TEST_CASE("a waiting thread is resumed or released", "[scheduler]") {
  for (const bool stops : {false, true}) {
    Scheduler scheduler(Tiles(1));
    scheduler.Begin({0, 8, 4}, {});
    const Watch watch;
    const auto first = scheduler.Next(watch);
    std::optional<SampleRange> second;
    std::thread other([&] { second = scheduler.Next(watch); });
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    TaskSamples samples = SamplesOf(*first);
    if (stops) {
      scheduler.Cancel();
    } else {
      scheduler.FinishRange(*first, samples, [](TaskSamples&) {});
    }
    other.join();
    CHECK(second.has_value() == !stops);
  }
}

TEST_CASE("ranges that were cancelled are scheduled again", "[scheduler]") {
  Scheduler scheduler(Tiles(1));
  scheduler.Begin({0, 8, 4}, {2, false});
  const Watch watch;
  CHECK(scheduler.Next(watch));
  const auto second = scheduler.Next(watch);
  TaskSamples samples = SamplesOf(*second);
  scheduler.FinishRange(*second, samples,
                        [](TaskSamples&) { FAIL("merged before the first"); });
  scheduler.Cancel();
  CHECK_FALSE(scheduler.Next(watch));
  CHECK(Levels(scheduler) == std::vector<std::uint64_t>{0});
  // Samples that waited for the cancelled range are gone.
  scheduler.Begin({0, 8, 4}, {});
  const auto again = scheduler.Next(watch);
  REQUIRE(Is(again, 0, 0, 4));
  samples = SamplesOf(*again);
  scheduler.FinishRange(*again, samples, [](TaskSamples&) {});
  CHECK(Levels(scheduler) == std::vector<std::uint64_t>{4});
  CHECK(Is(scheduler.Next(watch), 0, 4, 8));
}

TEST_CASE("a scheduler releases idle tiles and adopts tiles of others", "[scheduler]") {
  Scheduler scheduler(Tiles(4));
  scheduler.Resume({{0, 0}, {1, 0}, {2, 6}});  // tile 3 is of another rank
  CHECK(scheduler.MissingSamples(scheduler.Snapshot(), 8) == 18);
  const Watch watch;
  scheduler.Begin({0, 8, 4}, {1, true});
  const auto first = scheduler.Next(watch);
  CHECK(Is(first, 0, 0, 4));
  const auto released = scheduler.Release(9);
  REQUIRE(released.size() == 1);  // tile 0 is in flight, tile 2 would be too much
  CHECK(released[0].tile == 1);
  CHECK(scheduler.Snapshot().size() == 2);
  CHECK(Is(scheduler.Next(watch), 2, 6, 8));
  scheduler.AddTiles({{3, 4}});
  CHECK(Is(scheduler.Next(watch), 3, 4, 8));
  CHECK(scheduler.Snapshot().size() == 3);
}

TEST_CASE("no task starts after the watcher's stop", "[scheduler]") {
  Scheduler scheduler(Tiles(2));
  scheduler.Begin({0, 8, 4}, {});
  Watch watch;
  CHECK(scheduler.Next(watch));
  watch.stopped = true;
  CHECK_FALSE(scheduler.Next(watch));
}

}  // namespace lanelight
