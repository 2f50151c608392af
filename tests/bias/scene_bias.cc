#include "tests/bias/scene_bias.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <sstream>

#include "src/scene/parse/parse.h"
#include "src/vocabulary/path/light_shapes.h"
#include "tests/vocabulary/strategy/combinations.h"

namespace lanelight::test {
namespace {

const char* const kBase = "decide=none";

// Strategies whose rays nearly never meet the lamps of a scene, or the lobes of its coats
// of roughness 0.001: all renders miss the same light, so that they seem to agree on too
// dark an image. (In a corner of coffee, uniform directions reach 0.868 of the right
// value with 1024 samples and 0.927 with 65536.)
struct Blind {
  const char* scene;  // part of its path
  const char* choice;
};
constexpr Blind kBlind[] = {
    {"/blinds.", "directions=bsdf"},      {"/blinds.", "directions=uniform"},
    {"/tiny-light.", "directions=bsdf"},  {"/tiny-light.", "directions=uniform"},
    {"/coffee/", "directions=light"},     {"/coffee/", "directions=uniform"},
    {"/spaceship/", "directions=uniform"}};

bool IsBlind(const std::string& file, const std::string& strategy) {
  return std::any_of(std::begin(kBlind), std::end(kBlind), [&](const Blind& blind) {
    return file.find(blind.scene) != std::string::npos &&
           strategy.find(blind.choice) != std::string::npos;
  });
}

// Scenes whose samples take long have fewer of them.
std::vector<BiasRound> RoundsOf(const std::string& scene, std::vector<BiasRound> rounds) {
  constexpr std::uint64_t kFewer = 4;
  for (const char* slow : {"closed-room", "corridor", "hair", "instances", "many-lights",
                           "roughness-1e-4"}) {
    if (scene != slow) continue;
    for (BiasRound& round : rounds) round.spp /= kFewer;
  }
  return rounds;
}

// Light subpaths find caustics of lights without extent, which camera paths never do:
// these images are brighter (tests/kernels/light_paths/lights_test.cc).
void LeaveOutSplats(std::string& strategy) {
  const std::string splats = "light-paths=splats";
  const std::size_t at = strategy.find(splats);
  if (at == std::string::npos) return;
  const std::size_t end = std::min(strategy.find(',', at), strategy.size());
  strategy.replace(at, end - at, "light-paths=none");
}

std::vector<std::string> ChoicesOf(const std::string& strategy) {
  std::vector<std::string> choices;
  std::istringstream text(strategy);
  for (std::string one; std::getline(text, one, ',');) choices.push_back(one);
  return choices;
}

PreparedScene Prepare(const std::filesystem::path& file, BiasCoverage coverage) {
  SceneDescription description = ParseScene(file.string());
  const int side = coverage == BiasCoverage::kEveryChoice ? 64 : 48;
  description.film.width = description.film.height = side;
  std::fill_n(description.film.crop, 4, 0);
  return PrepareScene(description);
}

std::vector<std::string> EveryChoice() {
  std::vector<std::string> strategies;
  for (const Axis& axis : Axes()) {
    for (const std::string& value : axis.values) {
      strategies.push_back(axis.key + "=" + value);
    }
  }
  return strategies;
}

// What trial runs choose, and the combinations in turn.
std::vector<std::string> Rotating(const PreparedScene& scene, std::size_t index,
                                  std::size_t scenes) {
  constexpr std::size_t kMaxPerScene = 2;
  const std::size_t each =
      std::min(kMaxPerScene, (Combinations().size() + scenes - 1) / scenes);
  constexpr const char* kExtraStrategies[] = {
      "directions=mis:power,roulette=throughput:0:2:4", "roulette=adjoint",
      "reuse=block:64:compact", "directions=light"};
  std::vector<std::string> strategies = {
      "reuse=block", kExtraStrategies[index % std::size(kExtraStrategies)]};
  for (std::size_t k = 0; k < each; ++k) {
    const std::size_t row = (index * each + k) % Combinations().size();
    strategies.push_back(
        StrategyOf(Axes(), FitTo(scene, Combinations()[row], k % 2 == 0)));
  }
  return strategies;
}

// One scene, and the smallest bias of its image that some comparison would find.
struct SceneTest {
  SceneTest(const std::filesystem::path& path, BiasCoverage coverage,
            const std::vector<BiasRound>& rounds)
      : file(path.string()),
        test(Prepare(path, coverage), kBase, RoundsOf(path.stem().string(), rounds)) {}

  // Requires that the strategy is not biased, if the scene accepts it and shows a bias.
  void Check(std::string strategy, BiasPower& power) {
    if (test.scene().features().HasAny(LightsWith(kDeltaLight))) LeaveOutSplats(strategy);
    if (!Accepts(test.scene(), strategy) || IsBlind(file, strategy)) return;
    const BiasVerdict verdict = test.Compare(strategy);
    if (verdict.identical || !verdict.HasPower()) return;
    INFO(file << ", " << strategy << ": " << verdict.worst);
    CHECK_FALSE(verdict.biased);
    power.Add(strategy, verdict);
    detectable = std::min(detectable, verdict.image_power);
  }

  std::string file;
  BiasTest test;
  double detectable = std::numeric_limits<double>::infinity();
};

}  // namespace

void BiasPower::Add(const std::string& strategy, const BiasVerdict& verdict) {
  for (const std::string& choice : ChoicesOf(strategy)) {
    auto& [tile, image] = minimum_.try_emplace(choice, 1e9, 1e9).first->second;
    tile = std::min(tile, verdict.tile_power);
    image = std::min(image, verdict.image_power);
  }
}

bool BiasPower::Suffices(const std::pair<double, double>& minimum) const {
  return minimum.first < tile_ || minimum.second < image_;
}

std::vector<std::string> BiasPower::Insufficient() const {
  std::vector<std::string> choices;
  for (const auto& [choice, power] : minimum_) {
    if (!Suffices(power)) choices.push_back(choice);
  }
  return choices;
}

void BiasPower::Check() const {
  for (const auto& [choice, power] : minimum_) {
    INFO(choice << ": a bias of " << 100 * power.first << " % of a tile, or of "
                << 100 * power.second << " % of the image, would be found");
    CHECK(Suffices(power));
  }
}

void CheckSceneBias(const std::vector<std::filesystem::path>& files,
                    BiasCoverage coverage, const std::vector<BiasRound>& rounds,
                    BiasPower& power) {
  std::vector<SceneTest> scenes;
  for (std::size_t i = 0; i < files.size(); ++i) {
    SceneTest scene(files[i], coverage, rounds);
    const auto strategies = coverage == BiasCoverage::kEveryChoice
                                ? EveryChoice()
                                : Rotating(scene.test.scene(), i, files.size());
    for (const std::string& strategy : strategies) scene.Check(strategy, power);
    scenes.push_back(std::move(scene));
  }
  // Scenes with little noise need the fewest renders.
  std::sort(scenes.begin(), scenes.end(), [](const SceneTest& a, const SceneTest& b) {
    return a.detectable < b.detectable;
  });
  for (SceneTest& scene : scenes) {
    for (const std::string& choice : power.Insufficient()) scene.Check(choice, power);
  }
}

}  // namespace lanelight::test
