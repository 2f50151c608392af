// Values of a PLY body in order: one reader for text, one for binary in either byte
// order. Both offer Read(type), Left() and Fail(message) to the templates in ply.cc.
#pragma once

#include <fmt/format.h>

#include <fast_float/fast_float.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>

#include "src/base/core/error.h"
#include "src/base/core/suggest.h"
#include "src/scene/parse/lex.h"
#include "src/scene/parse/ply_header.h"

namespace lanelight {

/// Numbers in text, separated by blanks and line ends.
class PlyTextReader {
 public:
  PlyTextReader(std::string_view bytes, const PlyHeader& header, const std::string& name)
      : begin_(bytes.data() + header.body),
        cursor_(begin_),
        end_(bytes.data() + bytes.size()),
        body_line_(header.body_line),
        name_(name) {}

  double Read(PlyType) {
    while (cursor_ < end_ && IsBlank(*cursor_)) ++cursor_;
    if (cursor_ == end_) Fail("the PLY file ends before its data does");
    double value = 0;
    const char* first = *cursor_ == '+' ? cursor_ + 1 : cursor_;
    const auto result = fast_float::from_chars(first, end_, value);
    const bool complete = result.ptr == end_ || IsBlank(*result.ptr);
    if (result.ec == std::errc::invalid_argument || !complete) {
      const char* word_end = std::find_if(cursor_, end_, IsBlank);
      Fail(fmt::format("{} is not a number",
                       Quoted({cursor_, static_cast<std::size_t>(word_end - cursor_)})));
    }
    cursor_ = result.ptr;
    return value;
  }

  /// Returns the maximum number of values that can follow: each takes a digit and a
  /// blank.
  std::size_t Left(std::size_t) const {
    return (static_cast<std::size_t>(end_ - cursor_) + 1) / 2;
  }

  [[noreturn]] void Fail(const std::string& message) const {
    int line = body_line_;
    const char* start = begin_;
    for (const char* at = begin_; at < cursor_; ++at) {
      if (EndsLine(at, end_)) ++line, start = at + 1;
    }
    throw InputError({std::make_shared<const std::string>(name_), line,
                      static_cast<int>(cursor_ - start) + 1},
                     message);
  }

 private:
  static bool IsBlank(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }

  const char* begin_;
  const char* cursor_;
  const char* end_;
  int body_line_;
  std::string name_;
};

/// Binary values; `kSwap`: the file's byte order is not the machine's.
template <bool kSwap>
class PlyBinaryReader {
 public:
  PlyBinaryReader(std::string_view bytes, const PlyHeader& header,
                  const std::string& name)
      : bytes_(bytes), offset_(header.body), name_(name) {}

  double Read(PlyType type) {
    switch (type) {
      case PlyType::kInt8:
        return Take<std::int8_t>();
      case PlyType::kUint8:
        return Take<std::uint8_t>();
      case PlyType::kInt16:
        return Take<std::int16_t>();
      case PlyType::kUint16:
        return Take<std::uint16_t>();
      case PlyType::kInt32:
        return Take<std::int32_t>();
      case PlyType::kUint32:
        return Take<std::uint32_t>();
      case PlyType::kFloat32:
        return Take<float>();
      case PlyType::kFloat64:
        return Take<double>();
    }
    return 0;
  }

  /// Returns the maximum number of items of `size` bytes that can follow.
  std::size_t Left(std::size_t size) const {
    return (bytes_.size() - offset_) / std::max<std::size_t>(size, 1);
  }

  [[noreturn]] void Fail(const std::string& message) const {
    throw InputError({std::make_shared<const std::string>(name_), 0, 0},
                     fmt::format("{} (at byte {})", message, offset_));
  }

 private:
  template <typename T>
  T Take() {
    if (bytes_.size() - offset_ < sizeof(T))
      Fail("the PLY file ends before its data does");
    char raw[sizeof(T)];
    std::memcpy(raw, bytes_.data() + offset_, sizeof(T));
    if constexpr (kSwap) std::reverse(raw, raw + sizeof(T));
    offset_ += sizeof(T);
    T value;
    std::memcpy(&value, raw, sizeof(T));
    return value;
  }

  std::string_view bytes_;
  std::size_t offset_;
  std::string name_;
};

}  // namespace lanelight
