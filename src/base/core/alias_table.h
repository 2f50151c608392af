// Sampling a discrete distribution in constant time: the alias method of Walker 1977 with
// the linear-time construction of Vose 1991.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "src/base/core/aligned.h"

namespace lanelight {

/// With u * n = i + f (i integer, f in [0, 1)): pick i if f < q[i], else alias[i].
struct AliasTable {
  AlignedVector<float> q;
  AlignedVector<std::uint32_t> alias;
  /// The real probability of each item, computed from the rounded q: an estimator that
  /// divides by it has no bias from rounding. Sums to 1.
  AlignedVector<float> probability;

  std::size_t size() const { return q.size(); }
};

/// Table over weights >= 0 (finite, at least one positive). An entry of weight zero is
/// never picked.
AliasTable BuildAliasTable(std::span<const double> weights);

}  // namespace lanelight
