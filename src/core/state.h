// The exact state of a computation as bytes, to put down and pick up on the same kind of
// machine: sections of plain values, each with a name and a size, so that a state of
// something else is refused and never misread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace lanelight {

class StateWriter {
 public:
  /// Appends `count` values of a type without pointers.
  template <class T>
  void Write(std::string_view name, const T* values, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    Append(name, values, sizeof(T), count);
  }
  template <class T>
  void Write(std::string_view name, const T& value) {
    Write(name, &value, 1);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  void Append(std::string_view name, const void* values, std::size_t size,
              std::size_t count);
  std::string bytes_;
};

class StateReader {
 public:
  /// Refers to `bytes`, of a StateWriter.
  explicit StateReader(std::string_view bytes) : bytes_(bytes) {}

  /// Reads what was written under this name next. Throws InputError if it is something
  /// else, of another size or count, or cut off.
  template <class T>
  void Read(std::string_view name, T* values, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    Take(name, values, sizeof(T), count);
  }
  template <class T>
  T Read(std::string_view name) {
    T value;
    Read(name, &value, 1);
    return value;
  }
  /// Reads a value and throws InputError unless it is `expected`.
  template <class T>
  void Expect(std::string_view name, const T& expected) {
    if (!(Read<T>(name) == expected)) Refuse(name);
  }
  bool done() const { return bytes_.empty(); }

 private:
  void Take(std::string_view name, void* values, std::size_t size, std::size_t count);
  [[noreturn]] static void Refuse(std::string_view name);
  std::string_view bytes_;
};

}  // namespace lanelight
