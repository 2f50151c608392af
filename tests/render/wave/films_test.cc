// Restored films continue exactly where they stopped.
#include "src/render/wave/films.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>
#include <random>
#include <set>

#include "tests/render/wave/column_copies.h"

namespace lanelight {
namespace {

constexpr int kWidth = 6, kHeight = 5;

struct FilmCase {
  const char* name;
  FeatureSet features;
  SampleGroups groups;
  std::size_t columns;
};

// A film with all that belongs to it.
Auxiliary AuxiliaryOf(const FeatureSet& features) {
  if (features.Has(Feature::kGbuffer)) return Auxiliary::kGbuffer;
  return features.Has(Feature::kAov) ? Auxiliary::kAov : Auxiliary::kNone;
}

struct Gathering {
  const FilmCase& of;
  FilmAccumulator film;
  Films films;
  std::vector<std::uint32_t> pixels;

  explicit Gathering(const FilmCase& c)
      : of(c),
        film(0, 0, kWidth, kHeight, c.groups, AuxiliaryOf(c.features)),
        films(SamplePlanes(c.features), 1, film),
        pixels(kWidth * kHeight) {
    std::iota(pixels.begin(), pixels.end(), 0u);
  }

  // An odd number of samples, so that units stay open.
  void Add(int round) {
    const auto count = static_cast<std::uint32_t>(7 + 2 * round);
    std::mt19937 engine(static_cast<unsigned>(round));
    std::vector<float> values(
        pixels.size() * count *
        static_cast<std::size_t>(SamplePlanes(of.features).count()));
    for (float& v : values) v = std::generate_canonical<float, 24>(engine);
    films.Add({{0, 0, kWidth, kHeight}, pixels, kWidth, values.data(), count});
  }
  std::vector<ColumnCopy> State() { return CopyColumns(films); }
};

const FilmCase kCases[] = {
    {"plain", {}, {1, false}, 2},
    {"pairs, one of them open", {}, {2, false}, 3},
    {"replicates", {}, {1, true}, 2},
    {"replicates of pairs and auxiliary planes", {Feature::kAov}, {2, true}, 3},
    {"g-buffer", {Feature::kAov, Feature::kGbuffer}, {1, false}, 4},
    {"regression", {Feature::kRegressionControl}, {1, false}, 5},
    {"regression and auxiliary planes",
     {Feature::kRegressionControl, Feature::kAov},
     {1, false},
     6},
    {"regression, replicates of pairs", {Feature::kRegressionControl}, {2, true}, 5},
};

// Rounds 0 to 2 and what is left of them, then 3 to 5.
std::vector<ColumnCopy> Continued(const FilmCase& c,
                                  const std::vector<ColumnCopy>& state) {
  Gathering second(c);
  PutColumns(state, second.films);
  CHECK(second.State() == state);
  for (int round = 3; round < 6; ++round) second.Add(round);
  return second.State();
}

}  // namespace

TEST_CASE("films: a resumed film is bit-identical", "[films]") {
  for (const FilmCase& c : kCases) {
    INFO(c.name);
    Gathering whole(c), first(c), second(c);
    for (int round = 0; round < 6; ++round) whole.Add(round);
    for (int round = 0; round < 3; ++round) first.Add(round);
    // Fits in between leave no trace.
    first.film.FitControl();
    CHECK(Continued(c, first.State()) == whole.State());
    PutColumns(whole.State(), second.films);
    whole.film.FitControl();
    second.film.FitControl();
    for (int x = 0; x < kWidth; ++x) {
      CHECK(second.film.Mean(x, 2) == whole.film.Mean(x, 2));
      CHECK(second.film.Variance(x, 2) == whole.film.Variance(x, 2));
      CHECK(whole.film.Variance(x, 2).x > 0);
    }
  }
}

TEST_CASE("films: each column is required, and errors name it", "[films]") {
  for (const FilmCase& c : kCases) {
    Gathering whole(c), first(c);
    for (int round = 0; round < 6; ++round) whole.Add(round);
    for (int round = 0; round < 3; ++round) first.Add(round);
    const std::vector<ColumnCopy> state = first.State();
    CHECK(state.size() == c.columns);
    std::set<std::string> names;
    for (std::size_t i = 0; i < state.size(); ++i) {
      INFO(c.name << ", " << state[i].name);
      CHECK(names.insert(state[i].name).second);
      CHECK_FALSE(first.films.Columns()[i].meaning.empty());
      std::vector<ColumnCopy> damaged = state;
      std::fill(damaged[i].bytes.begin(), damaged[i].bytes.end(), 0);
      // Without groups of samples, no group is open.
      if (c.groups.unit == 1 && state[i].name == "control_open") continue;
      CHECK(Continued(c, damaged) != whole.State());
    }
  }
}

}  // namespace lanelight
