#include "src/base/image/exr_header.h"

#include <ImfChannelList.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include "src/base/core/error.h"
#include "src/base/core/input_file.h"
#include "src/base/image/exr_input.h"

namespace lanelight {
namespace {

// In the order of Imf::Compression.
constexpr const char* kCompressions[] = {"none",  "RLE", "ZIPS", "ZIP",  "PIZ",
                                         "PXR24", "B44", "B44A", "DWAA", "DWAB"};
// In that of Imf::PixelType.
constexpr const char* kPixelTypes[] = {"uint", "half", "float"};

// What every header has, or what is said of in other words.
const std::set<std::string> kUsual = {"channels",
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
  // The two of the screen, and the shape of pixels, are numbers of every file.
  std::erase_if(out.attributes, [](const auto& entry) {
    return kUsual.count(entry.first) > 0 && entry.first != "version";
  });
  for (auto it = header.begin(); it != header.end(); ++it) {
    if (kUsual.count(it.name()) > 0 || out.attributes.count(it.name()) > 0) continue;
    out.other_attributes.push_back(
        fmt::format("{} ({})", it.name(), it.attribute().typeName()));
  }
  return out;
}

}  // namespace

std::vector<ExrPart> ReadExrHeader(const std::string& path) {
  const std::string content = ReadWholeFile(path);
  try {
    CheckExrMemory(content, /*reads_pixels=*/false);
    ExrMemoryInput stream(path, content);
    Imf::MultiPartInputFile file(stream);
    std::vector<ExrPart> parts;
    for (int i = 0; i < file.parts(); ++i) parts.push_back(PartOf(file.header(i)));
    return parts;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(
        fmt::format("{}: cannot read the EXR file: {}", path, WhyNotExr(error, content)));
  }
}

}  // namespace lanelight
