// The registry of stages and the files in kernels/ agree, and the list of path fields is
// consistent with itself.
#include "kernels/stages.h"

#include <cctype>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "kernels/simd/target.h"
#include "src/vocabulary/path/fields.h"
#include "src/vocabulary/path/light_shapes.h"

namespace lanelight {
namespace {

namespace fs = std::filesystem;

const fs::path kKernels = fs::path(LANELIGHT_SOURCE_DIR) / "kernels";

std::string TextOfKernel(const fs::path& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

// Returns whether a header of kernels/ is guarded by the name that the build takes back
// between targets (cmake/kernel_groups.cmake).
bool IsGuardedByPath(std::string path, const std::string& text) {
  for (char& c : path) {
    c = std::isalnum(static_cast<unsigned char>(c)) ? static_cast<char>(std::toupper(c))
                                                    : '_';
  }
  const std::string guard = "LANELIGHT_" + path + "_";
  return text.find("\n#ifndef " + guard + "\n#define " + guard + "\n") !=
         std::string::npos;
}

// Names X of every "Stage XStage() {" in kernels/**.cc.
std::set<std::string> StagesInFiles() {
  std::set<std::string> names;
  const std::regex definition(R"(\nStage (\w+)Stage\(\) \{)");
  for (const auto& entry : fs::recursive_directory_iterator(kKernels)) {
    if (entry.path().extension() != ".cc") continue;
    const std::string s = TextOfKernel(entry.path());
    for (std::sregex_iterator it(s.begin(), s.end(), definition), end; it != end; ++it) {
      names.insert((*it)[1]);
    }
  }
  return names;
}

std::set<std::string> StagesInRegistry() {
  return {
#define X(name) #name,
      LANELIGHT_STAGES(X)
#undef X
  };
}

void KernelWith(Wave&) {}
void KernelWithout(Wave&) {}

// Of all stages, those that have this input and need this feature.
std::vector<Stage> StagesFor(QueueId input, Feature feature) {
  std::vector<Stage> stages = {
#define X(name) name##Stage({}),
      LANELIGHT_STAGES(X)
#undef X
  };
  std::erase_if(stages, [&](const Stage& stage) {
    return stage.input != input || !stage.needs.Has(feature);
  });
  return stages;
}

}  // namespace

TEST_CASE("every shape of light has the stages that its traits ask for", "[registry]") {
  CHECK(StagesFor(QueueId::kLit, Feature::kTriangles).empty());
  for (int i = 0; i < static_cast<int>(LightShape::kCount); ++i) {
    const auto shape = static_cast<LightShape>(i);
    INFO(FeatureName(LightFeature(shape)));
    const std::vector<Stage> samplers = StagesFor(QueueId::kLit, LightFeature(shape));
    REQUIRE(samplers.size() == 1);
    CHECK(samplers[0].needs.Has(Feature::kSampledHittableLights) ==
          !HasTrait(shape, kDeltaLight));
    CHECK(StagesFor(QueueId::kHit, LightFeature(shape)).size() ==
          (HasTrait(shape, kEmittingShape) ? 1 : 0));
    CHECK(!(HasTrait(shape, kEmittingShape) && HasTrait(shape, kDeltaLight)));
    CHECK(!(HasTrait(shape, kEmittingShape) && HasTrait(shape, kFarLight)));
  }
}

TEST_CASE("stages that trace rays have the ray role", "[registry]") {
  const Stage stages[] = {
#define X(name) name##Stage({}),
      LANELIGHT_STAGES(X)
#undef X
  };
  for (const Stage& stage : stages) {
    INFO(stage.name);
    const std::string_view name = stage.name;
    CHECK((stage.role == StageRole::kIntersect) == name.starts_with("intersect_"));
    const bool shadow = name.starts_with("shadow_") || name == "media_shadow";
    CHECK((stage.role == StageRole::kShadow) == shadow);
    CHECK((stage.role == StageRole::kSurface) == name.starts_with("surface_"));
    CHECK((stage.role == StageRole::kBlock) == (stage.scope != StageScope::kWave));
  }
  CHECK(std::string(Name(StageRole::kIntersect)) == "intersect");
}

TEST_CASE("every stage in kernels/ is registered", "[registry]") {
  CHECK(StagesInFiles() == StagesInRegistry());
}

TEST_CASE("every stage has a name of its own, a meaning and a kernel", "[registry]") {
  const std::vector<Stage> stages = {
#define X(name) name##Stage({}),
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

TEST_CASE("a stage has the kernels of the target that it is asked for", "[registry]") {
  std::set<StageFn> kernels;
  for (const std::string& target : AvailableTargets()) {
    const StageFn kernel = CompactStage(SimdTarget(target)).resolve({});
    CHECK(kernel == CompactStage(SimdTarget(target)).resolve({}));
    kernels.insert(kernel);
  }
  CHECK(kernels.size() == AvailableTargets().size());
  CHECK(kernels.contains(CompactStage({}).resolve({})));
}

TEST_CASE("headers of kernels are guarded by their paths", "[registry]") {
  int headers = 0;
  for (const auto& entry : fs::recursive_directory_iterator(kKernels)) {
    const std::string name = fs::relative(entry.path(), kKernels).generic_string();
    if (!name.ends_with("-inl.h") || name == "simd/each_target-inl.h") continue;
    INFO(name);
    CHECK(IsGuardedByPath(name, TextOfKernel(entry.path())));
    ++headers;
  }
  CHECK(headers > 100);
  CHECK(IsGuardedByPath(
      "a/b_c-inl.h",
      "\n#ifndef LANELIGHT_A_B_C_INL_H_\n#define LANELIGHT_A_B_C_INL_H_\n"));
  CHECK(!IsGuardedByPath(
      "a/b_c-inl.h", "\n#ifndef LANELIGHT_A_B_INL_H_\n#define LANELIGHT_A_B_INL_H_\n"));
}

TEST_CASE("a stage has one kernel, or one chosen by a feature", "[registry]") {
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
