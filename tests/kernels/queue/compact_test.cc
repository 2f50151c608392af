// Packing: the paths that go on keep what they carry, in the order of their slots.
#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>
#include <random>

#include "kernels/stages.h"
#include "tests/support/each_target.h"
#include "tests/support/wave_fixture.h"

namespace lanelight {
namespace {

std::vector<std::uint32_t> SomeSlots(std::uint32_t capacity, std::uint32_t count,
                                     std::mt19937& engine) {
  std::vector<std::uint32_t> slots(capacity);
  std::iota(slots.begin(), slots.end(), 0u);
  std::shuffle(slots.begin(), slots.end(), engine);
  slots.resize(count);
  return slots;
}

void CheckCompacts(std::uint32_t capacity, std::uint32_t count, std::mt19937& engine) {
  const CompiledScene scene;
  WaveFixture fixture(scene, capacity);
  Wave& wave = fixture.wave;
  const ColumnList& carried = wave.lists.carried;
  for (std::uint32_t c = 0; c < carried.count; ++c) {
    for (std::uint32_t i = 0; i < capacity; ++i) carried.columns[c][i] = 1000 * c + i;
  }
  std::vector<std::uint32_t> slots = SomeSlots(capacity, count, engine);
  Queue& live = wave.queue(QueueId::kScattered);
  live.size = count;
  std::copy(slots.begin(), slots.end(), live.items);
  fixture.Run(CompactStage, {});
  std::sort(slots.begin(), slots.end());
  REQUIRE(live.size == count);
  for (std::uint32_t i = 0; i < count; ++i) {
    REQUIRE(live.items[i] == i);
    for (std::uint32_t c = 0; c < carried.count; ++c) {
      REQUIRE(carried.columns[c][i] == 1000 * c + slots[i]);
    }
  }
  const Queue& free = wave.queue(QueueId::kFree);
  REQUIRE(free.size == capacity - count);
  for (std::uint32_t i = 0; i < free.size; ++i)
    REQUIRE(free.items[i] == capacity - 1 - i);
}

}  // namespace

TEST_CASE("compaction: paths keep their live columns", "[queue]") {
  std::mt19937 engine(11);
  const EachTarget target;
  for (std::uint32_t capacity : {1u, 2u, 16u, 33u, 200u}) {
    for (int fraction = 0; fraction <= 4; ++fraction) {
      CheckCompacts(capacity, capacity * fraction / 4, engine);
    }
  }
}

TEST_CASE("compaction: dead columns are rewritten in every wave", "[queue]") {
  FieldSet written = fields::EverCarried();
  const auto visit = [&](const Stage& stage) {
    if (stage.input == QueueId::kFree || stage.input == QueueId::kCamera) return;
    for (std::size_t i = 0; i < kNumFields; ++i) {
      const Field f = static_cast<Field>(i);
      INFO(stage.name << " reads " << FieldName(f));
      if (stage.reads.Has(f)) CHECK(written.Has(f));
    }
    written = written | stage.writes;
  };
#define X(name) visit(name##Stage(TestTarget()));
  LANELIGHT_STAGES(X)
#undef X
}

}  // namespace lanelight
