// Tensor files, as the RGL material database has them: named arrays of numbers.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "src/base/core/error.h"

namespace lanelight {

/// No number is larger, so that what is computed of them stays finite.
inline constexpr float kLargestInTensor = 1e12f;
/// Type of a field, by its code.
inline constexpr int kTensorUint8 = 1;

/// Throws InputError about a byte of a file.
template <class... Args>
[[noreturn]] void FailAtByte(std::uint64_t place, fmt::format_string<Args...> format,
                             Args&&... args) {
  throw InputError("byte {}: {}", place,
                   fmt::format(format, std::forward<Args>(args)...));
}

struct TensorField {
  std::uint64_t place;  // of its entry
  std::uint64_t offset;
  int type;  // code; integers from 1 to 8
  std::vector<std::uint64_t> shape;
  std::uint64_t count;  // of numbers
};

/// The fields of a file; all of them lie within it.
class TensorFile {
 public:
  /// Throws InputError that says at which byte, and not of which file.
  explicit TensorFile(std::string bytes);

  /// Throws InputError where there is none.
  const TensorField& Find(const std::string& name) const;
  /// The numbers of a field of float32, each within [low, kLargestInTensor]; those below
  /// `low` become it, if `raise`, or are an error.
  std::vector<float> Floats(const std::string& name, float low, bool raise) const;
  const std::string& bytes() const { return bytes_; }

 private:
  template <typename T>
  T Read(const char* what);
  void ReadField();

  std::string bytes_;
  std::uint64_t at_ = 0;
  std::map<std::string, TensorField> fields_;
};

}  // namespace lanelight
