// JSON that was read from a file: what is wrong with it is said in our words.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "src/base/core/json_text.h"
#include "tests/support/input_error.h"

namespace lanelight {
namespace {

std::string Nested(std::size_t depth) {
  return std::string(depth, '[') + std::string(depth, ']');
}

// What an InputError says of the text of a file "f", which should be {"a": number}.
std::string Complaint(const std::string& text) {
  return InputErrorOf(
      [&] { FromJsonOf("f", [&] { return ParseJson(text).at("a").get<double>(); }); });
}

}  // namespace

TEST_CASE("deeply nested JSON is refused before it overflows the stack") {
  CHECK(ParseJson(Nested(kDeepestJson)).is_array());
  for (const std::size_t deep : {std::size_t{kDeepestJson + 1}, std::size_t{1000000}}) {
    CHECK(Complaint(Nested(deep)) ==
          "error: 'f' is damaged: values are nested more than 64 deep");
  }
  std::string objects;
  for (int i = 0; i < 100000; ++i) objects += "{\"a\":";
  CHECK_THAT(Complaint(objects), Catch::Contains("64 deep"));
}

TEST_CASE("malformed JSON is refused with a message of our own") {
  CHECK(Complaint("{\"a\": 1}") == "");
  CHECK(Complaint("{\"a\" 1}") == "error: 'f' is damaged: invalid JSON at byte 6");
  CHECK_THAT(Complaint("{\"b\": 1}"), Catch::Contains("a value is missing"));
  CHECK_THAT(Complaint("{\"a\": \"1\"}"), Catch::Contains("of another type"));
  CHECK_THAT(Complaint("[]"), Catch::Contains("of another type"));
}

}  // namespace lanelight
