// Closest hit on curves, and shadow rays against them.
#include "kernels/simd/each_target-inl.h"

#include <cmath>

#include "hwy/cache_control.h"

#include "kernels/intersect/curve_space-inl.h"
#include "kernels/intersect/rays-inl.h"
#include "src/scene/geometry/accel.h"
#include "src/scene/geometry/geometry.h"
#include "src/vocabulary/path/scene_kinds.h"
#include "src/vocabulary/path/wave.h"

LANELIGHT_BEGIN_KERNELS

struct CurveHit {
  float t;
  uint32_t prim;
  float u = 0;
  bool found = false;
};

struct PiecePlace {
  uint32_t curve, part;
  float u;
};

HWY_INLINE float AlongCurve(const PiecePlace& at) {
  const int depth = static_cast<int>(at.part >> 24);
  const float pieces = static_cast<float>(1u << depth);
  return (static_cast<float>(at.part & 0xffffffu) + at.u) / pieces;
}

// Ribbons are narrower where they are turned away from the ray.
HWY_INLINE bool MeetsRibbon(const Geometry& geometry, const PiecePlace& at,
                            const float d[3], float fraction) {
  if (geometry.ribbons.empty()) return true;
  if (geometry.curves[at.curve].type != static_cast<uint32_t>(CurveType::kRibbon)) {
    return true;
  }
  float n[3], own[3] = {d[0], d[1], d[2]};
  RibbonNormal(geometry.ribbons[at.curve], AlongCurve(at), n);
  if (!geometry.curve_spaces.empty()) {
    InCurveSpace(geometry.curve_spaces[at.curve], d, own);
  }
  const float cosine = n[0] * own[0] + n[1] * own[1] + n[2] * own[2];
  return fraction <= cosine * cosine;
}

// Prefetches nodes and leaves: BVHs of hair are larger than caches.
struct FetchAhead {
  const WideNode* nodes;
  const CurveBlock* blocks;

  HWY_INLINE void operator()(uint32_t ref) const {
    if ((ref & kLeafBit) != 0) {
      Fetch(blocks[ref & ~kLeafBit]);
    } else {
      Fetch(nodes[ref]);
    }
  }

 private:
  template <class Value>
  HWY_INLINE static void Fetch(const Value& value) {
    const char* bytes = reinterpret_cast<const char*>(&value);
    for (std::size_t at = 0; at < sizeof(Value); at += kCacheLine) {
      hwy::Prefetch(bytes + at);
    }
  }
};

// Neighbouring pieces of a curve meet in a line that both may claim, at the same
// distance.
template <bool kAny>
HWY_INLINE void TraceCurves(const SceneParts& scene, const float o[3], const float d[3],
                            CurveHit& best) {
  const D8 d8;
  const Geometry& geometry = *scene.geometry;
  const uint32_t first = geometry.ranges.curves;
  const CurveBlock* blocks = scene.accel->curve_blocks.data();
  const CurveRay ray = MakeCurveRay(o, d);
  const auto leaf = [&](uint32_t index) HWY_ATTR {
    const CurveBlock& block = blocks[index];
    for (int i = 0; i < kBvhWidth; i += Lanes8()) {
      const VisiblePieces<V8> seen =
          geometry.curve_spaces.empty()
              ? PiecesAlong(block, i, ray)
              : PiecesInSpaces(CurveMaps(geometry, block), block, i, ray);
      const M8 may = MayMeet(seen, hn::Set(d8, best.t));
      if (hn::AllFalse(d8, may)) continue;
      ForEachNearest(
          seen, may, [&](M8 meets, V8 t_lanes, V8 u_lanes, V8 fractions) HWY_ATTR {
            HWY_ALIGN float t[kBvhWidth], u[kBvhWidth], fraction[kBvhWidth];
            hn::Store(t_lanes, d8, t);
            hn::Store(u_lanes, d8, u);
            hn::Store(fractions, d8, fraction);
            for (uint32_t m = MaskBits(d8, meets); m != 0; m &= m - 1) {
              const int k = std::countr_zero(m);
              const uint32_t prim = block.prim[i + k];
              if (kAny ? !(t[k] < best.t)
                       : !(t[k] < best.t || (t[k] == best.t && prim < best.prim))) {
                continue;
              }
              const PiecePlace at = {prim - first, block.part[i + k], u[k]};
              if (!MeetsRibbon(geometry, at, d, fraction[k])) continue;
              best.found = true;
              if (kAny) return;
              best.t = t[k];
              best.prim = prim;
              best.u = AlongCurve(at);
            }
          });
    }
    return kAny && best.found;
  };
  const Bvh& tree = scene.accel->curves;
  Traverse(scene.accel->nodes.data(), tree.root, MakeSlabRay(o, d, tree), best.t, leaf,
           FetchAhead{scene.accel->nodes.data(), blocks});
}

template <bool kInstances>
void ClosestCurves(Wave& wave) {
  const PathColumns& path = wave.path;
  ForEachBatch(
      wave, wave.queue(QueueId::kActive), [&](const Slots& slots, MF valid) HWY_ATTR {
        ForEachRay(LoadRays(path, slots), slots, valid,
                   [&](int i, const RayArrays& rays, const float o[3], const float d[3])
                       HWY_ATTR {
                         const uint32_t slot = rays.slot[i];
                         CurveHit hit{rays.t_max[i], path.prim[slot]};
                         TraceCurves<false>(wave, o, d, hit);
                         if (!hit.found) return;
                         path.t[slot] = hit.t;
                         path.prim[slot] = hit.prim;
                         path.b1[slot] = hit.u;
                         if constexpr (kInstances) path.inst[slot] = kWorldInstance;
                       });
      });
}

void ShadowOfCurves(Wave& wave) {
  RemoveOccluded(wave, [&](const Rays& batch, VI slots, MF valid) HWY_ATTR {
    uint32_t blocked = 0;
    ForEachRay(batch, slots, valid,
               [&](int i, const RayArrays& rays, const float o[3], const float d[3])
                   HWY_ATTR {
                     CurveHit hit{rays.t_max[i], 0};
                     TraceCurves<true>(wave, o, d, hit);
                     blocked |= uint32_t{hit.found} << i;
                   });
    return MaskOf(DF(), blocked);
  });
}

Stage IntersectCurvesStage() {
  return {.name = "intersect_curves",
          .meaning = "closest hit on curves",
          .input = QueueId::kActive,
          .role = StageRole::kIntersect,
          .needs = {Feature::kCurves},
          .reads = kClosestRay,
          .writes = {Field::t, Field::prim, Field::b1, Field::inst},
          .resolve =
              ByFeature<Feature::kInstances, ClosestCurves<true>, ClosestCurves<false>>};
}

Stage ShadowCurvesStage() {
  return {.name = "shadow_curves",
          .meaning = "removes shadow rays blocked by curves",
          .input = QueueId::kShadow,
          .role = StageRole::kShadow,
          .needs = {Feature::kCurves, Feature::kLights, Feature::kOpaqueShadows},
          .reads = kShadowRay,
          .resolve = Always<ShadowOfCurves>};
}

LANELIGHT_END_KERNELS
