// reuse=block: every second vertex of a block that carries light, seen from every first
// vertex of the block.
//
// Path j has found its second vertex y from its first one x_j with a density p_j(y), and
// has gathered the light L_j that y sends back. Each pixel i of the block adds
//
//   estimator   beta_i f_i(x_i, y) |cos| G V_i L_j / sum over k of p_k(y) V_k,
//               beta_i the throughput up to x_i, G the cosine at y over the distance
//               squared, p_k in area measure at y, V whether x and y see each other:
//               one sample of each of N techniques by the balance heuristic
//               (kernels/reuse/glossy.cc has the terms of a glossy y)
//   density     that of material or uniform directions, without a mirror's lobe. A path
//               that finds y by such a lobe, or no y at all, serves no other pixel. There
//               is no roulette between x and y
//   partition   the other side of y, by geometric or shading normal, is another point;
//               paths with different numbers of events before their first vertices are
//               not paired, as max depth cuts their suffixes at different lengths
//   unbiased    the p_k V_k are the densities with which y is found, all of them
//   variance    for equal p_k V_k that of N suffixes; at edges and in corners about that
//               of the best technique
//   cost        one evaluation per pair, and a shadow ray where p_k > 0; none for second
//               vertices without light
//   source      Bekaert, Sbert and Halton 2002, "Accelerating Path Tracing by Re-Using
//               Paths"; Veach and Guibas 1995 (balance heuristic)
//
// Lanes are first vertices of one kind of material.
#include "kernels/simd/each_target-inl.h"

#include "kernels/bsdf/kinds-inl.h"
#include "kernels/lights/light-inl.h"
#include "kernels/reuse/block-inl.h"
#include "kernels/shade/shade-inl.h"

LANELIGHT_BEGIN_KERNELS

// A second vertex, the same in all lanes.
struct SecondVertex {
  V3 at, ng, ns;
  VF p_error;
  VI record, depth;

  HWY_INLINE SecondVertex(const Block& block, uint32_t r) {
    const ReuseColumns& c = block.second;
    at = Splat3(c.x[r], c.y[r], c.z[r]);
    p_error = Splat(c.p_error[r]);
    ng = Splat3(c.ng_x[r], c.ng_y[r], c.ng_z[r]);
    ns = Splat3(c.ns_x[r], c.ns_y[r], c.ns_z[r]);
    record = hn::Set(DI(), static_cast<int32_t>(r));
    depth = hn::Set(DI(), static_cast<int32_t>(block.first->path.depth[r]));
  }
};

// The connection of first vertices to a second one.
struct Connection {
  V3 wi;  // unit
  VF geometry;
  MF connects;

  template <class Lanes>
  HWY_INLINE Connection(const Lanes& x, const SecondVertex& y) {
    const VF zero = hn::Zero(DF());
    const V3 to = y.at - x.p;
    const VF d2 = Dot(to, to);
    wi = Mul(to, Rsqrt(d2));
    const VF cosine = hn::Neg(Dot(y.ng, wi));
    geometry = hn::Div(cosine, d2);
    const MF faces = hn::And(hn::Gt(cosine, zero), hn::Lt(Dot(y.ns, wi), zero));
    const MF alike = hn::RebindMask(DF(), hn::Eq(x.depth, y.depth));
    connects = hn::And(hn::And(faces, alike), IsPositiveFinite(geometry));
  }
};

// First vertices of one kind, a vector of them.
template <class Bsdf, class Proposal>
struct Receivers {
  const SurfaceReader<Bsdf>& reader;
  Slots records;
  V3 p, ng, beta, wo;
  VF p_error;
  VI depth;
  ShadingFrame frame;
  typename Bsdf::Params material;

  HWY_INLINE Receivers(const SurfaceReader<Bsdf>& from, VI slots)
      : reader(from),
        records(slots),
        p(Gather3(path().p_x, path().p_y, path().p_z, records)),
        ng(Gather3(path().ng_x, path().ng_y, path().ng_z, records)),
        beta(Gather3(path().beta_r, path().beta_g, path().beta_b, records)),
        p_error(Gather(path().p_error, records)),
        depth(Gather(path().depth, records)),
        frame(reader.ReadFrame(ng, records)),
        material(Bsdf::Load(reader.Inputs(records))) {
    wo = frame.ToLocal(-Gather3(path().d_x, path().d_y, path().d_z, records));
  }
  HWY_INLINE const PathColumns& path() const { return reader.wave.path; }

  /// Returns throughput over geometry, and density by solid angle.
  HWY_INLINE BsdfValue Value(V3 wi) const {
    const V3 local = frame.ToLocal(wi);
    const BsdfValue value = Bsdf::Eval(material, wo, local);
    VF pdf = Proposal::template Pdf<Bsdf>(wo, local, value.pdf);
    // A coin decides between mirrors and uniform directions (directions/uniform-inl.h).
    if constexpr (Bsdf::kHasDelta && Proposal::kIsUniform) {
      pdf = hn::Mul(pdf, Splat(0.5f));
    }
    return {Mul(beta, value.f_cos), pdf};
  }
};

// The ray ends in front of the surface of y, as shadow rays end in front of a light.
template <class Lanes>
HWY_INLINE void StoreRay(const PathColumns& ray, uint32_t at, const Lanes& x,
                         const SecondVertex& y) {
  const VF clearance = Clearance(x.p, y.at, hn::Max(x.p_error, y.p_error));
  const V3 to = MulAdd(y.ng, clearance, y.at) - x.p;
  const VF distance = hn::Sqrt(Dot(to, to));
  const V3 direction = Mul(to, hn::Div(Splat(1.0f), distance));
  StoreAt(direction, ray.ls_x, ray.ls_y, ray.ls_z, at);
  hn::StoreU(distance, DF(), ray.ls_distance + at);
}

template <class Lanes>
HWY_INLINE void StoreOrigin(const PathColumns& ray, uint32_t at, const Lanes& x) {
  const DF df;
  StoreAt(x.p, ray.p_x, ray.p_y, ray.p_z, at);
  StoreAt(x.ng, ray.ng_x, ray.ng_y, ray.ng_z, at);
  hn::StoreU(x.p_error, df, ray.p_error + at);
  if (ray.prim != nullptr) {
    hn::StoreU(hn::BitCast(df, Gather(x.path().prim, x.records)), df,
               reinterpret_cast<float*>(ray.prim) + at);
  }
}

// The pair of a path's own vertices has been traced already.
template <class Lanes>
HWY_INLINE void StorePair(Wave& wave, uint32_t at, const Lanes& x, const SecondVertex& y,
                          MF valid) {
  const DF df;
  const PairColumns& pairs = wave.block->pairs;
  const Connection c(x, y);
  const BsdfValue value = x.Value(c.wi);
  const VF pdf = hn::Mul(value.pdf, c.geometry);
  // A path that would carry nothing to y ends at x: it cannot propose y.
  const MF proposes = hn::And(IsPositiveFinite(pdf), CarriesLight(value.f_cos));
  const MF found = hn::And(hn::And(valid, c.connects), proposes);
  const V3 f = IfThenElseZero(found, Mul(value.f_cos, c.geometry));
  const MF own = hn::RebindMask(df, hn::Eq(x.records.index, y.record));
  StoreAt(f, pairs.f_r, pairs.f_g, pairs.f_b, at);
  hn::StoreU(hn::IfThenElseZero(found, pdf), df, pairs.pdf_area + at);
  hn::StoreU(hn::IfThenElseZero(own, Splat(1.0f)), df, pairs.visible + at);
  const MF traced = hn::AndNot(own, found);
  if (hn::AllFalse(df, traced)) return;
  StoreRay(wave.path, at, x, y);
  StoreOrigin(wave.path, at, x);
  Push(wave.queue(QueueId::kShadow), hn::Iota(DI(), static_cast<int32_t>(at)), traced);
}

template <class Bsdf, class Proposal>
HWY_NOINLINE void PairsOfKind(Wave& wave, const KindRange& range) {
  const Block& block = *wave.block;
  const SurfaceReader<Bsdf> reader(*block.first);
  const uint32_t lanes = static_cast<uint32_t>(hn::Lanes(DF()));
  for (uint32_t r = range.begin; r < range.end; r += lanes) {
    const VI records = hn::BitCast(DI(), hn::LoadU(DU(), block.receivers + r));
    const Receivers<Bsdf, Proposal> x(reader, records);
    const MF there = hn::FirstN(DF(), range.valid - (r - range.begin));
    for (uint32_t s = 0; s < block.num_suffixes; ++s) {
      const SecondVertex y(block, block.rows[s].record);
      StorePair(wave, s * block.num_receivers + r, x, y, there);
    }
  }
}

template <class Bsdf, ShadeKind kKind, class Proposal>
HWY_INLINE void PairsIfThere(Wave& wave, const KindRange* ranges) {
  if constexpr ((kReceivingKinds >> static_cast<int>(kKind) & 1) != 0) {
    const KindRange& range = ranges[static_cast<int>(kKind)];
    if (range.valid > 0) PairsOfKind<Bsdf, Proposal>(wave, range);
  }
}

template <class Proposal>
HWY_INLINE void ConnectPairs(Wave& wave) {
  Block& block = *wave.block;
  const MaterialTable& materials = *wave.materials;
  wave.queue(QueueId::kShadow).size = 0;
  block.num_receivers = 0;
  ListSuffixes(wave);
  if (block.num_suffixes == 0) return;
  KindRange ranges[kNumShadeKinds];
  for (uint32_t k = 0; k < kNumShadeKinds; ++k) {
    KindRange& range = ranges[k] = {block.num_receivers, block.num_receivers, 0};
    if ((kReceivingKinds >> k & 1) == 0) continue;
    if (!wave.run->features.Has(ShadeFeature(static_cast<ShadeKind>(k)))) continue;
    range.valid = ListReceivers(block, materials, k);
    range.end = block.num_receivers;
  }
#define X(name, traits, meaning) \
  PairsIfThere<name##Bsdf, ShadeKind::k##name, Proposal>(wave, ranges);
  LANELIGHT_SHADE_KINDS(X)
#undef X
  wave.lanes.items += block.num_suffixes * block.size;
  wave.lanes.vectors +=
      block.num_suffixes * block.num_receivers / static_cast<uint32_t>(hn::Lanes(DF()));
}

Stage ReusePairsStage() {
  return {.name = "reuse_pairs",
          .meaning = "evaluates second vertices of a block from all first ones",
          .input = QueueId::kScratch,
          .role = StageRole::kBlock,
          .needs = {Feature::kReuse, Feature::kScatters},
          .scope = StageScope::kBlock,
          .resolve = [](const FeatureSet& features) -> StageFn {
            return features.Has(Feature::kUniformDirections)
                       ? ConnectPairs<UniformProposal>
                       : ConnectPairs<MaterialProposal>;
          }};
}

LANELIGHT_END_KERNELS
