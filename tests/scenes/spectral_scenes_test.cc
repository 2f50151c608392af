// Every scene of our own with paths that carry wavelengths, whatever it would decide.
#include <catch2/catch.hpp>
#include <filesystem>

#include "src/scene/parse/parse.h"
#include "tests/render/run/render_fixture.h"

namespace lanelight::test {

TEST_CASE("own scenes: all samples are valid in spectral mode", "[scenes][spectral]") {
  namespace fs = std::filesystem;
  int scenes = 0;
  for (const auto& entry :
       fs::directory_iterator(fs::path(LANELIGHT_SOURCE_DIR) / "scenes")) {
    if (entry.path().extension() != ".pbrt") continue;
    INFO(entry.path());
    SceneDescription scene = ParseScene(entry.path().string());
    scene.film.width = 40, scene.film.height = 30;
    scene.integrator.transport = Transport::kSpectral;
    TestRender options;
    options.spp = 8;
    const Rendered render = RenderDescription(scene, options);
    CHECK(render.result.health.Total() == 0);
    // Far off is what is wrong by a unit or an overflow.
    const Rgb mean = ImageMean(render.film);
    for (int c = 0; c < 3; ++c) CHECK((mean[c] > 0 && mean[c] < 20));
    ++scenes;
  }
  CHECK(scenes >= 28);
}

}  // namespace lanelight::test
