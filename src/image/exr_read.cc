#include <ImfChannelList.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfIntAttribute.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstring>

#include "src/core/error.h"
#include "src/core/input_file.h"
#include "src/image/exr.h"

namespace lanelight {
namespace {

// A reason, to which ReadWithPath adds the path.
struct Damaged : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// An EXR file in memory, so that the system's errors are told from the format's.
class MemoryInput : public Imf::IStream {
 public:
  MemoryInput(const std::string& path, const std::string& content)
      : Imf::IStream(path.c_str()), content_(content) {}

  bool read(char c[], int n) override {
    if (n < 0 || static_cast<std::size_t>(n) > content_.size() - at_) {
      throw Damaged("the image file is truncated");
    }
    std::memcpy(c, content_.data() + at_, static_cast<std::size_t>(n));
    at_ += static_cast<std::size_t>(n);
    return at_ < content_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t to) override {
    if (to > content_.size()) throw Damaged("the image file is truncated");
    at_ = to;
  }

 private:
  const std::string& content_;
  std::size_t at_ = 0;
};

std::vector<std::string> ChannelsOf(const Imf::Header& header) {
  std::vector<std::string> names;
  for (const char* color : {"R", "G", "B", "A"}) {
    if (header.channels().findChannel(color)) names.push_back(color);
  }
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
    if (std::find(names.begin(), names.end(), it.name()) == names.end()) {
      names.push_back(it.name());
    }
  }
  return names;
}

void CheckChannels(const Imf::Header& header, const std::vector<std::string>& wanted) {
  for (const std::string& name : wanted) {
    const Imf::Channel* channel = header.channels().findChannel(name);
    if (!channel) {
      throw Damaged(fmt::format("no channel \"{}\"; the file has {}", name,
                                fmt::join(ChannelsOf(header), ", ")));
    }
    if (channel->xSampling != 1 || channel->ySampling != 1) {
      throw Damaged(fmt::format(
          "channel \"{}\" is subsampled, which is not supported; the file has "
          "{}",
          name, fmt::join(ChannelsOf(header), ", ")));
    }
  }
}

std::map<std::string, ImageAttribute> AttributesOf(const Imf::Header& header) {
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

// The best compression of OpenEXR stores fewer samples than this per byte of file; more
// means a damaged header, noticed before the memory for it is taken.
constexpr std::size_t kMaxSamplesPerByte = 4096;

Image Read(const std::string& path, const std::string& content,
           const std::vector<std::string>* wanted) {
  MemoryInput stream(path, content);
  Imf::InputFile file(stream);
  const Imf::Header& header = file.header();
  const Imath::Box2i window = header.dataWindow();
  const long long width = 1LL + window.max.x - window.min.x;
  const long long height = 1LL + window.max.y - window.min.y;
  CheckImageSize(path, width, height);
  const std::vector<std::string> names = wanted ? *wanted : ChannelsOf(header);
  if (names.empty()) throw Damaged("the file has no channels");
  CheckChannels(header, names);
  const std::size_t samples = names.size() * static_cast<std::size_t>(width * height);
  if (samples / kMaxSamplesPerByte > content.size()) {
    throw Damaged("the image file is truncated");
  }
  Image image = MakeImage(static_cast<int>(width), static_cast<int>(height), names);
  image.attributes = AttributesOf(header);
  Imf::FrameBuffer buffer;
  for (std::size_t c = 0; c < names.size(); ++c) {
    buffer.insert(names[c], Imf::Slice::Make(Imf::FLOAT, image.pixels.data() + c, window,
                                             sizeof(float) * names.size(),
                                             sizeof(float) * names.size() * image.width));
  }
  file.setFrameBuffer(buffer);
  file.readPixels(window.min.y, window.max.y);
  return image;
}

// What OpenEXR says of an error is meant for programmers.
std::string Why(const std::exception& error, const std::string& content) {
  if (dynamic_cast<const Damaged*>(&error) != nullptr) return error.what();
  return content.starts_with("\x76\x2f\x31\x01")
             ? "it is damaged, or of a kind that OpenEXR does not read"
             : "it is not an EXR file";
}

Image ReadWithPath(const std::string& path, const std::vector<std::string>* wanted) {
  const std::string content = ReadWholeFile(path);
  try {
    return Read(path, content, wanted);
  } catch (const InputError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(
        fmt::format("{}: cannot read the EXR file: {}", path, Why(error, content)));
  }
}

}  // namespace

Image ReadExr(const std::string& path) { return ReadWithPath(path, nullptr); }

Image ReadExr(const std::string& path, const std::vector<std::string>& channels) {
  return ReadWithPath(path, &channels);
}

}  // namespace lanelight
