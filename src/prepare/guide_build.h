// From records to a guide.
#pragma once

#include <cstddef>
#include <vector>

#include "src/prepare/guide_records.h"

namespace lanelight {

struct GuideSettings {
  std::size_t cell_records = 1000;  // a cell with more is divided
  std::size_t most_cells = 28'000;  // 2.1 KB each: 59 MB
  double even = 0.05;               // AppendGuideCell
  /// Records that the cell around counts for: where there are fewer, or a few bright ones
  /// are all that there is, a cell is much like what surrounds it.
  double borrowed = 200;
};

/// What came out, for a note.
struct GuideSummary {
  std::size_t cells = 0, records = 0;
  double fraction = 0;  // mean over the records
  /// Second moment of what a scattered ray brings with the fractions chosen over that
  /// without the guide, mean over the cells weighted by their records; 1 where unknown.
  double gain = 1;
};

/// The guide of these records, which are sorted anew. The density of a cell follows
/// GuideRecord::Mass over directions. No record counts for more than a sixteenth of its
/// cell's mass (or the fourth brightest); cells with few that count borrow from those
/// around. The fraction of a cell is the one in {0, 0.1, ..., 0.5} with which the records
/// of a guided pass (GuideRecord::guide > 0) would have the least second moment: a
/// mixture c g + (1 - c) p, and the integrand p L, by importance weights. Without such
/// records it is up to a half. Depends on the records and their order alone.
Guide BuildGuide(std::vector<GuideRecord>& records, const GuideSettings& settings,
                 GuideSummary* summary = nullptr);

}  // namespace lanelight
