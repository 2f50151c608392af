// Starting samples: every (pixel, sample) of a task exactly once, in slots that were
// free, at its place of the sample buffer, whatever the number of free slots.
#include <algorithm>
#include <catch2/catch.hpp>
#include <random>
#include <set>

#include "kernels/stages.h"
#include "src/scene/prepare/tables.h"
#include "tests/support/each_target.h"
#include "tests/support/wave_fixture.h"

namespace lanelight {
namespace {

struct Task {
  std::uint32_t capacity, pixels, first_sample, samples, together;
  bool splits;
};

// A task whose started paths end at random, as their slots are freed again.
class Starter {
 public:
  explicit Starter(const Task& t)
      : task_(t), fixture_(scene_, t.capacity), engine_(t.capacity + t.together) {
    for (std::uint32_t i = 0; i < t.pixels; ++i) pixels_.push_back(1000 + 7 * i);
    std::shuffle(pixels_.begin(), pixels_.end(), engine_);
    TileWork& work = fixture_.wave.work;
    work.pixels = pixels_.data();
    work.num_pixels = t.pixels;
    work.first_sample = t.first_sample, work.samples = t.samples;
    work.together = t.together;
    Queue& free = queue(QueueId::kFree);
    for (std::uint32_t i = t.capacity; i-- > 0;) free.items[free.size++] = i;
  }

  // One wave: returns whether it started anything.
  bool Step() {
    Queue& camera = queue(QueueId::kCamera);
    Queue& active = queue(QueueId::kActive);
    camera.size = 0;
    const std::uint32_t room = Room();
    fixture_.Run(GenerateStage, FeaturesOf());
    // As many as there is room for, in whole groups of a pixel's samples.
    CHECK(camera.size <= room);
    if (!fixture_.wave.work.Done()) CHECK(camera.size + task_.together > room);
    for (std::uint32_t i = 0; i < camera.size; ++i) Note(camera.items[i]);
    CheckNeighbours(camera);
    const bool any = camera.size > 0;
    for (std::uint32_t i = 0; i < camera.size; ++i) {
      active.items[active.size++] = camera.items[i];
    }
    return any;
  }
  // Ends some paths; all, if there is no room for anything else.
  void End(bool all) {
    Queue& active = queue(QueueId::kActive);
    Queue& free = queue(QueueId::kFree);
    std::shuffle(active.items, active.items + active.size, engine_);
    const std::uint32_t ended = all ? active.size : engine_() % (active.size + 1);
    for (std::uint32_t i = 0; i < ended; ++i) {
      busy_.erase(active.items[--active.size]);
      free.items[free.size++] = active.items[active.size];
    }
  }
  bool Done() const { return fixture_.wave.work.Done(); }
  std::size_t started() const { return started_.size(); }

 private:
  Queue& queue(QueueId id) { return fixture_.wave.queue(id); }
  FeatureSet FeaturesOf() const {
    return task_.splits ? FeatureSet{Feature::kSplitting} : FeatureSet{};
  }
  std::uint32_t Room() {
    if (!task_.splits) return queue(QueueId::kFree).size;
    const std::uint32_t max_live = task_.capacity / kMaxSplitPaths;
    const std::uint32_t live = queue(QueueId::kActive).size;
    return live < max_live ? max_live - live : 0;
  }
  void Note(std::uint32_t slot) {
    const PathColumns& p = fixture_.wave.path;
    const std::uint32_t rows = task_.splits ? kMaxSplitPaths : 1;
    CHECK(slot < task_.capacity);
    CHECK(busy_.insert(slot).second);  // it was free
    CHECK(started_.insert({p.pixel[slot], p.sample[slot]}).second);
    CHECK(p.sample[slot] >= task_.first_sample);
    CHECK(p.sample[slot] < task_.first_sample + task_.samples);
    const auto at = std::find(pixels_.begin(), pixels_.end(), p.pixel[slot]);
    REQUIRE(at != pixels_.end());
    const auto index = static_cast<std::uint32_t>(at - pixels_.begin());
    const std::uint32_t sample = p.sample[slot] - task_.first_sample;
    CHECK(p.output[slot] == (index * task_.samples + sample) * rows);
    CHECK(p.depth[slot] == 0);
    if (task_.splits) CHECK((p.branch[slot] == 0 && p.budget[slot] == kMaxSplitPaths));
  }
  // Samples 2k and 2k + 1 of a pixel lie side by side where they are started together.
  void CheckNeighbours(const Queue& camera) {
    if (task_.together % 2 != 0 || task_.samples % 2 != 0) return;
    const PathColumns& p = fixture_.wave.path;
    REQUIRE(camera.size % 2 == 0);
    for (std::uint32_t i = 0; i < camera.size; i += 2) {
      const std::uint32_t a = camera.items[i], b = camera.items[i + 1];
      CHECK(p.pixel[a] == p.pixel[b]);
      CHECK(p.sample[a] + 1 == p.sample[b]);
    }
  }

  const Task task_;
  CompiledScene scene_;
  WaveFixture fixture_;
  std::mt19937 engine_;
  std::vector<std::uint32_t> pixels_;
  std::set<std::pair<std::uint32_t, std::uint32_t>> started_;
  std::set<std::uint32_t> busy_;
};

constexpr Task kTasks[] = {
    {64, 20, 0, 16, 16, false},   // whole vectors
    {64, 20, 32, 5, 16, false},   // fewer samples than are started together
    {100, 13, 7, 21, 16, false},  // a remainder, and free slots that leave gaps
    {37, 9, 0, 10, 1, false},     // one by one
    {50, 9, 4, 10, 2, false},     // pairs
    {16, 3, 0, 40, 16, false},    // as many slots as are started together
    {512, 20, 3, 21, 16, true},   // paths that split
    {128, 5, 0, 6, 2, true}};

}  // namespace

TEST_CASE("generate: every sample of every pixel is started once", "[generate]") {
  const EachTarget target;
  for (const Task& task : kTasks) {
    CAPTURE(task.capacity, task.samples, task.together, task.splits);
    Starter starter(task);
    int idle = 0;
    while (!starter.Done() && idle < 2) {
      const bool any = starter.Step();
      idle = any ? 0 : idle + 1;
      starter.End(!any);
    }
    CHECK(starter.Done());
    CHECK(starter.started() == std::size_t{task.pixels} * task.samples);
    CHECK_FALSE(starter.Step());
  }
}

}  // namespace lanelight
