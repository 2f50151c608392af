// The report's page holds what went in, unharmed and harmless.
#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <string>
#include <vector>
#include <nlohmann/json.hpp>

#include "src/base/core/check.h"
#include "src/measure/report/page.h"
#include "tests/measure/report/synthetic_study.h"

namespace lanelight {
namespace {

using Json = nlohmann::json;

// What follows `begin`, up to `end`; fails if either is missing.
std::string Between(const std::string& text, const std::string& begin,
                    const std::string& end) {
  const std::size_t from = text.find(begin);
  REQUIRE(from != std::string::npos);
  const std::size_t start = from + begin.size(), to = text.find(end, start);
  REQUIRE(to != std::string::npos);
  return text.substr(start, to - start);
}

// An HTML parser ends a script at the first "</script", whatever it holds.
Json StudyOf(const std::string& page) {
  return Json::parse(
      Between(page, "<script type=\"application/json\" id=\"study\">", "</script"));
}

int Count(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos;
       at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

std::vector<int> DecodeBase64(const std::string& text) {
  const std::string digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<int> bytes;
  unsigned bits = 0, have = 0;
  for (const char c : text) {
    if (c == '=') break;
    REQUIRE(digits.find(c) != std::string::npos);
    bits = (bits << 6 | unsigned(digits.find(c))) & 0xffffff;
    have += 6;
    if (have >= 8) bytes.push_back((bits >> (have -= 8)) & 255);
  }
  return bytes;
}

// By the definition of the format (IEEE 754-2019, section 3.4).
double HalfValue(int bits) {
  const int exponent = (bits >> 10) & 31, fraction = bits & 1023;
  const double sign = bits & 0x8000 ? -1 : 1;
  if (exponent == 31) {
    return fraction ? std::numeric_limits<double>::quiet_NaN()
                    : sign * std::numeric_limits<double>::infinity();
  }
  return exponent == 0 ? sign * std::ldexp(fraction, -24)
                       : sign * std::ldexp(1024 + fraction, exponent - 25);
}

Json OneName(const std::string& name) {
  return {{"schema", 1}, {"scenes", {{{"name", name}, {"error", name}}}}};
}

}  // namespace

TEST_CASE("The page contains the study", "[report]") {
  const SyntheticStudy synthetic = MakeSyntheticStudy();
  const std::string page =
      ReportPage(PageKind::kStudy, synthetic.study, synthetic.images);
  CHECK(StudyOf(page) == synthetic.study);
  CHECK(Count(page, "class=\"image-data\"") == int(synthetic.images.size()));
  CHECK(page.substr(0, 15) == "<!doctype html>");
  CHECK(page.substr(page.size() - 8) == "</html>\n");
}

TEST_CASE("The page is the same for the same study", "[report]") {
  const SyntheticStudy a = MakeSyntheticStudy(), b = MakeSyntheticStudy();
  CHECK(ReportPage(PageKind::kStudy, a.study, a.images) ==
        ReportPage(PageKind::kStudy, b.study, b.images));
}

TEST_CASE("Texts are escaped inside the page's script", "[report]") {
  for (const std::string& text :
       {std::string(kHostileName), std::string("</SCRIPT >"), std::string("<!--<script>"),
        std::string("\"\\\n\t\x01 ]]>"), std::string("nul\0inside", 10)}) {
    const std::string plain =
        ReportPage(PageKind::kStudy, OneName("x"), {{"x", 1, 1, 1, {1}}});
    const std::string page =
        ReportPage(PageKind::kStudy, OneName(text), {{text, 1, 1, 1, {1}}});
    CHECK(StudyOf(page) == OneName(text));
    // Whatever the text is, it adds no tag and no comment.
    CHECK(Count(page, "<") == Count(plain, "<"));
    CHECK(Count(page, ">") - Count(plain, ">") <= 2 * Count(text, ">"));
    std::string name = Between(page, "data-name=\"", "\"");
    CHECK(name.find_first_of("<>") == std::string::npos);
  }
}

TEST_CASE("Texts that are not UTF-8 are replaced", "[report]") {
  const Json found = StudyOf(ReportPage(PageKind::kStudy, OneName("a\xff z"), {}));
  CHECK(found["scenes"][0]["name"] == "a\xef\xbf\xbd z");
}

TEST_CASE("Half floats are the nearest ones and saturate", "[report]") {
  const float inf = std::numeric_limits<float>::infinity();
  CHECK(ToHalfBits(0.0f) == 0);
  CHECK(ToHalfBits(-0.0f) == 0x8000);
  CHECK(ToHalfBits(1.0f) == 0x3c00);
  CHECK(ToHalfBits(65504.0f) == 0x7bff);
  CHECK(ToHalfBits(1e9f) == 0x7bff);
  CHECK(ToHalfBits(inf) == 0x7bff);
  CHECK(ToHalfBits(-inf) == 0xfbff);
  CHECK(std::isnan(HalfValue(ToHalfBits(std::nanf("")))));
  for (int bits = 0; bits < 0x7c00; ++bits) {  // every finite value comes back
    if (ToHalfBits(float(HalfValue(bits))) != bits) FAIL("bits " << bits);
    if (ToHalfBits(-float(HalfValue(bits))) != (bits | 0x8000)) FAIL("minus " << bits);
  }
  // A tie goes to the even neighbour.
  CHECK(ToHalfBits(float(0.5 * (HalfValue(0x3c00) + HalfValue(0x3c01)))) == 0x3c00);
  CHECK(ToHalfBits(float(0.5 * (HalfValue(0x3c01) + HalfValue(0x3c02)))) == 0x3c02);
}

TEST_CASE("Images round-trip through the page", "[report]") {
  for (const int width : {1, 2, 3, 4}) {  // every length of the last base64 group
    ReportImage image{"an image", width, 2, width == 3 ? 3 : 1, {}};
    const int count = image.width * image.height * image.channels;
    for (int i = 0; i < count; ++i) image.values.push_back(0.37f * float(i) - 1);
    image.values[0] = std::nanf("");
    const std::string page = ReportPage(PageKind::kStudy, Json::object(), {image});
    const std::vector<int> bytes = DecodeBase64(Between(
        page, "data-channels=\"" + std::to_string(image.channels) + "\">", "</script>"));
    REQUIRE(int(bytes.size()) == 2 * count);
    CHECK(std::isnan(HalfValue(bytes[0] | bytes[1] << 8)));
    for (int i = 1; i < count; ++i) {
      const double half = HalfValue(bytes[2 * i] | bytes[2 * i + 1] << 8);
      CHECK(half == Approx(image.values[i]).epsilon(1.0 / 2048));
    }
  }
}

TEST_CASE("An image of the wrong size fails a check", "[report]") {
  CHECK_THROWS_AS(
      ReportPage(PageKind::kStudy, Json::object(), {{"x", 2, 2, 3, {1, 2, 3}}}),
      CheckFailure);
  CHECK_THROWS_AS(ReportPage(PageKind::kStudy, Json::object(), {{"x", 1, 1, 2, {1, 2}}}),
                  CheckFailure);
}

TEST_CASE("The page loads nothing from the network", "[report]") {
  std::string page = ReportPage(PageKind::kStudy, Json::object(), {});
  // The namespace of SVG is no address that a browser fetches.
  const std::string space = "http://www.w3.org/2000/svg";
  const std::size_t at = page.find(space);
  REQUIRE(at != std::string::npos);
  page.erase(at, space.size());
  for (const char* trace : {"http://", "https://", "src=\"", "@import", "url("}) {
    CAPTURE(trace);
    CHECK(Count(page, trace) == 0);
  }
  CHECK(Count(page, "default-src 'none'") == 1);
  CHECK(Count(page, "SCRIPT_HASHES") + Count(page, "STYLE_HASHES") == 0);
}

// Not a test of its own: the browser's test needs a page to look at.
TEST_CASE("The synthetic report can be written", "[report]") {
  const char* path = std::getenv("LANELIGHT_SYNTHETIC_REPORT");
  const SyntheticStudy synthetic = MakeSyntheticStudy();
  const std::string page =
      ReportPage(PageKind::kStudy, synthetic.study, synthetic.images);
  CHECK(page.size() > 1'000'000);
  if (path == nullptr) return;
  std::ofstream file(path, std::ios::binary);
  file << page;
  REQUIRE(file.flush().good());
}

}  // namespace lanelight
