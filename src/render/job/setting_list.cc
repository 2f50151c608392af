#include "src/base/core/source_location.h"
#include "src/render/job/setting.h"

#include <algorithm>
#include <cctype>
#include <limits>

#include "kernels/simd/target.h"
#include "src/base/core/check.h"
#include "src/base/image/image.h"
#include "src/scene/compile/compile.h"
#include "src/scene/description/film.h"
#include "src/vocabulary/strategy/strategy_text.h"

namespace lanelight {
namespace {

using S = RenderSettings;

constexpr unsigned kEveryFlag = kSceneFlag | kStudyFlag;
constexpr unsigned kEverySame = kIdentity | kStudyIdentity;

// Returns the default of a flag that scenes may set: "the scene's, else 16".
template <class T>
std::string OfScene(const T& value) {
  return fmt::format("the scene's, else {}", value);
}

struct ChangesType {
  static std::optional<StrategyChanges> Read(const std::string& text) {
    return ParseStrategy(text, {});  // which says itself what is wrong
  }
  static std::string Write(const StrategyChanges& changes) { return changes.text; }
  static std::string Right(const std::string&) { return ""; }
};

std::vector<Setting> Amounts() {
  const NumberType<double> error{1e-12, 1e12};
  constexpr std::uint64_t kMaxSeed = std::numeric_limits<std::uint64_t>::max();
  return {
      Declare({"spp", "N", "Samples per pixel", OfScene(Sampler{}.spp)},
              CountType{1, kMaxSpp}, &S::spp, kAmountFlag | kReported),
      Declare({"time", "TIME",
               "Render for this wall time instead of --spp: 90 (seconds), 5m, 2h", "",
               "time_budget"},
              SecondsType{1e-3, 1e9}, &S::seconds, kAmountFlag | kReported),
      Declare(
          {"target", "X%",
           "Stop once the error (root of the relative MSE) is below X percent with 95 % "
           "confidence; 1% is --target-relmse 0.0001; --spp and --time are then limits",
           "", "", "target-relmse"},
          PercentErrorType{1e-4, 1e8}, &S::target_relmse, kAmountFlag),
      Declare({"target-relmse", "X",
               "Stop once the relative MSE is below X with 95 % confidence"},
              error, &S::target_relmse, kAmountFlag | kReported),
      Declare({"target-rmse", "X", "Stop once the RMSE is below X with 95 % confidence"},
              error, &S::target_rmse, kAmountFlag | kReported),
      Declare({"seed", "S", "Seed of the random numbers", OfScene(Sampler{}.seed)},
              NumberType<std::uint64_t>{0, kMaxSeed}, &S::seed,
              kAmountFlag | kStudyFlag | kEverySame | kReported)};
}

std::vector<Setting> Contents() {
  const Film film;
  return {
      Declare({"resolution", "WxH", "Size of the image in pixels",
               OfScene(SizeType{}.Write({film.width, film.height}))},
              SizeType{kMaxImageSide}, &S::resolution,
              kEveryFlag | kEverySame | kReported),
      Declare({"crop", "x0,y0,x1,y1", "Render only these pixels; x1 and y1 are exclusive",
               OfScene("all")},
              WindowType{}, &S::crop, kEveryFlag | kSweepKey | kEverySame | kReported),
      Declare({"aov", "", "Also write albedo, normal and depth of the first hit"},
              FlagType{}, &S::aov, kSceneFlag | kSweepKey | kIdentity | kReported),
      Declare(
          {"gbuffer", "",
           "Write --aov and point, normals, u, v and slopes of the first hit in that "
           "space"},
          NamesType<Gbuffer>{{{"camera", Gbuffer::kCamera}, {"world", Gbuffer::kWorld}}},
          &S::gbuffer, kSceneFlag | kSweepKey | kIdentity | kReported),
      Declare({"strategy", "TEXT",
               "Sampling strategy: key=value,... (see `lanelight strategies`)",
               OfScene(fmt::format("'{}'", kDefaultStrategyName))},
              ChangesType{}, &S::strategy, kSceneFlag),
      Declare({"sampler", "", "Sample points", "those of the strategy"},
              NamesOf<SampleSequence>(kNumSampleSequences), &S::sampler,
              kSceneFlag | kReported),
      Declare({"transport", "",
               "Colours that paths carry: RGB or wavelengths; scene: wavelengths if a "
               "material or light has a spectrum",
               OfScene("scene")},
              NamesType<TransportSetting>{{{"rgb", TransportSetting::kRgb},
                                           {"spectral", TransportSetting::kSpectral},
                                           {"scene", TransportSetting::kByScene}}},
              &S::transport, kEveryFlag | kSweepKey | kEverySame | kReported),
      Declare({"max-depth", "D", "Maximum number of scattering events of a path",
               OfScene(Integrator{}.max_depth)},
              NumberType<int>{0, kMaxDepth}, &S::max_depth,
              kEveryFlag | kEverySame | kReported),
      Declare({"scattering", "", "Scattering model of all diffuse materials",
               OfScene(ScatteringNames().Write(Material{}.scattering))},
              ScatteringNames(), &S::scattering, kEveryFlag | kSweepKey | kEverySame)};
}

std::vector<Setting> Images() {
  return {Declare(
              {"depth", "half|float", "Type of colours in the EXR"},
              NamesType<bool>{{{"float", false}, {"half", true}}},
              [](auto& s) -> auto& { return s.image.half; }, kImageFlag | kSweepKey),
          Declare(
              {"exposure", "EV", "Exposure of the PNG in stops"},
              NumberType<double>{-100, 100},
              [](auto& s) -> auto& { return s.image.exposure; }, kImageFlag | kSweepKey),
          Declare(
              {"png", "", "Write a PNG beside the EXR"}, FlagType{},
              [](auto& s) -> auto& { return s.image.png; }, kSweepKey)};
}

std::vector<Setting> Execution() {
  const NamesType<BuildQuality> builds = {
      {{"fast", BuildQuality::kFast}, {"high", BuildQuality::kHigh}}};
  return {Declare({"wavefront", "N", "Paths in flight per thread; 0 = fit the cache"},
                  NumberType<std::uint32_t>{0, kMaxWavefront}, &S::wavefront,
                  kEveryFlag | kSweepKey),
          Declare({"build", "", "BVH build: in less time, or for faster rays",
                   builds.Write(CompileOptions{}.build)},
                  builds, &S::build, kEveryFlag | kReported),
          Declare({"copied-triangles", "N",
                   "Copy small instances into world space while the scene grows by at "
                   "most N triangles; 0: none"},
                  NumberType<std::uint64_t>{0, kMaxCopiedTriangles}, &S::copied_triangles,
                  kEveryFlag | kSweepKey | kEverySame | kReported),
          Declare({"threads", "T", "Threads; 0 = all cores"},
                  NumberType<int>{0, kMaxThreads}, &S::threads, kEveryFlag | kReported),
          Declare({"simd", "NAME", "SIMD target (see `lanelight info`)",
                   "the best available", "target"},
                  TargetType(AvailableTargets()), &S::target, kEveryFlag | kEverySame),
          Declare({"skip-unsupported", "",
                   "Omit unsupported parts instead of refusing the scene"},
                  FlagType{}, &S::skip_unsupported, kEveryFlag | kSweepKey | kIdentity)};
}

}  // namespace

const std::vector<Setting>& SettingList() {
  static const std::vector<Setting> list = [] {
    std::vector<Setting> all = Amounts();
    for (const std::vector<Setting>& part : {Contents(), Images(), Execution()}) {
      all.insert(all.end(), part.begin(), part.end());
    }
    return all;
  }();
  return list;
}

const Setting& SettingNamed(const std::string& name) {
  const std::vector<Setting>& list = SettingList();
  const auto found = std::ranges::find_if(
      list, [&](const auto& setting) { return setting.name == name; });
  LL_CHECK(found != list.end());
  return *found;
}

std::string WrittenBy(const Setting& setting) {
  for (const Setting& other : SettingList()) {
    if (other.writes == std::string_view(setting.name)) return other.name;
  }
  return "";
}

NamesType<Scattering> ScatteringNames() {
  return {{{"insphere", Scattering::kInSphere},
           {"lambertian", Scattering::kLambertian},
           {"uniform", Scattering::kUniform}}};
}

TargetType::TargetType(const std::vector<std::string>& targets) {
  for (const std::string& name : targets) names.emplace_back(name, name);
}

std::optional<std::string> TargetType::Read(const std::string& text) const {
  std::string upper = text;
  for (char& c : upper)
    c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return NamesType::Read(upper);
}

std::string TargetType::Right(const std::string& text) const {
  // Cells of a sweep may be for other machines, whose targets are among the names then.
  if (Names() != AvailableTargets()) return NamesType::Right(text);
  return "available: " + TargetProblem(text);
}

}  // namespace lanelight
