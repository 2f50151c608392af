// A training pass with splitting, which also estimates the second moment of the same
// paths with roulette on the throughput. Every split path is distributed like a single
// path and carries w, the product of 1/r of the decisions so far; a path that a decision
// has ended counts as 0. So, for any f of a path,
//   E[sum over the copies of w f(copy)] = E[f(path)] without any roulette
// and with f the second moment by roulette on the throughput,
//   f = L^2 + sum over its decisions of W (1/s - 1) (L - g)^2
// of throughput, L and g without w, the pass estimates that moment without tracing paths
// of the other strategy. L is the brightness at the end, g that gathered before a
// decision of survival s. W is the product of 1/s of the decisions before; a survivor's
// throughput is larger by it. The sums of a = W (1/s - 1), of a g and of a g^2 are kept
// (W is one plus the first of them). Split paths meet rare bright samples more often,
// with smaller weights, and both moments are compared on the same samples.
//
// Moments are about the pixel's brightness from training: about zero, the variance of the
// sums of w would exceed a variance far below the mean's square.
//
// L from gathered light: between two decisions l grows by w times the light of the path
// alone. A split path begins with l = 0, but with L.
#include "kernels/simd/each_target-inl.h"

#include "kernels/roulette/cell-inl.h"

LANELIGHT_BEGIN_KERNELS

// 3 sqrt(3): PilotImage::Inverse is 1 / (3 sqrt(3) channel color).
inline constexpr float kBrightnessOfInverse = 5.1961524f;

LANELIGHT_INLINE VF Gathered(const Wave& wave, const Slots& slots) {
  const PathColumns& p = wave.path;
  return Brightness(wave.run->tables->path_values, Gather3(p.l_r, p.l_g, p.l_b, slots));
}

LANELIGHT_INLINE VF Sent(const Wave& wave, const Slots& slots) {
  const PathColumns& p = wave.path;
  return Brightness(wave.run->tables->path_values,
                    Gather3(p.beta_r, p.beta_g, p.beta_b, slots));
}

// Returns what the path would have gathered without splitting.
LANELIGHT_INLINE VF SinglePathRadiance(const PathColumns& p, const Slots& slots,
                                       VF gathered) {
  const VF since = hn::Sub(gathered, Gather(p.single_l, slots));
  return hn::Add(Gather(p.single_gathered, slots),
                 hn::Div(since, Gather(p.copy_weight, slots)));
}

// Returns the brightness of the pixel about which moments are taken, from
// PathValues::inverse_pixel (MomentsAbout in src/render/train/path_records.h).
LANELIGHT_INLINE VF MomentCenter(const Wave& wave, const Slots& slots) {
  const float* inverse = wave.run->tables->path_values.inverse_pixel.data();
  const VI at = hn::Mul(Gather(wave.path.pixel, slots), hn::Set(DI(), 3));
  const V3 weights = Gather3(inverse, inverse + 1, inverse + 2, at);
  const VF one = Splat(1.0f);
  const VF sum = hn::Add(hn::Add(hn::Div(one, weights.x), hn::Div(one, weights.y)),
                         hn::Div(one, weights.z));
  const VF about = hn::Div(sum, Splat(kBrightnessOfInverse * wave.run->exposure));
  // The second moment of a black image is unknown.
  return hn::IfThenElseZero(hn::Gt(weights.x, hn::Zero(DF())), about);
}

// Adds the increase that roulette on the throughput causes in the second moment of paths
// that have gathered g at this throughput.
LANELIGHT_INLINE void AddRisk(const PathColumns& p, const Slots& slots, VF throughput,
                              VF g) {
  const VF one = Splat(1.0f), risk = Gather(p.risk_0, slots);
  const VF weight = hn::Add(one, risk);
  // The throughput that a survivor of the decisions before would have.
  VF s = hn::Mul(throughput, weight);
  if (p.eta_scale != nullptr) s = hn::Mul(s, Gather(p.eta_scale, slots));
  const VI before = hn::Set(DI(), kThroughputFirst - 1);
  const MF late = hn::RebindMask(DF(), hn::Gt(Gather(p.depth, slots), before));
  s = hn::Min(hn::IfThenElse(late, s, one), one);
  const VF a = hn::Mul(weight, hn::Sub(hn::Div(one, s), one));
  const VF ag = hn::Mul(a, g);
  Scatter(hn::Add(risk, a), p.risk_0, slots);
  Scatter(hn::Add(Gather(p.risk_1, slots), ag), p.risk_1, slots);
  Scatter(hn::MulAdd(ag, g, Gather(p.risk_2, slots)), p.risk_2, slots);
}

void SinglePathBefore(Wave& wave) {
  const PathColumns& p = wave.path;
  ForEachBatch(wave, wave.queue(QueueId::kVertex), [&](const Slots& slots, MF) HWY_ATTR {
    const VF gathered = Gathered(wave, slots);
    Scatter(SinglePathRadiance(p, slots, gathered), p.single_gathered, slots);
    Scatter(gathered, p.single_l, slots);
    Scatter(Sent(wave, slots), p.decided_at, slots);
  });
}

void SinglePathAfter(Wave& wave) {
  const PathColumns& p = wave.path;
  ForEachBatch(wave, wave.queue(QueueId::kVertex), [&](const Slots& slots, MF) HWY_ATTR {
    const VF before = Gather(p.decided_at, slots), zero = hn::Zero(DF());
    // A path without throughput gathers nothing, whatever its weight.
    const VF factor = hn::IfThenElse(hn::Gt(before, zero),
                                     hn::Div(Sent(wave, slots), before), Splat(1.0f));
    Scatter(hn::Mul(Gather(p.copy_weight, slots), factor), p.copy_weight, slots);
    Scatter(Splat(-1.0f), p.decided_at, slots);
  });
}

void SinglePathDecision(Wave& wave) {
  const PathColumns& p = wave.path;
  ForEachBatch(
      wave, wave.queue(QueueId::kScattered), [&](const Slots& slots, MF) HWY_ATTR {
        const VF beta = MaxComponent(Gather3(p.beta_r, p.beta_g, p.beta_b, slots));
        AddRisk(p, slots, hn::Div(beta, Gather(p.copy_weight, slots)),
                SinglePathRadiance(p, slots, Gathered(wave, slots)));
      });
}

// In the order of PlaneGroup::kSinglePath; both are sums over the copies.
void SinglePathEnd(Wave& wave) {
  const PathColumns& p = wave.path;
  float* const plane =
      wave.buffer.samples +
      std::size_t(wave.run->planes.First(PlaneGroup::kSinglePath)) * wave.buffer.stride;
  ForEachBatch(wave, wave.queue(QueueId::kDone), [&](const Slots& slots, MF) HWY_ATTR {
    const VI output = Gather(p.output, slots);
    const VF zero = hn::Zero(DF()), gathered = Gathered(wave, slots);
    const VF end = SinglePathRadiance(p, slots, gathered), square = hn::Mul(end, end);
    VF added = hn::MulAdd(square, Gather(p.risk_0, slots), Gather(p.risk_2, slots));
    added = hn::NegMulAdd(hn::Add(end, end), Gather(p.risk_1, slots), added);
    // Values within rounding are taken as 0, and so is NaN from a path that carries
    // nothing.
    added = hn::IfThenElseZero(hn::Gt(added, hn::Mul(square, Splat(1e-5f))), added);
    const VF off = hn::Sub(end, MomentCenter(wave, slots));
    const VF moment = hn::Mul(hn::MulAdd(off, off, added), Gather(p.copy_weight, slots));
    const MF ended = hn::Ge(Gather(p.decided_at, slots), zero);
    Scatter(gathered, plane, output);
    Scatter(hn::IfThenElse(ended, zero, moment), plane + wave.buffer.stride, output);
  });
}

namespace {
constexpr FieldSet kTransport =
    fields::kThroughput | fields::kRadiance | fields::kSinglePath | fields::kRisk;
}  // namespace

Stage SinglePathBeforeStage() {
  return {.name = "single_path_before",
          .meaning = "records single-path light before a decision",
          .input = QueueId::kVertex,
          .role = StageRole::kRecord,
          .needs = {Feature::kRecordsSinglePaths, Feature::kSplitting},
          .reads = fields::kThroughput | fields::kRadiance | fields::kSinglePath,
          .writes = FieldSet{Field::single_gathered, Field::single_l, Field::decided_at},
          .resolve = Always<SinglePathBefore>};
}
Stage SinglePathAfterStage() {
  return {.name = "single_path_after",
          .meaning = "records the weight of a path after a decision",
          .input = QueueId::kVertex,
          .role = StageRole::kRecord,
          .needs = {Feature::kRecordsSinglePaths, Feature::kSplitting},
          .reads = fields::kThroughput | FieldSet{Field::copy_weight, Field::decided_at},
          .writes = FieldSet{Field::copy_weight, Field::decided_at},
          .resolve = Always<SinglePathAfter>};
}
Stage SinglePathDecisionStage() {
  return {.name = "single_path_decision",
          .meaning = "records the second moment by roulette for split training paths",
          .input = QueueId::kScattered,
          .role = StageRole::kRecord,
          .needs = {Feature::kRecordsSinglePaths, Feature::kSplitting},
          .reads = kTransport | FieldSet{Field::depth, Field::eta_scale},
          .writes = fields::kRisk,
          .resolve = Always<SinglePathDecision>};
}
Stage SinglePathEndStage() {
  return {.name = "single_path_end",
          .meaning = "writes the single-path estimate of a finished training path",
          .input = QueueId::kDone,
          .role = StageRole::kRecord,
          .needs = {Feature::kRecordsSinglePaths, Feature::kSplitting},
          .reads = kTransport | FieldSet{Field::output, Field::pixel},
          .resolve = Always<SinglePathEnd>};
}

LANELIGHT_END_KERNELS
