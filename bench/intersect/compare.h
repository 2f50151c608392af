// Ours against every entry of a peer on one ray set.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/intersect/tracer.h"

namespace lanelight::bench {

/// Median and extremes of the repetitions.
struct MedianRange {
  double median = 0, low = 0, high = 0;  // low, high: least and largest
};
MedianRange MedianRangeOf(std::vector<double> values);

struct EntryResult {
  PeerEntry entry;
  int repetitions = 0;
  double mrays = 0;   // millions of rays per second, median
  MedianRange ratio;  // ours / this entry in rays per second
};

/// How hits of ours agree with others', over all rays but where it says otherwise.
struct Agreement {
  int sample = 0, wrong = 0;  // of a sample: other than double precision says
  /// Hit instead of miss or another triangle, per million rays; other triangles at the
  /// same distance (to 1e-5) are ties. Against "high 1" and "high robust 1".
  double differ = 0, ties = 0, differ_robust = 0, ties_robust = 0;
};

struct SetResult {
  std::string mesh, set;
  std::size_t triangles = 0, rays = 0;
  double ours = 0;                   // Mrays/s, median over all its runs
  std::vector<EntryResult> entries;  // as Peer::Entries; empty without a peer
  std::optional<std::size_t> best, best_robust;
  Agreement agreement;
};

struct CompareOptions {
  int wave = 2048, repeat = 9;
  double max_seconds = 0.25;
};

/// First every entry runs twice. Entries slower than 0.85 of the best of their class
/// (robust or not; by the faster run) are out: they cannot be the bar, and there are
/// dozens. The others then run `repeat` times, each time right beside a run of ours,
/// which goes first in every second repetition: each pair gives one ratio. Of a set that
/// takes ours longer than `max_seconds` only every n-th wave is traced.
SetResult Compare(const Mesh& mesh, const CompiledScene& scene, const RaySet& whole,
                  Peer* peer, const CompareOptions& options);

}  // namespace lanelight::bench
