#include "src/base/image/exr_input.h"

#include <ImfFloatAttribute.h>
#include <ImfIntAttribute.h>
#include <ImfStringAttribute.h>

#include <cstring>

namespace lanelight {
namespace {

constexpr const char* kExrMagic = "\x76\x2f\x31\x01";

// Values of a header that decide how much memory OpenEXR takes before it reads pixels.
struct HeaderSizes {
  std::int64_t width = 1, height = 1, tile_width = 1, tile_height = 1;
  bool deep = false;
};

// Reads the attributes of a header in file order: name, type, size, value. OpenEXR
// allocates whatever size they claim.
class HeaderWalk {
 public:
  HeaderWalk(const std::string& content, std::size_t at) : content_(content), at_(at) {}

  HeaderSizes Next() {
    HeaderSizes sizes;
    for (std::string name = Text(); !name.empty(); name = Text()) {
      Text();  // type
      const auto size = static_cast<std::uint32_t>(Number(at_));
      at_ += sizeof(std::int32_t);
      if (at_ > content_.size() || size > content_.size() - at_) Truncated();
      if (name == "dataWindow" && size >= 16) {
        sizes.width = std::int64_t{1} + Number(at_ + 8) - Number(at_);
        sizes.height = std::int64_t{1} + Number(at_ + 12) - Number(at_ + 4);
      } else if (name == "tiles" && size >= 8) {
        sizes.tile_width = static_cast<std::uint32_t>(Number(at_));
        sizes.tile_height = static_cast<std::uint32_t>(Number(at_ + 4));
      } else if (name == "type") {
        sizes.deep = content_.compare(at_, 4, "deep") == 0;
      }
      at_ += size;
    }
    return sizes;
  }
  /// An empty header ends those of a file of several parts.
  bool AtEnd() const { return at_ >= content_.size() || content_[at_] == '\0'; }

 private:
  [[noreturn]] static void Truncated() {
    throw DamagedExr("the image file is truncated");
  }
  std::string Text() {
    const std::size_t end = content_.find('\0', at_);
    if (end == content_.npos) Truncated();
    std::string text = content_.substr(at_, end - at_);
    at_ = end + 1;
    return text;
  }
  std::int32_t Number(std::size_t at) const {
    if (at + sizeof(std::int32_t) > content_.size()) Truncated();
    std::uint32_t bits = 0;
    for (std::size_t i = sizeof(bits); i-- > 0;) {
      bits = bits << 8 | static_cast<unsigned char>(content_[at + i]);
    }
    return static_cast<std::int32_t>(bits);
  }

  const std::string& content_;
  std::size_t at_;
};

}  // namespace

bool ExrMemoryInput::read(char c[], int n) {
  if (n < 0 || static_cast<std::size_t>(n) > content_.size() - at_) {
    throw DamagedExr("the image file is truncated");
  }
  std::memcpy(c, content_.data() + at_, static_cast<std::size_t>(n));
  at_ += static_cast<std::size_t>(n);
  return at_ < content_.size();
}

void ExrMemoryInput::seekg(std::uint64_t to) {
  if (to > content_.size()) throw DamagedExr("the image file is truncated");
  at_ = to;
}

std::map<std::string, ImageAttribute> ExrAttributes(const Imf::Header& header) {
  std::map<std::string, ImageAttribute> attributes;
  for (auto it = header.begin(); it != header.end(); ++it) {
    const Imf::Attribute& attribute = it.attribute();
    if (const auto* s = dynamic_cast<const Imf::StringAttribute*>(&attribute)) {
      attributes[it.name()] = s->value();
    } else if (const auto* f = dynamic_cast<const Imf::FloatAttribute*>(&attribute)) {
      attributes[it.name()] = static_cast<double>(f->value());
    } else if (const auto* i = dynamic_cast<const Imf::IntAttribute*>(&attribute)) {
      attributes[it.name()] = i->value();
    }
  }
  return attributes;
}

std::string ExrProblem(const std::exception& error, const std::string& content) {
  if (dynamic_cast<const DamagedExr*>(&error) != nullptr) return error.what();
  return content.starts_with(kExrMagic)
             ? "it is damaged, or of a kind that OpenEXR does not read"
             : "it is not an EXR file";
}

void CheckExrMemory(const std::string& content, bool reads_pixels) {
  constexpr std::size_t kStart = 8;  // magic number, version
  constexpr std::uint32_t kSeveralParts = 1 << 12;
  // OpenEXR reports other contents.
  if (content.size() < kStart || !content.starts_with(kExrMagic)) return;
  const auto flags = static_cast<unsigned char>(content[5]);
  const bool several = (static_cast<std::uint32_t>(flags) << 8 & kSeveralParts) != 0;
  HeaderWalk walk(content, kStart);
  do {
    const HeaderSizes sizes = walk.Next();
    if (!reads_pixels) continue;
    // Each pixel has its own number of samples.
    if (sizes.deep) throw DamagedExr("deep images are not read");
    if (sizes.width < 1 || sizes.height < 1) {
      throw DamagedExr("the data window is empty or negative");
    }
    const double bytes = double(content.size()) * double(kMaxExrSamplesPerByte);
    if (double(sizes.width) * double(sizes.height) > bytes ||
        double(sizes.tile_width) * double(sizes.tile_height) > bytes) {
      throw DamagedExr("the image file is truncated");
    }
  } while (several && !walk.AtEnd());
}

}  // namespace lanelight
