// Unless --transport decides, what paths carry depends on what has a spectrum, and on
// what refuses wavelengths.
#include <algorithm>
#include <catch2/catch.hpp>
#include <optional>

#include "src/render/job/job.h"
#include "src/render/job/loaded_scene.h"
#include "src/render/job/transport.h"
#include "src/scene/compiled/scene.h"
#include "src/scene/parse/parse.h"

namespace lanelight {
namespace {

const std::string kLamp = "LightSource \"point\" \"rgb I\" [ 1 2 3 ]\n";
const std::string kWarmLamp = "LightSource \"point\" \"blackbody I\" 3000\n";
const std::string kCopper = "Material \"conductor\"\nShape \"sphere\"\n";
const std::string kGlass =
    "Material \"dielectric\" \"spectrum eta\" \"glass-BK7\"\nShape \"sphere\"\n";
const std::string kRed =
    "Material \"diffuse\" \"rgb reflectance\" [ 0.8 0.1 0.1 ]\nShape \"disk\"\n";

SceneDescription SceneOf(const std::string& world) {
  return ParseSceneText(
      "Camera \"perspective\"\nFilm \"rgb\" \"integer xresolution\" 8 "
      "\"integer yresolution\" 8\nWorldBegin\n" +
          world,
      "test.pbrt", ".");
}

TransportChoice ChoiceFor(const std::string& world, const std::string& strategy = "") {
  Strategy requested;
  ApplyStrategy(strategy, {}, requested);
  return ChooseTransport(SceneOf(world), {&requested, 1});
}

Job JobOf(const std::string& world, std::optional<TransportSetting> requested) {
  RenderSettings settings;
  settings.transport = requested;
  return PrepareJob(SceneOf(world), settings);
}

bool Notes(const Job& job, const std::string& text) {
  return std::any_of(
      job.loaded->description.notes.begin(), job.loaded->description.notes.end(),
      [&](const Note& note) { return note.message.find(text) != std::string::npos; });
}

}  // namespace

TEST_CASE("transport: spectral where a scene has spectra", "[render][spectral]") {
  CHECK(ChoiceFor(kLamp + kRed).transport == Transport::kRgb);
  for (const std::string& with :
       {kLamp + kCopper, kLamp + kGlass, kWarmLamp + kRed,
        kLamp + "Material \"diffuse\" \"spectrum reflectance\" [ 400 0.1 700 0.9 ]\n"
                "Shape \"sphere\"\n",
        kLamp + "AreaLightSource \"diffuse\" \"spectrum L\" \"stdillum-A\"\n" + kRed}) {
    INFO(with);
    const TransportChoice choice = ChoiceFor(with);
    CHECK(choice.transport == Transport::kSpectral);
    CHECK_FALSE(choice.refused);
    CHECK_THAT(choice.why, Catch::Contains(" has a spectrum") ||
                               Catch::Contains("the glass disperses"));
  }
  const std::string fire =
      "MakeNamedMedium \"fire\" \"string type\" \"uniformgrid\" \"float density\" [ 1 ] "
      "\"float temperature\" [ 1500 ]\n";
  const std::string bound =
      "MediumInterface \"fire\" \"\"\nMaterial \"interface\"\nShape \"sphere\"\n";
  const TransportChoice glows = ChoiceFor(fire + bound + kLamp + kRed);
  CHECK(glows.transport == Transport::kSpectral);
  CHECK_THAT(glows.why,
             Catch::Contains("the light of the medium \"fire\" has a spectrum"));
  CHECK(ChoiceFor(fire + kLamp + kRed).transport == Transport::kRgb);
  // Materials that no shape has do not count.
  const std::string unused =
      "MakeNamedMaterial \"m\" \"string type\" \"conductor\"\n" + kLamp + kRed;
  CHECK(ChoiceFor(unused).transport == Transport::kRgb);
}

TEST_CASE("transport: RGB with a reason where spectral is not supported",
          "[render][spectral]") {
  const auto refused = [](const std::string& world, const std::string& strategy) {
    const TransportChoice choice = ChoiceFor(world, strategy);
    CHECK(choice.transport == Transport::kRgb);
    CHECK(choice.refused);
    return choice.why;
  };
  CHECK_THAT(refused(kLamp + kGlass + kRed, "reuse=block"),
             Catch::Contains("glass disperses"));
  CHECK(ChoiceFor(kLamp + kCopper + kRed, "reuse=block").transport ==
        Transport::kSpectral);
  CHECK_THAT(
      refused("LightSource \"point\" \"spectrum I\" [ 790 1 820 1 ]\n" + kCopper, ""),
      Catch::Contains("a light emits nothing"));
}

TEST_CASE("transport: a job uses the requested transport", "[render][spectral]") {
  const std::string scene = kLamp + kCopper;
  const Job rgb = JobOf(scene, TransportSetting::kRgb);
  CHECK(rgb.scene.compiled->integrator.transport == Transport::kRgb);
  CHECK(rgb.loaded->transport_why.empty());
  CHECK_FALSE(rgb.plan.features.Has(Feature::kSpectral));
  // The scene decides by default.
  for (const auto requested :
       {std::optional<TransportSetting>(), std::optional(TransportSetting::kByScene)}) {
    const Job chosen = JobOf(scene, requested);
    CHECK(chosen.plan.features.Has(Feature::kSpectral));
    CHECK(chosen.loaded->transport_why.find("the metal has a spectrum") !=
          std::string::npos);
    CHECK_FALSE(JobOf(kLamp + kRed, requested).plan.features.Has(Feature::kSpectral));
  }
  // A scene that says so itself is asked no more.
  SceneDescription says = SceneOf(scene);
  says.integrator.transport = Transport::kRgb;
  CHECK_FALSE(PrepareJob(says, {}).plan.features.Has(Feature::kSpectral));
  CHECK(JobOf(scene, TransportSetting::kSpectral).plan.features.Has(Feature::kSpectral));
  const Job dark =
      JobOf("LightSource \"point\" \"spectrum I\" [ 790 1 820 1 ]\n" + kCopper,
            TransportSetting::kByScene);
  CHECK_FALSE(dark.plan.features.Has(Feature::kSpectral));
  CHECK(Notes(dark, "rendered in red, green and blue, since"));
}

TEST_CASE("transport: compared renders use the same transport", "[render][spectral]") {
  RenderSettings settings;
  settings.transport = TransportSetting::kByScene;
  Strategy& block = settings.compared.emplace_back();
  ApplyStrategy("reuse=block", {}, block);
  const Job job = PrepareJob(SceneOf(kLamp + kGlass), settings);
  CHECK_FALSE(job.plan.features.Has(Feature::kSpectral));
}

}  // namespace lanelight
