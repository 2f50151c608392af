#include "src/base/core/column.h"

#include "src/base/core/parallel.h"

namespace lanelight {
namespace {

template <class T>
void AddValues(const MutableStateColumn& sum, const StateColumn& more) {
  T* const to = static_cast<T*>(sum.data);
  const T* const from = static_cast<const T*>(more.data);
  ParallelForRange(sum.rows * sum.ValuesPerRow(), 1 << 16,
                   [&](std::size_t begin, std::size_t end) {
                     for (std::size_t i = begin; i < end; ++i) to[i] += from[i];
                   });
}

}  // namespace

void AddColumn(const MutableStateColumn& sum, const StateColumn& more) {
  LL_CHECK(sum.type == more.type);
  LL_CHECK_EQ(sum.Bytes(), more.Bytes());
  if (sum.type == StateType::kUint64) {
    AddValues<std::uint64_t>(sum, more);
  } else {
    LL_CHECK(sum.type == StateType::kFloat64);
    AddValues<double>(sum, more);
  }
}

}  // namespace lanelight
