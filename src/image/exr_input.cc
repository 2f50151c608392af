#include "src/image/exr_input.h"

#include <ImfFloatAttribute.h>
#include <ImfIntAttribute.h>
#include <ImfStringAttribute.h>

#include <cstring>

namespace lanelight {

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

std::string WhyNotExr(const std::exception& error, const std::string& content) {
  if (dynamic_cast<const DamagedExr*>(&error) != nullptr) return error.what();
  return content.starts_with("\x76\x2f\x31\x01")
             ? "it is damaged, or of a kind that OpenEXR does not read"
             : "it is not an EXR file";
}

}  // namespace lanelight
