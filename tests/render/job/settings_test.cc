// Overrides of a scene and the limits of what is asked for.
#include "src/render/job/settings.h"
#include "src/scene/description/description.h"
#include "src/scene/description/film.h"

#include <catch2/catch.hpp>

#include "src/base/core/error.h"
#include "src/render/job/job.h"
#include "src/render/job/loaded_scene.h"
#include "src/render/job/memory.h"
#include "src/render/run/run.h"
#include "src/scene/parse/parse.h"

namespace lanelight {

using Catch::Contains;

TEST_CASE("a crop of the scene is scaled with the resolution", "[render]") {
  SceneDescription scene;
  scene.film.width = 100;
  scene.film.height = 50;
  const int crop[4] = {10, 60, 5, 25};  // x0 x1 y0 y1
  std::copy(crop, crop + 4, scene.film.crop);
  RenderSettings settings;
  settings.resolution = {200, 25};
  ApplySettings(settings, scene);
  const PixelRect w = RenderedPixels(scene.film);
  CHECK(w.x0 == 20);
  CHECK(w.x1 == 120);
  CHECK(w.y0 == 3);
  CHECK(w.y1 == 13);
  settings.crop = {1, 2, 3, 4};
  ApplySettings(settings, scene);
  CHECK(RenderedPixels(scene.film).x1 == 3);
  CHECK(RenderedPixels(scene.film).pixels() == 4);
}

TEST_CASE("without a crop the window is the whole image", "[render]") {
  SceneDescription scene;
  ApplySettings({}, scene);
  CHECK(RenderedPixels(scene.film).width() == scene.film.width);
  CHECK(RenderedPixels(scene.film).height() == scene.film.height);
}

TEST_CASE("settings out of range are refused", "[render]") {
  const auto refused = [](auto&& change, const char* message) {
    RenderSettings settings;
    SceneDescription scene;
    change(settings, scene);
    CHECK_THROWS_WITH(ApplySettings(settings, scene), Contains(message));
  };
  refused([](auto& s, auto&) { s.spp = 0; }, "samples per pixel");
  refused([](auto& s, auto&) { s.spp = kMaxSamplesPerPixel + 1; }, "1099511627777");
  refused([](auto& s, auto&) { s.spp = ~std::uint64_t{0}; }, "samples per pixel");
  refused([](auto&, auto& d) { d.sampler.spp = -1; }, "-1 samples per pixel");
  refused([](auto& s, auto&) { s.seconds = 0; }, "time budget");
  refused([](auto& s, auto&) { s.resolution = {0, 10}; }, "resolution 0x10");
  refused([](auto& s, auto&) { s.resolution = {10, 70000}; }, "resolution 10x70000");
  refused([](auto&, auto& d) { d.film.width = -3; }, "resolution -3x");
  refused([](auto& s, auto&) { s.crop = {0, 0, 0, 0}; }, "crop window");
  refused([](auto& s, auto&) { s.crop = {0, 0, 5000, 10}; }, "leaves the image");
  refused([](auto& s, auto&) { s.crop = {-1, 0, 5, 10}; }, "crop window");
  refused([](auto& s, auto&) { s.max_depth = -1; }, "maximum depth");
  refused([](auto& s, auto&) { s.wavefront = kMaxWavefront + 1; }, "wavefront");
}

TEST_CASE("a film beyond the memory is refused with both numbers", "[render]") {
  const PixelRect window = {0, 0, 1 << 15, 1 << 15};
  CHECK(FilmBytes(window, Auxiliary::kAov) > FilmBytes(window, Auxiliary::kNone));
  CHECK(FilmBytes(window, Auxiliary::kNone) > window.pixels() * 100);
  Strategy control;
  control.control = Control::kRegression;
  CHECK(FilmBytes(window, Auxiliary::kNone, control) >
        FilmBytes(window, Auxiliary::kNone) + window.pixels() * 300);
  const std::uint64_t gib = std::uint64_t{1} << 30;
  CHECK_NOTHROW(CheckFilmFits(window, Auxiliary::kNone, {}, 1000 * gib));
  CHECK_THROWS_WITH(CheckFilmFits(window, Auxiliary::kNone, {}, 16 * gib),
                    Contains("32768x32768") && Contains("16.0 GiB"));
  CHECK(PhysicalMemory() > gib / 4);
}

namespace {

// decide= of a render of 256 x 256 pixels.
Decide DecisionOf(RenderSettings settings, const std::string& own = "") {
  SceneDescription scene;
  scene.integrator.strategy = own;
  if (!settings.resolution) settings.resolution = {256, 256};
  settings.decision = DefaultDecision::kIfLong;
  ApplySettings(settings, scene);
  return scene.strategy.decide;
}

RenderSettings Samples(std::uint64_t spp) {
  RenderSettings settings;
  settings.spp = spp;
  return settings;
}

}  // namespace

TEST_CASE("long renders choose a strategy by a trial run, unless one is given",
          "[render]") {
  CHECK(DecisionOf(Samples(127)) == Decide::kNone);
  CHECK(DecisionOf(Samples(128)) == Decide::kPilot);
  RenderSettings small = Samples(1u << 12);
  small.resolution = {32, 32};
  CHECK(DecisionOf(small) == Decide::kNone);
  // Beyond the size at which the trial stops growing, fewer samples of each pixel
  // suffice.
  RenderSettings large = Samples(17);
  large.resolution = {1920, 1080};
  CHECK(DecisionOf(large) == Decide::kPilot);
  large.spp = 16;
  CHECK(DecisionOf(large) == Decide::kNone);
  RenderSettings timed;
  timed.seconds = 3.9;
  CHECK(DecisionOf(timed) == Decide::kNone);
  timed.seconds = 4;
  CHECK(DecisionOf(timed) == Decide::kPilot);
  RenderSettings towards;
  towards.target_relmse = 0.01;
  CHECK(DecisionOf(towards) == Decide::kNone);
  towards.resolution = {1280, 720};
  CHECK(DecisionOf(towards) == Decide::kPilot);
  // Any word about the strategy.
  RenderSettings explicit_settings = Samples(1024);
  explicit_settings.strategy = ParseStrategy("points=halton", {});
  CHECK(DecisionOf(explicit_settings) == Decide::kNone);
  explicit_settings.strategy = ParseStrategy("points=halton,decide=pilot", {});
  CHECK(DecisionOf(explicit_settings) == Decide::kPilot);
  CHECK(DecisionOf(Samples(1024), "roulette=none") == Decide::kNone);
}

TEST_CASE("integrators that start at lights select light subpaths where these work",
          "[render][light_paths]") {
  const std::string lamp = R"(
    AreaLightSource "diffuse" Shape "sphere" "float radius" 0.1
    AttributeBegin Translate 0 0 2 Shape "disk" AttributeEnd)";
  const std::string skin = R"(
    Translate 0 0 9 Material "subsurface" Shape "sphere")";
  const auto job_of = [](const std::string& integrator, const std::string& world,
                         const std::string& strategy) {
    RenderSettings settings;
    settings.resolution = {4, 4};
    settings.strategy = ParseStrategy(strategy, {});
    return PrepareJob(
        ParseSceneText("Integrator \"" + integrator + "\" WorldBegin " + world, "s.pbrt",
                       "."),
        settings);
  };
  const auto splats = [](const Job& job) {
    return job.plan.features.Has(Feature::kLightPaths) &&
           job.scene.strategy.light_paths == LightPaths::kSplats;
  };
  CHECK(splats(job_of("bdpt", lamp, "")));
  CHECK(splats(job_of("lightpath", lamp, "")));
  CHECK_FALSE(splats(job_of("path", lamp, "")));
  CHECK_FALSE(splats(job_of("bdpt", lamp, "points=halton")));
  const Job refused = job_of("bdpt", lamp + skin, "");
  CHECK_FALSE(splats(refused));
  CHECK(refused.scene.strategy.light_paths == LightPaths::kNone);
  CHECK_THAT(refused.loaded->description.notes.back().message,
             Contains("no path starts at a light: light subpaths do not support") &&
                 Contains("materials with an inside") && !Contains("error") &&
                 !Contains("use "));
}

TEST_CASE("the strategy is decided only where allowed or resumed", "[render]") {
  for (const auto& [decision, decide] :
       {std::pair{DefaultDecision::kNever, Decide::kNone},
        {DefaultDecision::kAlways, Decide::kPilot}}) {
    for (std::uint64_t spp : {1, 1024}) {
      RenderSettings settings = Samples(spp);
      settings.decision = decision;
      SceneDescription scene;
      ApplySettings(settings, scene);
      CHECK(scene.strategy.decide == decide);
    }
  }
}

}  // namespace lanelight
