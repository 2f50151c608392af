// Bias of strategies on scene files, tile by tile: what the tests over our own scenes and
// over the shared ones have in common.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tests/bias/tile_bias.h"

namespace lanelight::test {

/// Which strategies a test renders on each scene.
enum class BiasCoverage {
  // Images of 48 x 48 pixels; path reuse, and combinations in turn: all over all scenes.
  kRotating,
  // Images of 64 x 64 pixels; every choice of every axis by itself.
  kEveryChoice
};

/// The smallest bias that some scene would show, for every choice.
class BiasPower {
 public:
  void Add(const std::string& strategy, const BiasVerdict& verdict);
  /// Requires a bias of `tile` in the median tile, or of `image` in the image's mean, to
  /// be found for every choice that was rendered.
  void Check(double tile, double image) const;
  std::size_t choices() const { return minimum_.size(); }

 private:
  std::map<std::string, std::pair<double, double>> minimum_;  // tile, image
};

/// Compares strategies with the scene's own, without a trial run, on every file; requires
/// that none is biased.
BiasPower CheckSceneBias(const std::vector<std::filesystem::path>& files,
                         BiasCoverage coverage, const std::vector<BiasRound>& rounds);

}  // namespace lanelight::test
