#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

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
          "channel \"{}\" is subsampled, which is not supported; the file has {}", name,
          fmt::join(ChannelsOf(header), ", ")));
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

// Calls read(content of the file). Turns its errors into InputErrors that name the file.
template <class ReadContent>
auto WithExr(const std::string& path, const ReadContent& read) {
  const std::string content = ReadWholeFile(path);
  try {
    return read(content);
  } catch (const InputError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError("{}: cannot read the EXR file: {}", path,
                     ExrProblem(error, content));
  }
}

// In the order of Imf::Compression.
constexpr const char* kCompressions[] = {"none",  "RLE", "ZIPS", "ZIP",  "PIZ",
                                         "PXR24", "B44", "B44A", "DWAA", "DWAB"};
// In the order of Imf::PixelType.
constexpr const char* kPixelTypes[] = {"uint", "half", "float"};

// Attributes of every header, or shown in other ways.
const std::set<std::string> kStandardAttributes = {"channels",
                                                   "compression",
                                                   "dataWindow",
                                                   "displayWindow",
                                                   "lineOrder",
                                                   "pixelAspectRatio",
                                                   "screenWindowCenter",
                                                   "screenWindowWidth",
                                                   "name",
                                                   "type",
                                                   "version",
                                                   "chunkCount"};

template <std::size_t N>
std::string NameIn(const char* const (&names)[N], int index) {
  return index >= 0 && index < static_cast<int>(N) ? names[index]
                                                   : fmt::format("number {}", index);
}

std::array<int, 4> WindowOf(const Imath::Box2i& box) {
  return {box.min.x, box.min.y, box.max.x, box.max.y};
}

std::size_t PlaceOf(const std::string& channel) {
  const std::string_view colors = "RGBA";
  return channel.size() == 1 ? std::min(colors.find(channel), colors.size())
                             : colors.size();
}

ExrPart PartOf(const Imf::Header& header) {
  ExrPart out;
  if (header.hasName()) out.name = header.name();
  out.kind = header.hasType()              ? header.type()
             : header.hasTileDescription() ? Imf::TILEDIMAGE
                                           : Imf::SCANLINEIMAGE;
  out.compression = NameIn(kCompressions, header.compression());
  out.data_window = WindowOf(header.dataWindow());
  out.display_window = WindowOf(header.displayWindow());
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
    const Imf::Channel& c = it.channel();
    out.channels.push_back(
        {it.name(), NameIn(kPixelTypes, c.type), c.xSampling, c.ySampling});
  }
  std::sort(out.channels.begin(), out.channels.end(),
            [](const ExrChannel& a, const ExrChannel& b) {
              return std::make_pair(PlaceOf(a.name), a.name) <
                     std::make_pair(PlaceOf(b.name), b.name);
            });
  out.attributes = ExrAttributes(header);
  std::erase_if(out.attributes, [](const auto& entry) {
    return kStandardAttributes.count(entry.first) > 0 && entry.first != "version";
  });
  for (auto it = header.begin(); it != header.end(); ++it) {
    if (kStandardAttributes.count(it.name()) > 0 || out.attributes.count(it.name()) > 0)
      continue;
    out.other_attributes.push_back(
        fmt::format("{} ({})", it.name(), it.attribute().typeName()));
  }
  return out;
}

}  // namespace

std::vector<ExrPart> ReadExrHeader(const std::string& path) {
  return WithExr(path, [&](const std::string& content) {
    CheckExrMemory(content, /*reads_pixels=*/false);
    ExrMemoryInput stream(path, content);
    Imf::MultiPartInputFile file(stream);
    std::vector<ExrPart> parts;
    for (int i = 0; i < file.parts(); ++i) parts.push_back(PartOf(file.header(i)));
    return parts;
  });
}

Image ReadExr(const std::string& path) {
  return WithExr(
      path, [&](const std::string& content) { return Read(path, content, nullptr); });
}

Image ReadExr(const std::string& path, const std::vector<std::string>& channels) {
  return WithExr(
      path, [&](const std::string& content) { return Read(path, content, &channels); });
}

}  // namespace lanelight
