// Roulette and splitting at a surface, before the numbers of the bounce are drawn and
// before it is shaded: all split paths share the hit, and each takes its own light sample
// and direction. A policy is a struct with
//   static VF Factor(const Wave&, const Slots& slots, V3 beta)
// giving the expected number of split paths r >= 0.
//   estimator   k = floor(r + u) paths of weight 1/r: E = sum of k (x_i / r) = x, since
//               E[k] = r and the paths are identically distributed
//   unbiased    r > 0: it is kept in [kMinFactor, budget], and at the camera's own hit in
//               [1, budget], so that what a pixel shows first is never lost
//   variance    roulette adds E[x^2] (1/r - 1); splitting divides the variance of what
//               follows by r. Survivors weigh at most 1 / kMinFactor times their parent
//   cost        a hash and a compaction per vertex; copying the live columns per copy
//   bound       a camera sample starts with a budget of kMaxSplitPaths, which its copies
//               divide between them: copy c of k takes the names
//               [branch + c b / k, branch + (c + 1) b / k) of its parent's b. So the
//               result does not depend on how many slots happen to be free, names are
//               unique, and live paths never need more than kMaxSplitPaths slots per
//               sample
#ifndef LANELIGHT_ROULETTE_WINDOW_INL_H_
#define LANELIGHT_ROULETTE_WINDOW_INL_H_

#include "kernels/queue/batch-inl.h"
#include "kernels/roulette/cell-inl.h"
#include "kernels/simd/rng-inl.h"
#include "src/base/core/check.h"

LANELIGHT_BEGIN_KERNELS

/// The smallest r.
inline constexpr float kMinFactor = 0.05f;

LANELIGHT_INLINE VF DecisionNumber(const Wave& wave, const Slots& slots) {
  const PathColumns& p = wave.path;
  const VU depth = AsUnsigned(Gather(p.depth, slots));
  return ToUnit(
      Pcg4d({AsUnsigned(Gather(p.pixel, slots)), AsUnsigned(Gather(p.sample, slots)),
             KeyOf(p, Dimension::kRoulette, depth, slots), SplatU(wave.run->seed)})
          .x);
}

/// Returns the weight in the image of a unit of brightness gathered from here on: the
/// root mean square over channels of throughput over pixel brightness.
LANELIGHT_INLINE VF WeightInImage(const Wave& wave, const Slots& slots, V3 beta) {
  const float* inverse = wave.run->tables->path_values.inverse_pixel.data();
  const VI at = hn::Mul(Gather(wave.path.pixel, slots), hn::Set(DI(), 3));
  const V3 relative = Mul(beta, Gather3(inverse, inverse + 1, inverse + 2, at));
  return hn::Sqrt(Dot(relative, relative));
}

/// Returns the expected copies in cells without data: throughput roulette from the second
/// event on.
LANELIGHT_INLINE VF ThroughputFactor(const PathColumns& p, const Slots& slots, V3 beta) {
  VF s = MaxComponent(beta);
  if (p.eta_scale != nullptr) s = hn::Mul(s, Gather(p.eta_scale, slots));
  const auto late = hn::Gt(Gather(p.depth, slots), hn::Set(DI(), kThroughputFirst - 1));
  return hn::IfThenElse(hn::RebindMask(DF(), late), hn::Min(s, Splat(1.0f)), Splat(1.0f));
}

/// Copies the parents' columns to the new slots. Gathered light begins with 0: the sample
/// is the sum of its copies.
LANELIGHT_INLINE void CopyPaths(const ColumnLists& lists, const uint32_t* parents,
                                const uint32_t* slots, uint32_t n) {
  for (uint32_t c = 0; c < lists.copied.count; ++c) {
    uint32_t* column = lists.copied.columns[c];
    for (uint32_t i = 0; i < n; ++i) column[slots[i]] = column[parents[i]];
  }
  for (uint32_t c = 0; c < lists.begun_by_split_paths.count; ++c) {
    uint32_t* column = lists.begun_by_split_paths.columns[c];
    for (uint32_t i = 0; i < n; ++i) column[slots[i]] = lists.copy_values[c];
  }
}

/// Divides the budget of a parent among its k copies: its own share, and those of the new
/// slots.
LANELIGHT_INLINE void DistributeBudget(const PathColumns& p, uint32_t parent,
                                       const uint32_t* slots, uint32_t k) {
  const uint32_t budget = p.budget[parent];
  LL_DCHECK(k <= budget);
  for (uint32_t c = 1; c < k; ++c) {
    const uint32_t slot = slots[c - 1], begin = c * budget / k;
    p.branch[slot] += begin;
    p.output[slot] += begin;
    p.budget[slot] = (c + 1) * budget / k - begin;
  }
  p.budget[parent] = budget / k;
}

/// Makes copies[i] paths of the i-th of the queue, appending the new ones. The queue of
/// shadow rays, empty so far, lends its room for the parents' slots.
LANELIGHT_INLINE void SplitPaths(Wave& wave, Queue& queue, const uint32_t* copies) {
  Queue& free = wave.queue(QueueId::kFree);
  uint32_t* parents = wave.queue(QueueId::kShadow).items;
  const uint32_t before = queue.size;
  const uint32_t* slots = queue.items + before;
  uint32_t n = 0;
  for (uint32_t i = 0; i < before; ++i) {
    for (uint32_t c = 1; c < copies[i]; ++c) {
      LL_DCHECK(free.size > 0);
      parents[n++] = queue.items[i];
      queue.items[queue.size++] = free.items[--free.size];
    }
  }
  CopyPaths(wave.lists, parents, slots, n);
  for (uint32_t i = 0; i < n;) {
    uint32_t k = 1;
    while (i + k - 1 < n && parents[i + k - 1] == parents[i]) ++k;
    DistributeBudget(wave.path, parents[i], slots + i, k);
    i += k - 1;
  }
}

template <class Policy>
LANELIGHT_INLINE void ApplyWeightWindow(Wave& wave) {
  const PathColumns& p = wave.path;
  Queue& queue = wave.queue(QueueId::kVertex);
  Queue survivors = {queue.items, 0};  // compacts in place: writes never pass reads
  Queue copies = {wave.queue(QueueId::kScratch).items, 0};
  bool splits = false;
  ForEachBatch(wave, queue, [&](const Slots& slots, MF valid) HWY_ATTR {
    const V3 beta = Gather3(p.beta_r, p.beta_g, p.beta_b, slots);
    const MF first = hn::RebindMask(DF(), hn::Eq(Gather(p.depth, slots), hn::Zero(DI())));
    const VF minimum = hn::IfThenElse(first, Splat(1.0f), Splat(kMinFactor));
    const VF maximum = hn::ConvertTo(DF(), Gather(p.budget, slots));
    const VF wanted = Policy::Factor(wave, slots, beta);
    // Also catches what is not a number.
    const VF r =
        hn::IfThenElse(hn::Gt(wanted, minimum), hn::Min(wanted, maximum), minimum);
    const VF whole = hn::Floor(r);
    const MF more = hn::Lt(DecisionNumber(wave, slots), hn::Sub(r, whole));
    const VF k = hn::Add(whole, hn::IfThenElseZero(more, Splat(1.0f)));
    const MF survives = hn::Gt(k, hn::Zero(DF()));
    Scatter3(Mul(beta, hn::Div(Splat(1.0f), r)), p.beta_r, p.beta_g, p.beta_b, slots);
    splits |= !hn::AllFalse(DF(), hn::Gt(k, Splat(1.0f)));
    Push(copies, hn::ConvertTo(DI(), k), hn::And(valid, survives));
    Push(survivors, slots, hn::And(valid, survives));
    Push(wave.queue(QueueId::kDone), slots, hn::AndNot(survives, valid));
  });
  queue.size = survivors.size;
  if (splits) SplitPaths(wave, queue, copies.items);
}

/// The stage of a roulette that splits.
template <class Policy>
Stage WindowStage(const char* name, const char* meaning, Feature kind) {
  const FieldSet identity = {Field::pixel,  Field::sample, Field::depth,
                             Field::output, Field::branch, Field::budget};
  return {.name = name,
          .meaning = meaning,
          .input = QueueId::kVertex,
          .role = StageRole::kRoulette,
          .needs = {Feature::kSplitting, Feature::kScatters, kind},
          .reads = fields::kThroughput | fields::kRay | fields::kPoint | fields::kNormal |
                   identity | FieldSet{Field::eta_scale},
          .writes = fields::kThroughput | fields::kRadiance | identity,
          .resolve = Always<ApplyWeightWindow<Policy>>};
}

LANELIGHT_END_KERNELS

#endif
