// Live memory as a table: what a state file (src/state) keeps of a render.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace lanelight {

enum class StateType { kFloat32, kFloat64, kUint32, kUint64, kInt32 };

template <class T>
constexpr StateType StateTypeOf() {
  if constexpr (std::is_same_v<T, float>) return StateType::kFloat32;
  if constexpr (std::is_same_v<T, double>) return StateType::kFloat64;
  if constexpr (std::is_same_v<T, std::uint32_t>) return StateType::kUint32;
  if constexpr (std::is_same_v<T, std::uint64_t>) return StateType::kUint64;
  if constexpr (std::is_same_v<T, std::int32_t>) return StateType::kInt32;
}

constexpr std::size_t SizeOf(StateType type) {
  return type == StateType::kFloat64 || type == StateType::kUint64 ? 8 : 4;
}

/// A view of `rows` rows, each of as many values as the product of `shape`.
struct StateColumn {
  std::string name, meaning;
  StateType type = StateType::kFloat64;
  std::vector<std::size_t> shape;  // of one row; empty: one value
  std::size_t rows = 0;
  void* data = nullptr;

  std::size_t RowBytes() const {
    std::size_t bytes = SizeOf(type);
    for (std::size_t n : shape) bytes *= n;
    return bytes;
  }
};

/// The column of a vector of numbers, or of structs of nothing but `Number`s.
template <class Number, class Row, class Allocator>
StateColumn ColumnOf(std::string name, std::string meaning,
                     std::vector<Row, Allocator>& rows, std::vector<std::size_t> shape) {
  static_assert(std::is_trivially_copyable_v<Row> && sizeof(Row) % sizeof(Number) == 0);
  return {std::move(name),  std::move(meaning), StateTypeOf<Number>(),
          std::move(shape), rows.size(),        rows.data()};
}

}  // namespace lanelight
