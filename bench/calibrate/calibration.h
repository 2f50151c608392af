// Renders of scenes by strategies over many seeds, compared with a reference.
#pragma once

#include <string>

#include "bench/calibrate/coverage.h"
#include "bench/calibrate/options.h"
#include "bench/calibrate/truth.h"

namespace lanelight::bench {

/// Measures and prints. The time is shared evenly by what is left to do; what it does not
/// suffice for is left out, and said.
class Calibration {
 public:
  /// Refers to the options. Throws InputError for a strategy that is not understood.
  explicit Calibration(const CalibrateOptions& options);

  /// All scenes at all resolutions. Scenes that cannot be rendered are said and left out.
  void Run();

 private:
  void Scene(const std::string& path, const std::string& resolution,
             const Deadline& deadline);
  /// Rows of one scene; `scene` is its name with its resolution.
  void Rows(const Job& job, const std::string& scene, const Reference& reference,
            const Deadline& deadline);
  void Row(const Job& scene, const std::string& strategy, std::uint64_t spp,
           const Reference& reference, const Deadline& deadline, ErrorCoverage& out);
  /// Unless the reference is too coarse for the row.
  void AddTotals(const std::string& scene, const std::string& strategy, std::uint64_t spp,
                 const ErrorCoverage& row, const Reference& reference);
  /// Renders that stop by themselves.
  void Stops(const Job& scene, const std::string& strategy, double target,
             const Reference& reference, const Deadline& deadline);
  void PrintTotals() const;

  const CalibrateOptions& options_;
  const std::vector<std::string> strategies_;
  const Deadline end_;
  ErrorCoverage all_;
  Totals by_scene_, by_strategy_, by_spp_;
  std::uint64_t all_reached_ = 0, all_stopped_ = 0;
  std::size_t left_out_ = 0, coarse_ = 0;  // rows
};

}  // namespace lanelight::bench
