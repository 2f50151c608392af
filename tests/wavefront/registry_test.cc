// The registry of stages and the files in kernels/ agree, and the list of path fields is
// consistent with itself.
#include "kernels/stages.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "src/path/fields.h"

namespace lanelight {
namespace {

// Names X of every "Stage XStage() {" in kernels/**.cc.
std::set<std::string> StagesInFiles() {
  std::set<std::string> names;
  const std::regex definition(R"(\nStage (\w+)Stage\(\) \{)");
  const std::filesystem::path root =
      std::filesystem::path(LANELIGHT_SOURCE_DIR) / "kernels";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    if (entry.path().extension() != ".cc") continue;
    std::ifstream file(entry.path());
    std::stringstream text;
    text << file.rdbuf();
    const std::string s = text.str();
    for (std::sregex_iterator it(s.begin(), s.end(), definition), end; it != end; ++it) {
      names.insert((*it)[1]);
    }
  }
  return names;
}

std::set<std::string> RegisteredStages() {
  return {
#define X(name) #name,
      LANELIGHT_STAGES(X)
#undef X
  };
}

}  // namespace

TEST_CASE("every stage in kernels/ is registered", "[registry]") {
  CHECK(StagesInFiles() == RegisteredStages());
}

TEST_CASE("every stage has a name of its own, a meaning and a kernel", "[registry]") {
  const std::vector<Stage> stages = {
#define X(name) name##Stage(),
      LANELIGHT_STAGES(X)
#undef X
  };
  std::set<std::string> names;
  for (const Stage& stage : stages) {
    INFO(stage.name);
    CHECK(std::string(stage.meaning).size() > 8);
    CHECK(stage.resolve != nullptr);
    CHECK(names.insert(stage.name).second);
  }
}

TEST_CASE("every path field is documented and four bytes wide", "[registry]") {
  for (std::size_t i = 0; i < kNumFields; ++i) {
    const Field f = static_cast<Field>(i);
    CHECK(std::string(FieldMeaning(f)).size() > 3);
    CHECK(std::set<std::string>{"f32", "u32", "i32"}.count(FieldType(f)) == 1);
  }
}

}  // namespace lanelight
