// Parts and sums of renders with allocation=error.
#include <catch2/catch.hpp>

#include "src/core/error.h"
#include "tests/render/kept_render.h"

namespace lanelight {
namespace {

KeptRender RenderOf(std::uint64_t seed, const TemporaryFolder& folder) {
  KeptRender r;
  r.scene = LANELIGHT_SOURCE_DIR "/scenes/cornell-box.pbrt";
  r.settings.resolution = {48, 40};
  r.settings.spp = 48;
  r.settings.seed = seed;
  r.settings.strategy = ParseStrategy("allocation=error", {});
  r.checkpoint.path = folder.File("seed-" + std::to_string(seed));
  return r;
}

std::string ErrorOf(const KeptRender& r) {
  try {
    RenderKept(r);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("allocation=error refuses parts, and says what would do", "[allocation]") {
  TemporaryFolder folder;
  KeptRender r = RenderOf(1, folder);
  r.checkpoint.part = {2, 3};
  CHECK_THAT(ErrorOf(r), Catch::Contains("--part 2/3") && Catch::Contains("ranks") &&
                             Catch::Contains("seeds") &&
                             Catch::Contains("allocation=uniform"));
}

TEST_CASE("allocation=error: a state is merged as it is", "[allocation]") {
  TemporaryFolder folder;
  const KeptRender r = RenderOf(1, folder);
  const Outcome whole = RenderKept(r);
  CHECK((MergedOutcome({r.checkpoint.path}) == whole));
  const MergedRender merged = MergeStates({r.checkpoint.path});
  CHECK((merged.least == 48 && merged.most == 48));
  CHECK_FALSE(ResultOf(merged).stopped_early);
}

TEST_CASE("allocation=error: renders of different seeds are added pixel by pixel",
          "[allocation]") {
  TemporaryFolder folder;
  const KeptRender one = RenderOf(1, folder), two = RenderOf(2, folder);
  RenderKept(one);
  RenderKept(two);
  const MergedRender a = MergeStates({one.checkpoint.path});
  const MergedRender b = MergeStates({two.checkpoint.path});
  const MergedRender sum = MergeStates({two.checkpoint.path, one.checkpoint.path});
  CHECK((sum.least == 96 && sum.most == 96));
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 48; ++x) {
      const double na = double(a.film->Samples(x, y)), nb = double(b.film->Samples(x, y));
      CHECK(double(sum.film->Samples(x, y)) == na + nb);
      const Rgb mean = (a.film->Mean(x, y) * na + b.film->Mean(x, y) * nb) / (na + nb);
      CHECK(sum.film->Mean(x, y).y == Approx(mean.y).epsilon(1e-12));
    }
  }
}

TEST_CASE("allocation=error: fewer samples than there are is an error", "[allocation]") {
  TemporaryFolder folder;
  KeptRender r = RenderOf(1, folder);
  RenderKept(r);
  r.checkpoint.resume = Resume::kMust;
  r.settings.spp = 30;
  CHECK_THAT(ErrorOf(r), Catch::Contains("more than"));
  r.settings.spp = 48;
  CHECK(ErrorOf(r) == "");
}

}  // namespace lanelight
