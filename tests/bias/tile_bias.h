// Tests whether two strategies have the same mean in every tile of 8 x 8 pixels, from
// renders of several seeds. This is valid however pixels and samples depend on each
// other.
//
// A tile's statistic is the mean of (test - base) / (value + 0.1 image mean) over its
// pixels. So a lamp in the tile does not hide an error beside it. Both strategies render
// the same seeds, so that noise they have in common cancels: Student's t on differences.
//
// Rounds keep this affordable. The first tests all tiles; the next ones, with fresh seeds
// and four times the samples each, test only what the one before found. A bias is
// reported when all rounds find it with the same sign.
//
// Source: Subr and Arvo 2007; Jung, Hanika and Dachsbacher 2020 (statistical tests of
// renderers).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/bias/seed_images.h"

namespace lanelight::test {

/// Pixels per side of a tile.
inline constexpr int kBiasTile = 8;

/// One round of a comparison.
struct BiasRound {
  int seeds = 16;
  std::uint64_t spp = 8;  // per seed
  double level = 1e-3;    // false-alarm probability of each test
};

/// Rounds of the tests that run by default, and of those at length.
std::vector<BiasRound> ScreeningRounds();
std::vector<BiasRound> LongRounds();

/// The result of a comparison.
struct BiasVerdict {
  bool biased = false;
  bool identical = false;  // the strategy changes no bit of this scene
  int tests = 0;           // of the first round
  int rounds = 0;          // that were rendered
  /// Relative bias that the first round finds with probability 0.95: in the median tile,
  /// and in the mean of the image.
  double tile_power = 0, image_power = 0;
  std::string worst;  // where the last round differs most, and by how much

  /// Returns whether the first round has any power. If not, rare bright samples carry the
  /// light, most renders miss them, and more samples would accuse the one that misses
  /// more.
  bool HasPower() const { return image_power < 0.03 && tile_power < 0.2; }
};

/// Compares strategies with a base strategy on one scene.
class BiasTest {
 public:
  /// `base` is rendered once per round; `tile`: pixels per side of a tile.
  BiasTest(PreparedScene scene, std::string base, std::vector<BiasRound> rounds,
           int tile = kBiasTile);

  BiasVerdict Compare(const std::string& strategy);
  /// Compares with what `render` returns for the seeds, for planted errors.
  template <class Render>
  BiasVerdict CompareImages(Render&& render);

  const PreparedScene& scene() const { return scene_; }

 private:
  struct Finding {
    std::size_t test;  // index into the list of tests
    bool brighter;
  };
  SeedRange SeedsOf(std::size_t round) const;
  SeedRange FirstSeed() const;
  bool RendersBase(const std::vector<SeedImage>& image);
  const std::vector<SeedImage>& Base(std::size_t round);
  const std::vector<double>& Weights();
  std::vector<Finding> Round(std::size_t round, const std::vector<SeedImage>& images,
                             const std::optional<std::vector<Finding>>& before,
                             BiasVerdict& verdict);

  PreparedScene scene_;
  std::string base_;
  std::vector<BiasRound> rounds_;
  int tile_;
  std::vector<std::optional<std::vector<SeedImage>>> base_images_;
  std::vector<double> weights_;  // of pixels
};

template <class Render>
BiasVerdict BiasTest::CompareImages(Render&& render) {
  BiasVerdict verdict;
  std::optional<std::vector<Finding>> findings;
  for (std::size_t r = 0; r < rounds_.size(); ++r) {
    if (r == 0 && RendersBase(render(FirstSeed()))) {
      verdict.identical = true;
      return verdict;
    }
    findings = Round(r, render(SeedsOf(r)), findings, verdict);
    if (findings->empty() || !verdict.HasPower()) return verdict;
  }
  verdict.biased = true;
  return verdict;
}

}  // namespace lanelight::test
