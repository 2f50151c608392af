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
  /// Asks that a bias of `tile` in the median tile, or of `image` in the image's mean, be
  /// found for every choice that is rendered.
  BiasPower(double tile, double image) : tile_(tile), image_(image) {}

  void Add(const std::string& strategy, const BiasVerdict& verdict);
  /// Returns the choices that have been rendered, but would show only a larger bias.
  std::vector<std::string> Insufficient() const;
  void Check() const;
  std::size_t choices() const { return minimum_.size(); }

 private:
  bool Suffices(const std::pair<double, double>& minimum) const;

  double tile_, image_;
  std::map<std::string, std::pair<double, double>> minimum_;  // tile, image
};

/// Compares strategies with the scene's own, without a trial run, on every file; requires
/// that none is biased. Then renders choices by themselves, in scenes with little noise
/// first, until `power` suffices.
void CheckSceneBias(const std::vector<std::filesystem::path>& files,
                    BiasCoverage coverage, const std::vector<BiasRound>& rounds,
                    BiasPower& power);

}  // namespace lanelight::test
