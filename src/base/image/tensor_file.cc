#include "src/base/image/tensor_file.h"

#include <fmt/format.h>

#include <cstring>
#include <string_view>
#include <utility>

namespace lanelight {
namespace {

constexpr std::string_view kMagic("tensor_file\0", 12);
constexpr std::uint64_t kMaxFields = 1000, kMaxDimensions = 16;
constexpr int kFloat32 = 10;
constexpr const char* kTypeNames[] = {"none",  "uint8",   "int8",    "uint16",
                                      "int16", "uint32",  "int32",   "uint64",
                                      "int64", "float16", "float32", "float64"};
constexpr std::uint64_t kTypeSizes[] = {0, 1, 1, 2, 2, 4, 4, 8, 8, 2, 4, 8};
constexpr int kTypes = 12;

}  // namespace

template <typename T>
T TensorFile::Read(const char* what) {
  T value;
  if (sizeof value > bytes_.size() - at_) {
    FailAtByte(at_, "the file ends within {}", what);
  }
  std::memcpy(&value, bytes_.data() + at_, sizeof value);
  at_ += sizeof value;
  return value;
}

TensorFile::TensorFile(std::string bytes) : bytes_(std::move(bytes)) {
  if (bytes_.compare(0, kMagic.size(), kMagic) != 0) {
    FailAtByte(0, "does not start with \"tensor_file\"");
  }
  at_ = kMagic.size();
  const int major = Read<std::uint8_t>("the version");
  const int minor = Read<std::uint8_t>("the version");
  if (major != 1 || minor != 0) {
    FailAtByte(kMagic.size(), "version {}.{}; supported: 1.0", major, minor);
  }
  const auto count = Read<std::uint32_t>("the number of fields");
  if (count > kMaxFields) {
    FailAtByte(at_ - 4, "{} fields; at most {}", count, kMaxFields);
  }
  for (std::uint32_t i = 0; i < count; ++i) ReadField();
}

const TensorField& TensorFile::Find(const std::string& name) const {
  const auto found = fields_.find(name);
  if (found != fields_.end()) return found->second;
  throw InputError("has no field \"{}\"", name);
}

void TensorFile::ReadField() {
  TensorField field = {at_, 0, 0, {}, 1};
  const auto length = Read<std::uint16_t>("the name of a field");
  if (length > bytes_.size() - at_) FailAtByte(at_, "the file ends within a name");
  const std::string name = bytes_.substr(at_, length);
  at_ += length;
  const auto dimensions = Read<std::uint16_t>("a number of dimensions");
  if (dimensions > kMaxDimensions) {
    FailAtByte(at_ - 2, "{} dimensions; at most {}", dimensions, kMaxDimensions);
  }
  field.type = Read<std::uint8_t>("a type");
  if (field.type == 0 || field.type >= kTypes) {
    FailAtByte(at_ - 1, "type {} of numbers; there are 1 to {}", field.type, kTypes - 1);
  }
  field.offset = Read<std::uint64_t>("an offset");
  const std::uint64_t size = kTypeSizes[field.type], total = bytes_.size();
  for (int d = 0; d < dimensions; ++d) {
    field.shape.push_back(Read<std::uint64_t>("a shape"));
    if (field.count > 0 && field.shape.back() > total / field.count) {
      FailAtByte(at_ - 8, "a shape with {} numbers in a file of {} bytes",
                 field.shape.back(), total);
    }
    field.count *= field.shape.back();
  }
  if (field.offset > total || field.count > (total - field.offset) / size) {
    FailAtByte(field.place,
               "{} numbers of {} bytes from byte {} on, but the file ends at byte {}",
               field.count, size, field.offset, total);
  }
  if (!fields_.emplace(name, std::move(field)).second) {
    FailAtByte(at_, "a second field \"{}\"", name);
  }
}

std::vector<float> TensorFile::Floats(const std::string& name, float low,
                                      bool raise) const {
  const TensorField& field = Find(name);
  if (field.type != kFloat32) {
    FailAtByte(field.place, "field \"{}\" of type {}; supported: float32", name,
               kTypeNames[field.type]);
  }
  std::vector<float> numbers(field.count);
  if (field.count > 0) {
    std::memcpy(numbers.data(), bytes_.data() + field.offset, field.count * 4);
  }
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (raise && numbers[i] < low && numbers[i] >= -kLargestInTensor) numbers[i] = low;
    if (numbers[i] >= low && numbers[i] <= kLargestInTensor) continue;
    FailAtByte(field.offset + 4 * i,
               "number {} of \"{}\" is {}; it lies within {} and {}", i, name, numbers[i],
               low, kLargestInTensor);
  }
  return numbers;
}

}  // namespace lanelight
