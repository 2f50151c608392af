// With which probability a cell's guide should propose.
#pragma once

#include <array>

#include "src/prepare/guide_records.h"

namespace lanelight {

/// Second moments, by fraction, of what a scattered ray brings: with q the density on
/// record, and c g + (1 - c) p the one to be judged, each record of p L / q adds
///   (p L)^2 / (q (c g + (1 - c) p)) = m^2 / (c g / q + (1 - c) p / q),  m = p L / q.
/// The guide g is that of the pass, which has not seen the record: it is not praised for
/// what it has learned by heart.
class FractionSums {
 public:
  /// 0, 0.1, ..., 0.5. More would be better for what records have seen, and worse for the
  /// rare light that they have missed: at a half the second moment of anything is at most
  /// twice that of the material alone.
  static constexpr int kFractions = 6;

  struct Choice {
    double fraction, gain;  // gain: second moment over that of fraction 0
  };

  void Add(const GuideRecord& record);
  /// With what is known of the surroundings, by how many records count here.
  FractionSums Blend(const FractionSums& around) const;
  /// Of the fractions the best. Where no guide has been tried yet: half, less where few
  /// records count (`effective`).
  Choice Best(double effective) const;

 private:
  std::array<double, kFractions> sums_{};  // after Blend: relative to the first
  double squares_ = 0;                     // of what the first is the sum of
};

}  // namespace lanelight
