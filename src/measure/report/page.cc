#include "src/measure/report/page.h"

#include <fmt/format.h>
#include <half.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <nlohmann/json.hpp>

#include "src/base/core/check.h"
#include "src/base/core/json_text.h"
#include "src/measure/report/page_text.h"

namespace lanelight {
namespace {

constexpr float kMaxHalf = 65504.0f;

// JSON has `<` in texts only, where the escape means the same. Without any `<`, nothing
// in the block can end it or begin a comment.
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

std::string DataBlock(const nlohmann::json& data) {
  return "<script type=\"application/json\" id=\"study\">" + JsonForScript(data) +
         "</script>\n";
}

// The name as JSON, so that the page reads it as it reads the names in the study; then
// safe between double quotes.
std::string Attribute(const std::string& name) {
  std::string out;
  for (const char c : JsonForScript(name)) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '>':
        out += "&gt;";
        break;
      default:
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

std::string WithImages(std::string page, const nlohmann::json& data,
                       const std::vector<ReportImage>& images, const std::string& tail) {
  std::size_t values = 0;
  for (const ReportImage& image : images) values += image.values.size();
  page.reserve(page.size() + values * 8 / 3 + (1 << 20));
  page += DataBlock(data);
  for (const ReportImage& image : images) AppendImage(image, page);
  return page + tail;
}

}  // namespace

std::uint16_t ToHalfBits(float value) {
  // A NaN's payload may not fit: one quiet NaN for all.
  if (std::isnan(value)) return 0x7e00;
  return half(std::clamp(value, -kMaxHalf, kMaxHalf)).bits();
}

std::string ReportPage(const nlohmann::json& study,
                       const std::vector<ReportImage>& images) {
  return WithImages(PageHead(), study, images, PageTail());
}

std::string PaperReportPage(const nlohmann::json& study,
                            const std::vector<ReportImage>& images) {
  return WithImages(PaperPageHead(), study, images, PaperPageTail());
}

std::string ComparisonReportPage(const nlohmann::json& comparisons,
                                 const std::vector<ReportImage>& images) {
  return WithImages(ComparePageHead(), comparisons, images, ComparePageTail());
}

std::string SweepReportPage(const nlohmann::json& sweep,
                            const std::vector<ReportImage>& images) {
  return WithImages(SweepPageHead(), sweep, images, SweepPageTail());
}

std::string BenchReportPage(const nlohmann::json& bench) {
  return BenchPageHead() + DataBlock(bench) + BenchPageTail();
}

std::string StressReportPage(const nlohmann::json& stress) {
  return StressPageHead() + DataBlock(stress) + StressPageTail();
}

std::string LivePage() { return LivePageHead() + LivePageTail(); }

}  // namespace lanelight
