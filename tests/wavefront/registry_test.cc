// The registry of stages and the files in kernels/ agree, and the list of path fields is
// consistent with itself.
#include "kernels/stages.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "kernels/simd/target.h"
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

void KernelWith(Wave&) {}
void KernelWithout(Wave&) {}

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

TEST_CASE("a stage resolves to the kernel of the target that is chosen then",
          "[registry]") {
  const Stage stage = PackStage();  // made before
  std::set<StageFn> kernels;
  for (const std::string& target : AvailableTargets()) {
    ForceTarget(target);
    kernels.insert(stage.resolve({}));
    CHECK(stage.resolve({}) == PackStage().resolve({}));
  }
  ForceTarget("");
  CHECK(kernels.size() == AvailableTargets().size());
}

TEST_CASE("a kernel is always the same, or chosen by a feature", "[registry]") {
  CHECK(Always<KernelWith>({}) == KernelWith);
  constexpr auto by_lens = ByFeature<Feature::kLens, KernelWith, KernelWithout>;
  CHECK(by_lens({Feature::kLens}) == KernelWith);
  CHECK(by_lens({Feature::kLights}) == KernelWithout);
}

TEST_CASE("every path field is documented and four bytes wide", "[registry]") {
  for (std::size_t i = 0; i < kNumFields; ++i) {
    const Field f = static_cast<Field>(i);
    CHECK(std::string(FieldMeaning(f)).size() > 3);
    CHECK(std::set<std::string>{"f32", "u32", "i32"}.count(FieldType(f)) == 1);
  }
}

}  // namespace lanelight
