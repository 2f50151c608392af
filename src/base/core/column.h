// Columns of a state: views of memory, with their names in the file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "src/base/core/check.h"

namespace lanelight {

enum class StateType { kFloat32, kFloat64, kUint32, kUint64, kInt32 };

/// Returns the bytes of one value: 4 or 8.
constexpr std::size_t SizeOf(StateType type) {
  return type == StateType::kFloat64 || type == StateType::kUint64 ? 8 : 4;
}
/// Returns the name that numpy has for the type.
constexpr const char* Name(StateType type) {
  constexpr const char* kNames[] = {"float32", "float64", "uint32", "uint64", "int32"};
  return kNames[static_cast<int>(type)];
}

/// `rows` rows of memory, one after the other, each with the values of `shape`. Void is
/// `const void` for columns to be saved and `void` for columns to be filled.
template <class Void>
struct BasicStateColumn {
  std::string name;     // in the file: letters, digits, '_', '-'
  std::string meaning;  // one line, with units, for readers of the file
  StateType type = StateType::kFloat32;
  std::vector<std::size_t> shape;  // of one row, e.g. {4, 3}; empty: one value
  std::size_t rows = 0;
  Void* data = nullptr;

  std::size_t ValuesPerRow() const {
    std::size_t values = 1;
    for (std::size_t n : shape) values *= n;
    return values;
  }
  std::size_t RowBytes() const { return ValuesPerRow() * SizeOf(type); }
  std::size_t Bytes() const { return rows * RowBytes(); }

  operator BasicStateColumn<const void>() const  // NOLINT: as a pointer does
    requires(!std::is_const_v<Void>)
  {
    return {name, meaning, type, shape, rows, data};
  }
};

/// A column to be saved.
using StateColumn = BasicStateColumn<const void>;
/// A column to be filled.
using MutableStateColumn = BasicStateColumn<void>;

template <class Value>
constexpr StateType StateTypeOf() {
  if constexpr (std::is_same_v<Value, float>) return StateType::kFloat32;
  if constexpr (std::is_same_v<Value, double>) return StateType::kFloat64;
  if constexpr (std::is_same_v<Value, std::uint32_t>) return StateType::kUint32;
  if constexpr (std::is_same_v<Value, std::uint64_t>) return StateType::kUint64;
  if constexpr (std::is_same_v<Value, std::int32_t>) return StateType::kInt32;
}

/// Returns some rows of a column.
inline MutableStateColumn RowsOf(MutableStateColumn column, std::size_t first,
                                 std::size_t count) {
  LL_CHECK_LE(first + count, column.rows);
  column.data = static_cast<char*>(column.data) + first * column.RowBytes();
  column.rows = count;
  return column;
}

/// Adds the values of a column of the same rows and type: doubles, or integers of 64
/// bits.
void AddColumn(const MutableStateColumn& sum, const StateColumn& more);

/// The column of a contiguous container (std::vector, std::array, std::span) whose
/// elements consist of Values alone: the arithmetic type itself, or a trivially copyable
/// struct of them. By default a row is an element; `shape` may split it, {4, 3} for 12
/// values, or take several elements together. A container of const elements gives a
/// StateColumn, any other a MutableStateColumn. It refers to the container's memory.
template <class Value, class Container>
auto MakeStateColumn(std::string name, std::string meaning, Container& values,
                     std::vector<std::size_t> shape = {}) {
  using Element = std::remove_pointer_t<decltype(std::data(values))>;
  using Void = std::conditional_t<std::is_const_v<Element>, const void, void>;
  static_assert(std::is_trivially_copyable_v<Element>);
  static_assert(sizeof(Element) % sizeof(Value) == 0);
  static_assert(alignof(Element) % alignof(Value) == 0);
  constexpr std::size_t kPerElement = sizeof(Element) / sizeof(Value);
  if (shape.empty() && kPerElement > 1) shape = {kPerElement};
  BasicStateColumn<Void> column = {
      std::move(name),  std::move(meaning), StateTypeOf<Value>(), std::move(shape), 0,
      std::data(values)};
  const std::size_t count = std::size(values) * kPerElement;
  LL_CHECK_EQ(count % column.ValuesPerRow(), 0u);
  column.rows = count / column.ValuesPerRow();
  return column;
}

}  // namespace lanelight
