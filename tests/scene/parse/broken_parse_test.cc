// Every file of tests/scene/broken fails with the place and the words that its first line
// states: `# expect: LINE:COLUMN | fragment | fragment`. The place is in the file itself
// unless it names another one; `file` stands for the file as a whole.
#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "src/base/core/error.h"
#include "src/scene/parse/parse.h"
#include "tests/scene/parse/parse_text.h"
#include "tests/support/input_error.h"

namespace lanelight {
namespace {

namespace fs = std::filesystem;

struct Expectation {
  std::string place;
  std::vector<std::string> fragments;
};

Expectation ReadExpectation(const fs::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  const std::string label = "# expect: ";
  REQUIRE(line.substr(0, label.size()) == label);
  std::istringstream rest(line.substr(label.size()));
  Expectation expected;
  const auto trim = [](std::string text) {
    text.erase(0, text.find_first_not_of(' '));
    return text.erase(text.find_last_not_of(' ') + 1);
  };
  std::getline(rest, expected.place, '|');
  expected.place = trim(expected.place);
  for (std::string part; std::getline(rest, part, '|');) {
    expected.fragments.push_back(trim(part));
  }
  return expected;
}

// The message of the InputError, or "" if the file parses.
std::string MessageOf(const fs::path& path) {
  return InputErrorOf([&] { ParseScene(path.string()); });
}

std::string ExpectedPrefix(const fs::path& path, const std::string& place) {
  if (place == "file") return path.string() + ": error: ";
  const bool elsewhere = std::count(place.begin(), place.end(), ':') == 2;
  if (elsewhere) return (path.parent_path() / place).string() + ": error: ";
  return path.string() + ":" + place + ": error: ";
}

TEST_CASE("broken scenes are refused with place and reason", "[parse]") {
  const fs::path folder = fs::path(LANELIGHT_SOURCE_DIR) / "tests" / "scene" / "broken";
  int files = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path path = entry.path();
    if (path.extension() != ".pbrt") continue;
    ++files;
    const Expectation expected = ReadExpectation(path);
    const std::string message = MessageOf(path);
    CAPTURE(path.filename().string(), message);
    REQUIRE_FALSE(expected.fragments.empty());
    const std::string prefix = ExpectedPrefix(path, expected.place);
    CHECK(message.substr(0, prefix.size()) == prefix);
    for (const std::string& fragment : expected.fragments) {
      CAPTURE(fragment);
      CHECK(message.find(fragment, fragment[0] == ':' ? 0 : prefix.size()) !=
            std::string::npos);
    }
  }
  CHECK(files >= 60);
}

TEST_CASE("blocks nested more than 1000 deep are refused", "[parse]") {
  std::string text;
  for (int i = 0; i < 1001; ++i) text += "AttributeBegin\n";
  CHECK(WorldError(text).starts_with("test.pbrt:1002:1: error: "));
  CHECK(WorldError(text).find("nested more than 1000 deep") != std::string::npos);
}

}  // namespace
}  // namespace lanelight
