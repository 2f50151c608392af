#include <Iex.h>
#include <ImfChannelList.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfIntAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>
#include <half.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

#include "src/base/core/check.h"
#include "src/base/core/error.h"
#include "src/base/core/parallel.h"
#include "src/base/image/atomic_file.h"
#include "src/base/image/color_spaces.h"
#include "src/base/image/exr.h"

namespace lanelight {
namespace {

class MemoryOutput : public Imf::OStream {
 public:
  explicit MemoryOutput(const std::string& path) : Imf::OStream(path.c_str()) {}

  void write(const char c[], int n) override {
    const std::size_t size = static_cast<std::size_t>(n);
    if (content.size() < at_ + size) content.resize(at_ + size);
    std::memcpy(content.data() + at_, c, size);
    at_ += size;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t to) override { at_ = to; }

  std::string content;

 private:
  std::size_t at_ = 0;
};

constexpr float kMaxHalf = 65504;

std::vector<half> ToHalf(const std::vector<float>& values) {
  std::vector<half> out(values.size());
  std::transform(values.begin(), values.end(), out.begin(), [](float v) {
    return half(std::isfinite(v) ? std::clamp(v, -kMaxHalf, kMaxHalf) : v);
  });
  return out;
}

void AddAttribute(Imf::Header& header, const std::string& name,
                  const ImageAttribute& value) {
  if (const auto* s = std::get_if<std::string>(&value)) {
    header.insert(name, Imf::StringAttribute(*s));
  } else if (const auto* d = std::get_if<double>(&value)) {
    header.insert(name, Imf::FloatAttribute(static_cast<float>(*d)));
  } else {
    header.insert(name, Imf::IntAttribute(std::get<int>(value)));
  }
}

Imf::Header MakeHeader(int width, int height, const std::vector<ExrPlane>& planes,
                       const ExrOptions& options) {
  const Imath::Box2i data({options.x0, options.y0},
                          {options.x0 + width - 1, options.y0 + height - 1});
  const Imath::Box2i display =
      options.full_width > 0
          ? Imath::Box2i({0, 0}, {options.full_width - 1, options.full_height - 1})
          : data;
  Imf::Header header(display, data);
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const ExrPlane& plane : planes) {
    const bool half_float = options.half && !plane.always_float;
    header.channels().insert(plane.name,
                             Imf::Channel(half_float ? Imf::HALF : Imf::FLOAT));
  }
  for (const auto& [name, value] : options.attributes) AddAttribute(header, name, value);
  if (options.color_space != "srgb") {
    const ColorSpace& space = FindColorSpace(options.color_space);
    const auto point = [](Chromaticity c) {
      return Imath::V2f(static_cast<float>(c.x), static_cast<float>(c.y));
    };
    Imf::addChromaticities(header,
                           Imf::Chromaticities(point(space.red), point(space.green),
                                               point(space.blue), point(space.white)));
  }
  return header;
}

// Number of compressing threads, from OpenEXR's own pool; 0 for images that take no
// longer than starting threads.
int Compressors(std::size_t values) {
  constexpr std::size_t kFew = std::size_t{1} << 20;
  const int threads = MaxThreads();
  if (values < kFew || threads == 1) return 0;
  Imf::setGlobalThreadCount(threads);
  return threads;
}

void CheckPlanes(int width, int height, const std::vector<ExrPlane>& planes) {
  LL_CHECK(width > 0 && height > 0 && !planes.empty());
  std::set<std::string> names;
  for (const ExrPlane& plane : planes) {
    LL_CHECK_EQ(plane.values.size(), static_cast<std::size_t>(width) * height);
    LL_CHECK(names.insert(plane.name).second);
  }
}

}  // namespace

void WriteExr(const std::string& path, int width, int height,
              const std::vector<ExrPlane>& planes, const ExrOptions& options) {
  CheckPlanes(width, height, planes);
  const Imf::Header header = MakeHeader(width, height, planes, options);
  const Imath::Box2i& window = header.dataWindow();
  std::vector<std::vector<half>> halves(planes.size());
  Imf::FrameBuffer buffer;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (options.half && !planes[i].always_float) {
      halves[i] = ToHalf(planes[i].values);
      buffer.insert(planes[i].name,
                    Imf::Slice::Make(Imf::HALF, halves[i].data(), window));
    } else {
      buffer.insert(planes[i].name,
                    Imf::Slice::Make(Imf::FLOAT, planes[i].values.data(), window));
    }
  }
  MemoryOutput stream(path);
  try {
    const std::size_t pixels = static_cast<std::size_t>(width) * height;
    Imf::OutputFile file(stream, header, Compressors(pixels * planes.size()));
    file.setFrameBuffer(buffer);
    file.writePixels(height);
  } catch (const Iex::BaseExc&) {
    throw InputError(path + ": OpenEXR cannot encode this image");
  }
  WriteFileAtomically(path, stream.content);
}

}  // namespace lanelight
