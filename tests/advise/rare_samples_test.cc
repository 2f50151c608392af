// Renders of the whole image that show what rare bright samples carry.
#include "src/advise/rare_samples.h"

#include <catch2/catch.hpp>
#include <cmath>

namespace lanelight {
namespace {

Job SmallJob() {
  RenderSettings settings;
  settings.resolution = {32, 32};
  settings.spp = 1;
  return PrepareJob(LANELIGHT_SOURCE_DIR "/scenes/cornell-box.pbrt", settings);
}

WholeImage Renders(Job& job, const std::string& changes, int count) {
  Strategy strategy;
  ApplyStrategy(changes, {}, strategy);
  WholeImage sum;
  for (int i = 0; i < count; ++i) {
    REQUIRE(AddWholeImage(job, strategy, static_cast<std::uint64_t>(i), nullptr, sum));
  }
  return sum;
}

}  // namespace

TEST_CASE("the gain is the smaller one of all pixels and all but the worst", "[advise]") {
  CHECK(RareGain({8, 2, 3}, {2, 1, 1}) == Approx(6));
  CHECK(RareGain({8, 2, 3}, {1, 4, 1}) == Approx(1.5));
  CHECK(RareGain({1, 1, 1}, {0, 0, 1}) == 0);
  CHECK(RareGain({}, {}) == 0);
}

TEST_CASE("whole images tell bad strategies from good ones", "[advise]") {
  Job job = SmallJob();
  const WholeImage usual = Renders(job, "directions=mis", 4);
  CHECK(usual.trimmed > 0);
  CHECK(usual.trimmed <= usual.all);
  CHECK(usual.seconds > 0);
  // Finding the lamp by chance alone has many times the error; time is left out here.
  WholeImage chance = Renders(job, "directions=bsdf", 4);
  CHECK(chance.all > 4 * usual.all);
  chance.seconds = usual.seconds;
  CHECK(RareGain(chance, usual) > 4);
  CHECK(RareGain(usual, chance) < 0.25);
}

TEST_CASE("a single bright sample is not what it is divided by", "[advise]") {
  Job job = SmallJob();
  // With the pixel's own mean below the line, no pixel's share could exceed 4 samples'
  // (n - 1) / n; a lamp found once among four samples makes it larger against its
  // neighbours' median.
  const WholeImage chance = Renders(job, "directions=bsdf", 1);
  CHECK((chance.all - chance.trimmed) * 32 * 32 > 10);
}

TEST_CASE("an interrupted render of the whole image says so", "[advise]") {
  Job job = SmallJob();
  const std::atomic<bool> stop = true;
  WholeImage sum;
  CHECK_FALSE(AddWholeImage(job, {}, 1, &stop, sum));
  CHECK(sum.all == 0);
}

}  // namespace lanelight
