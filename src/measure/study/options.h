// What a study is asked for.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "src/render/job/settings.h"

namespace lanelight {

inline constexpr double kDefaultStudySeconds =
    1;  // of the largest render of the baseline

/// Below so many samples per pixel a ranking may be another than after many, unless the
/// relative error (the root of the relative MSE) is small already.
inline constexpr std::uint64_t kLeastLargest = 64;
inline constexpr double kSmallError = 0.1;

struct StudyOptions {
  std::vector<std::string> scenes;
  RenderSettings settings;              // what `render` takes too; no spp, no seconds
  std::vector<std::string> strategies;  // empty: the paper's presets and the default
  bool all_strategies = false;          // every choice of every axis
  std::vector<std::uint64_t> spp;       // empty: powers of two up to a budget
  std::optional<double> budget;         // seconds of the largest render of each strategy
  std::optional<int> repetitions;       // empty: see Repetitions()
  double confidence = 0.95;             // of all intervals
  std::vector<std::string> references;  // files; empty: rendered
  std::optional<double> target_relmse;  // empty: what the baseline reaches
  std::string out;                      // directory
  bool resume = false;
  bool paper = false;  // index.html too: the founding paper's figures on one page

  /// The number that was asked for; else, for a confidence of 1 - a, 2 + ceil(log2(2 /
  /// a)): two more than where a sign test can be that sure. 8 for 95 %, 10 for 99 %.
  int Repetitions() const;
};

/// A strategy under its name on the command line: "default" is the renderer's, "scene"
/// the scene's own, anything else a change of the default.
struct NamedStrategy {
  std::string name;
  Strategy strategy;
};

/// The strategies of a study on a scene whose own strategy is `base`, each name once.
/// Several may be the same strategy. Throws InputError for a text that is not understood.
std::vector<NamedStrategy> StudyStrategies(const StudyOptions& options,
                                           const Strategy& base);

/// Number of the figure of the founding paper that a preset makes (2 to 7), or 0.
int PaperFigure(const std::string& name);

}  // namespace lanelight
