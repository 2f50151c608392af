#include <fmt/format.h>

#include "src/base/core/error.h"
#include "src/base/image/decode.h"

namespace lanelight {
namespace {

constexpr int kJpegTables = 0xc4, kJpegEnd = 0xd9, kJpegScan = 0xda;

class JpegWalk {
 public:
  JpegWalk(const std::string& path, const std::string& content)
      : path_(path), content_(content) {}

  void Run() {
    constexpr int kMaxScans = 500;  // encoders write about ten
    int scans = 0;
    for (int marker = Next(); marker != kJpegEnd; marker = Next()) {
      const std::size_t size = static_cast<std::size_t>(Byte(at_) << 8 | Byte(at_ + 1));
      if (marker == kJpegTables) CheckTables(at_ + 2, at_ + size);
      at_ += size;
      if (marker != kJpegScan || ++scans <= kMaxScans) continue;
      throw InputError("{}: the image has more than {} scans", path_, kMaxScans);
    }
  }

 private:
  int Byte(std::size_t at) const {
    return at < content_.size() ? static_cast<unsigned char>(content_[at]) : 0;
  }
  // Returns the marker of the next segment, after coded data.
  int Next() {
    while ((at_ = content_.find('\xff', at_)) != content_.npos) {
      while (Byte(at_) == 0xff) ++at_;
      const int marker = Byte(at_++);
      const bool is_data = marker < 2 || (marker >= 0xd0 && marker <= 0xd8);
      if (!is_data) return marker;
    }
    return kJpegEnd;
  }
  // stb writes a Huffman table of any length into room for 256 codes.
  void CheckTables(std::size_t at, std::size_t end) const {
    while (at < end) {
      int codes = 0;
      for (std::size_t i = 1; i <= 16; ++i) codes += Byte(at + i);
      if (codes > 256) {
        throw InputError(
            path_ +
            ": the image file is damaged: a Huffman table of more than 256 codes");
      }
      at += 17 + static_cast<std::size_t>(codes);
    }
  }

  const std::string& path_;
  const std::string& content_;
  std::size_t at_ = 0;
};

}  // namespace

void CheckJpeg(const std::string& path, const std::string& content) {
  JpegWalk(path, content).Run();
}

}  // namespace lanelight
