#include "src/measure/report/page.h"

#include <fmt/format.h>
#include <half.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string_view>

#include "src/base/core/check.h"
#include "src/base/core/json_text.h"

namespace lanelight {
namespace {

constexpr float kMaxHalf = 65504.0f;

// Escapes `<`, which JSON has in texts only, so that no text can end the script element
// or begin a comment.
std::string JsonForScript(const nlohmann::json& json) {
  const std::string text = DumpJson(json);
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    if (c == '<') {
      out += "\\u003c";
    } else {
      out += c;
    }
  }
  return out;
}

// Returns the name as JSON, which the page parses, escaped for double quotes.
std::string Attribute(const std::string& name) {
  std::string out;
  for (const char c : JsonForScript(name)) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '"') {
      out += "&quot;";
    } else if (c == '>') {
      out += "&gt;";
    } else {
      out += c;
    }
  }
  return out;
}

void AppendBase64(const std::vector<std::uint8_t>& bytes, std::string& out) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = std::min<std::size_t>(bytes.size() - i, 3);
    std::uint32_t group = bytes[i] << 16;
    if (left > 1) group |= bytes[i + 1] << 8;
    if (left > 2) group |= bytes[i + 2];
    for (std::size_t digit = 0; digit < 4; ++digit) {
      out += digit <= left ? kDigits[(group >> (18 - 6 * digit)) & 63] : '=';
    }
  }
}

void AppendImage(const ReportImage& image, std::string& page) {
  LL_CHECK(image.width > 0 && image.height > 0);
  LL_CHECK(image.channels == 1 || image.channels == 3);
  LL_CHECK_EQ(image.values.size(),
              std::size_t(image.width) * image.height * image.channels);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(image.values.size() * 2);
  for (const float value : image.values) {
    const std::uint16_t bits = ToHalfBits(value);
    bytes.push_back(bits & 255);
    bytes.push_back(bits >> 8);
  }
  page += fmt::format(
      "<script type=\"text/plain\" class=\"image-data\" data-name=\"{}\" "
      "data-width=\"{}\" data-height=\"{}\" data-channels=\"{}\">",
      Attribute(image.name), image.width, image.height, image.channels);
  AppendBase64(bytes, page);
  page += "</script>\n";
}

std::size_t CountValues(const std::vector<ReportImage>& images) {
  std::size_t values = 0;
  for (const ReportImage& image : images) values += image.values.size();
  return values;
}

ReportImage Shrunk(const ReportImage& image, int side) {
  ReportImage out;
  out.name = image.name;
  out.width = (image.width + side - 1) / side;
  out.height = (image.height + side - 1) / side;
  out.channels = image.channels;
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      const int x1 = std::min(image.width, (x + 1) * side);
      const int y1 = std::min(image.height, (y + 1) * side);
      for (int c = 0; c < image.channels; ++c) {
        double sum = 0;
        for (int yy = y * side; yy < y1; ++yy) {
          for (int xx = x * side; xx < x1; ++xx) {
            sum +=
                image.values[(std::size_t(yy) * image.width + xx) * image.channels + c];
          }
        }
        const double count = double(x1 - x * side) * double(y1 - y * side);
        out.values.push_back(float(sum / count));
      }
    }
  }
  return out;
}

}  // namespace

std::uint16_t ToHalfBits(float value) {
  // The payload of a NaN may not fit.
  if (std::isnan(value)) return 0x7e00;
  return half(std::clamp(value, -kMaxHalf, kMaxHalf)).bits();
}

std::string ReportPage(PageKind kind, const nlohmann::json& data,
                       const std::vector<ReportImage>& images) {
  const PageText text = TextOf(kind);
  std::string page = text.head;
  page.reserve(page.size() + CountValues(images) * 8 / 3 + (1 << 20));
  page += "<script type=\"application/json\" id=\"study\">" + JsonForScript(data) +
          "</script>\n";
  for (const ReportImage& image : images) AppendImage(image, page);
  return page + text.tail;
}

std::string LivePage() {
  const PageText text = TextOf(PageKind::kLive);
  return text.head + text.tail;
}

int ShrinkImages(std::vector<ReportImage>& images, std::size_t max_values) {
  const double excess = double(CountValues(images)) / double(max_values);
  const int side = std::max(1, int(std::ceil(std::sqrt(excess))));
  if (side == 1) return side;
  for (ReportImage& image : images) image = Shrunk(image, side);
  return side;
}

}  // namespace lanelight
