// What is put together and what is not: parts of other renders, twice the same pixels,
// missing ones, different seeds.
#include <catch2/catch.hpp>
#include <set>

#include "src/base/core/input_file.h"
#include "src/base/core/source_location.h"
#include "src/render/job/machine_json.h"
#include "src/render/job/parts.h"
#include "tests/render/job/checkpointed_render.h"
#include "tests/support/input_error.h"

namespace lanelight {
namespace {

using Catch::Contains;

CheckpointedRender Small(const TemporaryFolder& folder, const std::string& name) {
  CheckpointedRender r;
  r.scene = LANELIGHT_SOURCE_DIR "/scenes/cornell-box.pbrt";
  r.settings.resolution = {32, 24};
  r.settings.spp = 8;
  r.checkpoint.path = folder.File(name);
  return r;
}

std::string StateOf(CheckpointedRender r) {
  RenderKept(r);
  return r.checkpoint.path;
}

std::string PartOf(CheckpointedRender r, int index, int count) {
  r.checkpoint.part = {index, count};
  r.checkpoint.path += "-" + std::to_string(index);
  return StateOf(r);
}

double Sum(const FilmAccumulator& film) {
  double sum = 0;
  for (int y = 0; y < film.height(); ++y) {
    for (int x = 0; x < film.width(); ++x) sum += film.Mean(x, y).y;
  }
  return sum;
}

}  // namespace

TEST_CASE("parts: every pixel is in exactly one", "[merge]") {
  for (const PixelRect window :
       {PixelRect{0, 0, 100, 70}, PixelRect{13, 5, 90, 66}, PixelRect{0, 0, 9, 1}}) {
    for (int count : {1, 2, 3, 7, 8}) {
      std::set<std::pair<int, int>> seen;
      std::uint64_t minimum = ~std::uint64_t{0}, maximum = 0;
      for (int i = 1; i <= count; ++i) {
        std::uint64_t pixels = 0;
        for (const PixelRect& t : TilesOfPart(window, {i, count})) {
          pixels += t.pixels();
          for (int y = t.y0; y < t.y1; ++y) {
            for (int x = t.x0; x < t.x1; ++x) REQUIRE(seen.insert({x, y}).second);
          }
        }
        minimum = std::min(minimum, pixels);
        maximum = std::max(maximum, pixels);
      }
      CHECK(seen.size() == window.pixels());
      INFO(window.pixels() << " pixels, " << count << " parts: " << minimum << " to "
                           << maximum);
      CHECK(maximum - minimum <= 2 + window.pixels() / std::uint64_t(count) / 8);
    }
  }
  CHECK_THAT(InputErrorOf([] { TilesOfPart({0, 0, 3, 3}, {1, 10}); }),
             Contains("at most 9 parts"));
}

TEST_CASE("merge: parts of other renders are refused with their names", "[merge]") {
  TemporaryFolder folder;
  const CheckpointedRender r = Small(folder, "a");
  const std::string first = PartOf(r, 1, 2);
  CheckpointedRender seed = Small(folder, "b"), depth = Small(folder, "c"), scene = seed;
  depth.settings.max_depth = 2;
  CHECK_THAT(InputErrorOf([&] { MergeStates({first, PartOf(depth, 2, 2)}); }),
             Contains("max_depth") && Contains("c-2"));
  scene.checkpoint.path = folder.File("d");
  scene.scene = LANELIGHT_SOURCE_DIR "/scenes/glass.pbrt";
  CHECK_THAT(InputErrorOf([&] { MergeStates({first, PartOf(scene, 2, 2)}); }),
             Contains("scene_hash"));
  seed.settings.seed = 9;
  CHECK_THAT(InputErrorOf([&] { MergeStates({first, PartOf(seed, 2, 2)}); }),
             Contains("lacks") && Contains("seed"));
  CHECK_THAT(InputErrorOf([&] { MergeStates({first, first}); }),
             Contains("both have pixel"));
  CheckpointedRender three = Small(folder, "e");
  CHECK_THAT(InputErrorOf([&] { MergeStates({first, PartOf(three, 3, 3)}); }),
             Contains("both have pixel") && Contains("a-1") && Contains("e-3"));
}

TEST_CASE("merge: missing parts are counted, and the others are correct", "[merge]") {
  TemporaryFolder folder;
  const CheckpointedRender r = Small(folder, "a");
  const std::string one = PartOf(r, 1, 3), three = PartOf(r, 3, 3);
  MergedRender merged = MergeStates({one, three});
  const std::size_t missing = TilesOfPart({0, 0, 32, 24}, {2, 3}).size();
  CHECK(merged.missing > 0);
  std::uint64_t there = 0;
  for (const PixelRect& t : merged.tiles) there += t.pixels();
  CHECK(merged.missing == 32 * 24 - there);
  CHECK(missing > 0);
  CHECK(ResultOf(merged).stopped_early);
  CheckpointedRender whole = r;
  whole.checkpoint.path = folder.File("whole");
  const std::string state = StateOf(whole);
  const MergedRender all = MergeStates({state});
  for (const PixelRect& t : merged.tiles) {
    CHECK(merged.film->Mean(t.x0, t.y0) == all.film->Mean(t.x0, t.y0));
  }
}

TEST_CASE("merge: merges of merges, and resuming from one", "[merge]") {
  TemporaryFolder folder;
  CheckpointedRender r = Small(folder, "a");
  std::vector<std::string> parts;
  for (int i = 1; i <= 4; ++i) parts.push_back(PartOf(r, i, 4));
  MergedRender left = MergeStates({parts[2], parts[0]});
  MergedRender right = MergeStates({parts[1], parts[3]});
  const std::string l = folder.File("left"), w = folder.File("right"),
                    all = folder.File("all");
  WriteMergedState(left, l);
  WriteMergedState(right, w);
  MergedRender both = MergeStates({w, l});
  WriteMergedState(both, all);
  CheckpointedRender plain = r;
  plain.checkpoint = {};
  CHECK((MergedOutcome({all}) == RenderKept(plain)));
  // On to more samples than the parts were asked for.
  plain.settings.spp = 20;
  r.settings.spp = 20;
  r.checkpoint.path = folder.File("more");
  r.checkpoint.from = all;
  r.checkpoint.resume = Resume::kMust;
  CHECK((RenderKept(r) == RenderKept(plain)));
  // Half of it is no render to go on with.
  r.checkpoint.from = l;
  CHECK_THAT(InputErrorOf([&] { RenderKept(r); }), Contains("384 of 768 pixels"));
}

TEST_CASE("merge: the machines of all parts are named", "[merge]") {
  TemporaryFolder folder;
  const CheckpointedRender r = Small(folder, "a");
  const auto part_of = [&](int index, const char* processor) {
    const std::string path = PartOf(r, index, 3);
    MergedRender part = MergeStates({path});
    REQUIRE(part.machines.size() == 1);
    CHECK(part.head.at("machine") == ToJson(ThisMachine()));
    part.machines[0].processor = processor;  // as if it had been rendered there
    WriteMergedState(part, path);
    return path;
  };
  const std::string a = part_of(1, "A"), b = part_of(2, "B"), c = part_of(3, "A");
  MergedRender alike = MergeStates({a, c});
  REQUIRE(alike.machines.size() == 1);
  CHECK(alike.head.at("machine").at("processor") == "A");
  MergedRender two = MergeStates({a, b});
  CHECK(two.head.at("machine").is_null());
  const std::string merged = folder.File("merged");
  WriteMergedState(two, merged);
  const MergedRender all = MergeStates({c, merged});
  REQUIRE(all.machines.size() == 2);
  CHECK(all.machines[0].processor == "A");
  CHECK(all.machines[1].processor == "B");
}

TEST_CASE("merge: renders of different seeds are added in their order", "[merge]") {
  TemporaryFolder folder;
  std::vector<std::string> states;
  double mean = 0;
  for (std::uint64_t seed : {3u, 1u, 2u}) {
    CheckpointedRender r = Small(folder, "seed-" + std::to_string(seed));
    r.settings.seed = seed;
    r.settings.spp = 16;
    states.push_back(StateOf(r));
    mean += Sum(*MergeStates({states.back()}).film) / 3;
  }
  const MergedRender merged = MergeStates(states);
  CHECK(merged.seeds == std::vector<std::uint64_t>{1, 2, 3});
  CHECK(merged.film->Samples(3, 3) == 48);
  CHECK(Sum(*merged.film) == Approx(mean).epsilon(1e-12));
  std::reverse(states.begin(), states.end());
  CHECK((MergedOutcome(states) == OutcomeOf(*merged.film, ResultOf(merged))));
  // Three times the samples: a third of the variance.
  const double one = EstimateError(*MergeStates({states[0]}).film).rmse.value;
  CHECK(EstimateError(*merged.film).rmse.value ==
        Approx(one / std::sqrt(3)).epsilon(0.15));
  MergedRender copy = MergeStates(states);
  CHECK_THAT(InputErrorOf([&] { WriteMergedState(copy, folder.File("no")); }),
             Contains("several seeds"));
  CheckpointedRender odd = Small(folder, "odd");
  odd.settings.spp = 6;
  odd.settings.seed = 8;
  CHECK_THAT(InputErrorOf([&] { MergeStates({states[0], StateOf(odd)}); }),
             Contains("multiple of 4"));
}

TEST_CASE("merge: light subpaths of different seeds are added", "[merge][light_paths]") {
  TemporaryFolder folder;
  std::vector<std::string> states;
  double mean = 0;
  for (std::uint64_t seed : {2u, 1u}) {
    CheckpointedRender r = Small(folder, "seed-" + std::to_string(seed));
    r.settings.seed = seed;
    r.settings.strategy.text = "light-paths=splats:3";
    states.push_back(StateOf(r));
    const MergedRender one = MergeStates({states.back()});
    REQUIRE(one.film->splats() != nullptr);
    CHECK(one.film->splats()->Mean(20 * 32 + 16).x > 0);
    mean += Sum(*one.film) / 2;
  }
  const MergedRender merged = MergeStates(states);
  CHECK(Sum(*merged.film) == Approx(mean).epsilon(1e-9));
  std::reverse(states.begin(), states.end());
  CHECK((MergedOutcome(states) == OutcomeOf(*merged.film, ResultOf(merged))));
}

TEST_CASE("checkpoints of other renders are refused", "[merge]") {
  TemporaryFolder folder;
  CheckpointedRender r = Small(folder, "a");
  StateOf(r);
  CHECK_THAT(InputErrorOf([&] { RenderKept(r); }),
             Contains("exists") && Contains("--resume"));
  r.checkpoint.resume = Resume::kMust;
  const auto refused = [&](const CheckpointedRender& other, const char* what) {
    CHECK_THAT(InputErrorOf([&] { RenderKept(other); }), Contains(what));
  };
  CheckpointedRender seed = r, size = r, strategy = r, fewer = r, aov = r, gbuffer = r,
                     part = r;
  seed.settings.seed = 2;
  refused(seed, "seed: the state has 0, this render 2");
  size.settings.resolution = {16, 24};
  refused(size, "resolution");
  strategy.settings.strategy = ParseStrategy("points=halton", {});
  refused(strategy, "strategy");
  aov.settings.aov = true;
  refused(aov, "aov");
  gbuffer.settings.gbuffer = Gbuffer::kWorld;
  refused(gbuffer, "gbuffer");
  fewer.settings.spp = 4;
  refused(fewer, "more than the 4 asked for");
  part.checkpoint.part = {1, 2};
  refused(part, "another part");
  CheckpointedRender missing = r;
  missing.checkpoint.path = folder.File("nothing");
  refused(missing, "nothing");
  const std::string text = ReadWholeFile(r.checkpoint.path);
  folder.Write("a", text.substr(0, text.size() / 2));
  refused(r, "truncated");
}

}  // namespace lanelight
