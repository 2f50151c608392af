#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "src/base/core/error.h"
#include "src/base/core/input_file.h"
#include "src/base/image/exr.h"
#include "src/base/image/exr_input.h"

namespace lanelight {
namespace {

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
      throw DamagedExr(fmt::format("no channel \"{}\"; the file has {}", name,
                                   fmt::join(ChannelsOf(header), ", ")));
    }
    if (channel->xSampling != 1 || channel->ySampling != 1) {
      throw DamagedExr(fmt::format(
          "channel \"{}\" is subsampled, which is not supported; the file has "
          "{}",
          name, fmt::join(ChannelsOf(header), ", ")));
    }
  }
}

Image Read(const std::string& path, const std::string& content,
           const std::vector<std::string>* wanted) {
  CheckExrMemory(content, /*reads_pixels=*/true);
  ExrMemoryInput stream(path, content);
  Imf::InputFile file(stream);
  const Imf::Header& header = file.header();
  const Imath::Box2i window = header.dataWindow();
  const long long width = 1LL + window.max.x - window.min.x;
  const long long height = 1LL + window.max.y - window.min.y;
  CheckImageSize(path, width, height);
  const std::vector<std::string> names = wanted ? *wanted : ChannelsOf(header);
  if (names.empty()) throw DamagedExr("the file has no channels");
  CheckChannels(header, names);
  const std::size_t samples = names.size() * static_cast<std::size_t>(width * height);
  if (samples / kMaxExrSamplesPerByte > content.size()) {
    throw DamagedExr("the image file is truncated");
  }
  Image image = MakeImage(static_cast<int>(width), static_cast<int>(height), names);
  image.attributes = ExrAttributes(header);
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
        fmt::format("{}: cannot read the EXR file: {}", path, WhyNotExr(error, content)));
  }
}

}  // namespace

Image ReadExr(const std::string& path) { return ReadWithPath(path, nullptr); }

Image ReadExr(const std::string& path, const std::vector<std::string>& channels) {
  return ReadWithPath(path, &channels);
}

}  // namespace lanelight
