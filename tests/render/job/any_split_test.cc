// The same bits however a render is cut: over threads, parts, stops and resumptions, for
// strategies of every kind of film and training.
#include <catch2/catch.hpp>
#include <fstream>
#include <random>

#include "src/base/core/source_location.h"
#include "tests/render/job/checkpointed_render.h"

namespace lanelight {
namespace {

std::string Scene(const std::string& name) {
  return LANELIGHT_SOURCE_DIR "/scenes/" + name + ".pbrt";
}

CheckpointedRender RenderOf(const std::string& scene, const std::string& strategy,
                            int width = 48, int height = 40, std::uint64_t spp = 24) {
  CheckpointedRender r;
  r.scene = Scene(scene);
  r.settings.resolution = {width, height};
  r.settings.spp = spp;
  r.settings.strategy = ParseStrategy(strategy, {});
  return r;
}

std::vector<std::string> RenderParts(CheckpointedRender r, int count,
                                     const TemporaryFolder& folder) {
  std::vector<std::string> paths;
  for (int i = 1; i <= count; ++i) {
    r.threads = 1 + i % 3;
    r.checkpoint = {};
    r.checkpoint.path = folder.File("part-" + std::to_string(i));
    r.checkpoint.part = {i, count};
    RenderKept(r);
    paths.push_back(r.checkpoint.path);
  }
  return paths;
}

// Stops again and again, with another number of threads each time.
Outcome RenderInPieces(CheckpointedRender r, unsigned seed,
                       const TemporaryFolder& folder) {
  std::mt19937 random(seed);
  r.checkpoint = {};
  r.checkpoint.path = folder.File("pieces");
  r.checkpoint.resume = Resume::kIfAny;
  const std::uint64_t wanted = *r.settings.spp;
  for (int stop = 0; stop < 4; ++stop) {
    r.settings.spp = std::max<std::uint64_t>(1, wanted - 8 + 2 * std::uint64_t(stop));
    r.tasks = 1 + static_cast<int>(random() % 40);
    r.threads = 1 + stop % 3;
    RenderKept(r);
  }
  r.settings.spp = wanted;
  r.tasks = 0;
  return RenderKept(r);
}

void CheckCuts(const CheckpointedRender& whole, std::vector<int> counts) {
  const Outcome expected = RenderKept(whole);
  for (int threads : {1, 3}) {
    CheckpointedRender other = whole;
    other.threads = threads;
    INFO(threads << " threads");
    CHECK((RenderKept(other) == expected));
  }
  for (int count : counts) {
    TemporaryFolder folder;
    std::vector<std::string> paths = RenderParts(whole, count, folder);
    std::mt19937 random(static_cast<unsigned>(count));
    std::shuffle(paths.begin(), paths.end(), random);
    INFO(count << " parts");
    CHECK((MergedOutcome(paths) == expected));
  }
  TemporaryFolder folder;
  const Outcome pieces = RenderInPieces(whole, 7, folder);
  INFO("in pieces: " << pieces.report << " not " << expected.report);
  CHECK((pieces == expected));
}

}  // namespace

TEST_CASE("any split: bit-identical for every kind of film and training", "[cuts]") {
  for (const char* strategy :
       {"points=independent", "points=sobol", "pairs=antithetic",
        "points=independent,pairs=antithetic", "roulette=adjoint", "points=stratified",
        "points=halton", "decide=pilot", "reuse=block:16",
        "points=independent,reuse=block:64:compact", "light-paths=splats:3",
        "pixel-samples=shared"}) {
    INFO(strategy);
    CheckCuts(RenderOf("cornell-box", strategy), {1, 3, 7});
  }
}

TEST_CASE("any split: light subpaths that a trial run has chosen",
          "[cuts][light_paths]") {
  const CheckpointedRender r = RenderOf("caustic", "decide=pilot");
  CheckCuts(r, {3});
}

TEST_CASE("any split: wavelengths that tiles share", "[cuts]") {
  CheckpointedRender r = RenderOf("cornell-box", "reuse=block:16");
  r.settings.transport = TransportSetting::kSpectral;
  CheckCuts(r, {3, 7});
}

TEST_CASE("any split: fits within blocks of pixels", "[cuts]") {
  CheckpointedRender r = RenderOf("cornell-box", "control=regression", 100, 70);
  r.settings.crop = {5, 3, 90, 70};  // blocks that the window cuts
  CheckCuts(r, {3, 7});
}

TEST_CASE("any split: 64 parts, auxiliary planes", "[cuts]") {
  CheckpointedRender r = RenderOf("cornell-box", "");
  r.settings.gbuffer = Gbuffer::kCamera;
  CheckCuts(r, {64});
}

TEST_CASE("any split: buckets of wavelengths", "[cuts][buckets]") {
  TemporaryFolder folder;
  std::ifstream prism(Scene("prism"));
  std::string text{std::istreambuf_iterator<char>(prism), {}};
  const std::string film = "Film \"rgb\"";
  REQUIRE(text.find(film) != std::string::npos);
  text.replace(text.find(film), film.size(), "Film \"spectral\" \"integer nbuckets\" 5");
  CheckpointedRender r = RenderOf("prism", "");
  r.scene = folder.File("spectra.pbrt");
  std::ofstream(r.scene) << text;
  const Outcome whole = RenderKept(r);
  CHECK(std::count_if(whole.planes.begin(), whole.planes.end(),
                      [](const auto& plane) { return plane.starts_with("S0."); }) == 5);
  CheckCuts(r, {3, 7});
}

TEST_CASE("any split: the matrix of scenes and strategies", "[cuts][slow]") {
  for (const char* scene : {"cornell-box", "glass", "many-lights", "sun-sky"}) {
    for (const char* strategy : {"points=independent", "points=sobol", "pairs=antithetic",
                                 "control=regression", "roulette=adjoint"}) {
      INFO(scene << ", " << strategy);
      CheckCuts(RenderOf(scene, strategy, 160, 128), {1, 3, 7, 64});
    }
  }
}

TEST_CASE("any split: refining a target in steps equals one render", "[cuts]") {
  TemporaryFolder folder;
  CheckpointedRender r = RenderOf("cornell-box", "");
  r.settings.spp = 4096;
  r.settings.target_relmse = 0.02;
  const Outcome expected = RenderKept(r);
  r.checkpoint.path = folder.File("state");
  r.checkpoint.resume = Resume::kIfAny;
  for (double target : {0.2, 0.06}) {
    r.settings.target_relmse = target;
    CHECK_FALSE((RenderKept(r) == expected));
  }
  r.settings.target_relmse = 0.02;
  CHECK((RenderKept(r) == expected));
}

TEST_CASE("any split: planted, an extra sample or another seed is detected", "[cuts]") {
  CheckpointedRender r = RenderOf("cornell-box", "");
  const Outcome expected = RenderKept(r);
  r.settings.spp = 25;
  CHECK_FALSE((RenderKept(r) == expected));
  r.settings.spp = 24;
  r.settings.seed = 5;
  CHECK_FALSE((RenderKept(r) == expected));
}

}  // namespace lanelight
