// Columns reached by whole vectors hold what plain loops would read and write.
#include "kernels/simd/each_target-inl.h"

#include "kernels/queue/batch-inl.h"

LANELIGHT_BEGIN_KERNELS

// out[k] = column[slots[k]], and again by each kind of store: columns a and b.
void Move(const std::uint32_t* slots, const float* column, float* out, float* a,
          std::uint32_t* b) {
  const DI di;
  const Slots read(hn::LoadU(di, reinterpret_cast<const std::int32_t*>(slots)));
  const StoreSlots written(read);
  const VF value = Gather(column, read);
  hn::StoreU(value, DF(), out);
  Scatter(value, a, read);
  Scatter(hn::BitCast(di, value), b, written);
}

std::size_t Lanes() { return hn::Lanes(DF()); }

// Entries 0 .. count-1 of a table, two ways; returns whether they agree.
bool LooksUp(const float* table, std::size_t count) {
  const DI di;
  const VI index = hn::Min(hn::Iota(di, 0), hn::Set(di, static_cast<int>(count) - 1));
  return hn::AllTrue(DF(), hn::Eq(Lookup(table, count, index), Gather(table, index)));
}

LANELIGHT_END_KERNELS

#if HWY_ONCE
#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <random>
#include <vector>

#include "src/base/core/aligned.h"
#include "tests/support/each_target.h"

namespace lanelight {

HWY_EXPORT(Move);
HWY_EXPORT(Lanes);
HWY_EXPORT(LooksUp);

namespace {

constexpr std::uint32_t kSlots = 100;

// A column has a full vector behind its last slot, and nothing more.
AlignedVector<float> Column(float first) {
  AlignedVector<float> column(112 + 16);
  for (std::size_t i = 0; i < column.size(); ++i) column[i] = first + float(i);
  return column;
}

void CheckMoves(const std::vector<std::uint32_t>& slots) {
  const AlignedVector<float> column = Column(1);
  AlignedVector<float> a = Column(1000);
  AlignedVector<std::uint32_t> b(column.size(), 7);
  std::vector<float> out(slots.size());
  LANELIGHT_ON(TestTarget(), Move)(slots.data(), column.data(), out.data(), a.data(),
                                   b.data());
  for (std::size_t k = 0; k < slots.size(); ++k) REQUIRE(out[k] == column[slots[k]]);
  for (std::uint32_t i = 0; i < column.size(); ++i) {
    const bool mine = std::find(slots.begin(), slots.end(), i) != slots.end();
    REQUIRE(a[i] == (mine ? column[i] : 1000 + float(i)));
    REQUIRE(b[i] == (mine ? std::bit_cast<std::uint32_t>(column[i]) : 7));
  }
}

}  // namespace

TEST_CASE("slots: contiguous runs at any offset of a column", "[queue]") {
  const EachTarget target;
  const std::size_t lanes = LANELIGHT_ON(TestTarget(), Lanes)();
  for (std::uint32_t first = 0; first + lanes <= kSlots; ++first) {
    std::vector<std::uint32_t> slots(lanes);
    for (std::size_t k = 0; k < lanes; ++k) slots[k] = first + std::uint32_t(k);
    CheckMoves(slots);
    std::reverse(slots.begin(), slots.end());
    CheckMoves(slots);
  }
}

TEST_CASE("slots: gaps, any order, repeated ends", "[queue]") {
  const EachTarget target;
  const std::size_t lanes = LANELIGHT_ON(TestTarget(), Lanes)();
  std::mt19937 engine(3);
  for (int round = 0; round < 600; ++round) {
    // Spans from a bare vector to the whole column.
    const std::uint32_t span =
        std::min(kSlots, std::uint32_t(lanes) + std::uint32_t(engine() % 50));
    const std::uint32_t first = std::uint32_t(engine()) % (kSlots - span + 1);
    std::vector<std::uint32_t> slots(span);
    for (std::uint32_t i = 0; i < span; ++i) slots[i] = first + i;
    std::shuffle(slots.begin(), slots.end(), engine);
    slots.resize(lanes);
    if (round % 2 == 0) std::sort(slots.begin(), slots.end());
    const std::size_t valid = 1 + engine() % lanes;
    std::fill(slots.begin() + valid, slots.end(), slots[valid - 1]);
    CheckMoves(slots);
  }
}

TEST_CASE("slots: tables of any size", "[queue]") {
  const EachTarget target;
  for (std::size_t count = 1; count <= 40; ++count) {
    std::vector<float> table(count);
    for (std::size_t i = 0; i < count; ++i) table[i] = 3 * float(i) + 1;
    CHECK(LANELIGHT_ON(TestTarget(), LooksUp)(table.data(), count));
  }
}

}  // namespace lanelight
#endif  // HWY_ONCE
