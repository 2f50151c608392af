// Throughputs as JSON, to be kept, posted, and compared with.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "src/measure/throughput/throughput.h"

namespace lanelight {

/// Changes when a member changes its meaning or goes away, not when one is added.
inline constexpr int kBenchSchema = 1;

/// Machine, program, and every row with the seconds of all its repeats; docs/bench.md.
/// `within`: what medians were to be known to (ThroughputOptions::within).
nlohmann::json ToJson(const std::vector<ThroughputRow>& rows, double within);

/// What of a row a comparison needs.
struct KnownRow {
  std::string scene, target, strategy;
  int threads = 0, width = 0, height = 0;
  std::uint64_t spp = 0;
  Interval rate, cpu_rate;  // samples per second, and per second of processor time

  /// The same for rows that can be compared; of the strategy, what is not as by default.
  std::string Key() const;
};
struct KnownThroughput {
  std::string machine, program;
  std::vector<std::string> busy;  // BusyReasons()
  std::vector<KnownRow> rows;
};

/// Reads what ToJson has written. Throws InputError.
KnownThroughput ReadThroughput(const std::string& path);
KnownThroughput ThroughputFromJson(const nlohmann::json& json);

}  // namespace lanelight
