// What the calibration is asked to measure, and how the time is dealt out.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace lanelight::bench {

inline constexpr int kMinSeeds = 10;
inline constexpr std::uint64_t kMinReferenceSpp = 1024;
/// Squared error of the reference over that of renders. It adds 2 kMaxOwnError to the
/// relative variance of their errors (in units of that of the interval): above, true
/// intervals would seem to fail.
inline constexpr double kMaxOwnError = 0.1;

struct CalibrateOptions {
  std::vector<std::string> scenes;  // empty: all that there are
  std::vector<std::string> strategies = {
      "points=independent", "points=sobol", "points=halton",
      "pairs=antithetic,points=independent", "roulette=adjoint"};
  std::vector<std::string> resolutions = {"48x48", "96x96"};
  std::vector<std::uint64_t> spp = {16, 64, 256, 1024};
  std::uint64_t reference_spp = 0;  // 0: what the time allows
  std::vector<double> targets;
  double minutes = 55;
  int seeds = 200, min_seeds = kMinSeeds, threads = 0;
};

/// Scenes of the project (scenes/*.pbrt) and of $LANELIGHT_SCENES (../shared/scenes:
/// */scene-v4.pbrt), sorted.
std::vector<std::string> AllScenes();

/// "folder/file" of a path, without the extension.
std::string SceneName(const std::string& path);

/// Width and height of "WxH", as many pixels. Throws InputError.
std::array<int, 2> ParseResolution(const std::string& text);

/// Seconds that are left until some moment.
class Deadline {
 public:
  explicit Deadline(double seconds)
      : end_(Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                std::chrono::duration<double>(seconds))) {}
  double Left() const {
    return std::chrono::duration<double>(end_ - Clock::now()).count();
  }
  bool Over() const { return Left() <= 0; }
  /// An even share of what is left, which may be nothing.
  Deadline Share(double parts) const { return Deadline(Left() > 0 ? Left() / parts : 0); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point end_;
};

}  // namespace lanelight::bench
