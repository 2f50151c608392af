// Films that are put down and picked up go on exactly where they were.
#include "src/wavefront/films.h"

#include <catch2/catch.hpp>
#include <random>

#include "src/core/error.h"

namespace lanelight {
namespace {

constexpr int kWidth = 6, kHeight = 5;
constexpr std::uint32_t kCount = 8;

struct Case {
  const char* name;
  FeatureSet features;
  std::uint32_t group_size;
};

// A film with all that belongs to it.
struct Gathering {
  FilmAccumulator film;
  Films films;
  std::vector<std::uint32_t> pixels;

  explicit Gathering(const Case& c, std::uint32_t group_size)
      : film(0, 0, kWidth, kHeight, group_size, c.features.Has(Feature::kAov)),
        films(SamplePlanes(c.features), 1, film) {
    for (std::uint32_t i = 0; i < kWidth * kHeight; ++i) pixels.push_back(i);
  }
  explicit Gathering(const Case& c) : Gathering(c, c.group_size) {}

  void Add(const Case& c, int round) {
    const SamplePlanes planes(c.features);
    std::mt19937 engine(static_cast<unsigned>(round));
    std::vector<float> values(pixels.size() * kCount *
                              static_cast<std::size_t>(planes.count()));
    for (float& v : values) v = std::generate_canonical<float, 24>(engine);
    films.Add({{0, 0, kWidth, kHeight}, pixels, kWidth, values.data(), kCount});
  }
  std::string State() const {
    StateWriter writer;
    films.Save(writer);
    return writer.bytes();
  }
};

const Case kCases[] = {
    {"plain", {}, 1},
    {"groups that are open when saved", {}, 5},
    {"auxiliary planes", {Feature::kAov}, 4},
    {"control variate", {Feature::kControlDifference}, 3},
    {"control variate and auxiliary planes",
     {Feature::kControlDifference, Feature::kAov},
     2},
    {"regression", {Feature::kRegressionControl}, 1},
};

}  // namespace

TEST_CASE("films: saved, restored and continued are as if nothing had happened",
          "[films]") {
  for (const Case& c : kCases) {
    INFO(c.name);
    Gathering whole(c), first(c), second(c);
    for (int round = 0; round < 6; ++round) whole.Add(c, round);
    for (int round = 0; round < 3; ++round) first.Add(c, round);
    const std::string state = first.State();
    StateReader reader(state);
    second.films.Restore(reader);
    CHECK(reader.done());
    CHECK(second.State() == state);
    for (int round = 3; round < 6; ++round) second.Add(c, round);
    CHECK(second.State() == whole.State());
    whole.film.FitControl();
    second.film.FitControl();
    for (int x = 0; x < kWidth; ++x) {
      CHECK(second.film.Mean(x, 2) == whole.film.Mean(x, 2));
      CHECK(second.film.Variance(x, 2) == whole.film.Variance(x, 2));
    }
  }
}

TEST_CASE("films: the state of another film is refused", "[films]") {
  const Gathering plain(kCases[0]), aov(kCases[2]);
  const std::string state = plain.State(), other = aov.State();
  Gathering groups(kCases[0], 2), control(kCases[3]), same(kCases[0]);
  const auto restore = [](Gathering& g, const std::string& bytes) {
    StateReader reader(bytes);
    g.films.Restore(reader);
  };
  CHECK_THROWS_AS(restore(groups, state), InputError);
  CHECK_THROWS_AS(restore(control, state), InputError);
  CHECK_THROWS_AS(restore(same, other), InputError);
  CHECK_NOTHROW(restore(same, state));
}

}  // namespace lanelight
