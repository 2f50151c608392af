// Rays of a stream in the space of the scene and in those of instances.
#ifndef LANELIGHT_INTERSECT_STREAM_SPACES_INL_H_
#define LANELIGHT_INTERSECT_STREAM_SPACES_INL_H_

#include <algorithm>
#include <bit>
#include <cstring>
#include <type_traits>

#include "kernels/intersect/instance-inl.h"
#include "kernels/intersect/stream_rays-inl.h"
#include "src/scene/geometry/accel.h"
#include "src/scene/geometry/geometry.h"
#include "src/vocabulary/path/scene_parts.h"

LANELIGHT_BEGIN_KERNELS

/// The entry below the subtrees of an instance on a ray's stack: the way back.
inline constexpr uint32_t kReturnRef = kEmptyRef - 1;
/// The entry above subtrees that a packet deferred in an instance: the way into it.
LANELIGHT_INLINE constexpr uint32_t ResumeRef(uint32_t instance) {
  return kLeafBit | kSeparateBit | instance;
}
LANELIGHT_INLINE constexpr bool IsResume(uint32_t ref) {
  return ref >= ResumeRef(0) && ref < kReturnRef;
}
/// `space` of a ray in the tree over instances.
inline constexpr uint32_t kTopSpace = kWorldInstance - 1;

/// Moves rays from one space to another. In a space a ray's slabs and shear are those of
/// that space; o and d stay those of the scene's, and t is the same in all of them.
class RaySpaces {
 public:
  /// `times` has those of paths by their slots, if instances move.
  RaySpaces(const SceneParts& scene, StreamRays& rays, const float* times)
      : scene_(scene),
        rays_(rays),
        times_(scene.geometry->motions.empty() ? nullptr : times) {}

  /// Moves all rays, which are in the space of the scene, to the tree over instances.
  LANELIGHT_INLINE void BeginTop() { std::fill_n(rays_.space, rays_.size, kTopSpace); }

  /// Prepares the vector of rays at `at`, which are there, for steps of single rays, and
  /// keeps what they need for the ways into instances and back.
  LANELIGHT_INLINE void Prepare(const Rays& rays, const PacketSlabs& slabs, uint32_t at) {
    const DF df;
    const VF octant = hn::BitCast(df, slabs.octant);
    rays_.SetSlabs(slabs, at);
    for (int a = 0; a < 3; ++a) {
      std::copy_n(rays_.slab[a] + at, StreamRays::kLanes, top_level_.slab[a] + at);
    }
    StoreFours(rays.o.x, rays.o.y, rays.o.z, octant, top_level_.o + at);
    StoreFours(rays.d.x, rays.d.y, rays.d.z, hn::Zero(df), top_level_.d + at);
  }

  /// Moves rays to the spaces of the instances that they are at. What is next stays.
  LANELIGHT_INLINE void Enter(const int32_t* list, uint32_t count) {
    for (uint32_t i = 0; i < count; i += StreamRays::kLanes) {
      const uint32_t some = std::min(count - i, StreamRays::kLanes);
      HasMotion() ? EnterVector<true>(list + i, some)
                  : EnterVector<false>(list + i, some);
    }
  }

  /// Moves a ray back to the tree over instances.
  LANELIGHT_INLINE void Leave(uint32_t r) {
    rays_.space[r] = kTopSpace;
    for (int a = 0; a < 3; ++a) rays_.slab[a][r] = top_level_.slab[a][r];
    rays_.octant[r] = std::bit_cast<uint32_t>(top_level_.o[r].octant);
  }

  /// Returns whether some instances move.
  LANELIGHT_INLINE bool HasMotion() const { return HWY_UNLIKELY(times_ != nullptr); }

  /// The rays from place `at` on, which lie in the space of the scene, in that of an
  /// instance. kMoving: as HasMotion.
  template <bool kMoving>
  LANELIGHT_INLINE Rays Mapped(uint32_t instance, uint32_t at) const {
    if constexpr (kMoving) return MappedByTime(instance, at);
    const Rays from = rays_.Load(at);
    return MapRays(scene_.geometry->instances[instance], from.o, from.d, from.t_max);
  }

  /// Maps a ray of the scene to the space where it is.
  LANELIGHT_INLINE void Map(uint32_t r, float o[3], float d[3]) const {
    const uint32_t space = rays_.space[r];
    if (space >= kTopSpace) return;
    const Rays own =
        HasMotion() ? MappedByTime(space, r)
                    : MapRays(scene_.geometry->instances[space], Splat3(o[0], o[1], o[2]),
                              Splat3(d[0], d[1], d[2]), Splat(0));
    const VF from[6] = {own.o.x, own.o.y, own.o.z, own.d.x, own.d.y, own.d.z};
    for (int a = 0; a < 3; ++a)
      o[a] = hn::GetLane(from[a]), d[a] = hn::GetLane(from[3 + a]);
  }

 private:
  // Maps the rays into an instance that moves.
  HWY_NOINLINE Rays MappedByTime(uint32_t instance, uint32_t at) const {
    const Geometry& geometry = *scene_.geometry;
    const Rays from = rays_.Load(at);
    if (instance < geometry.motions.size()) {
      return MapMovingRays(geometry.motions[instance], from, TimesAt(at));
    }
    return MapRays(geometry.instances[instance], from.o, from.d, from.t_max);
  }

  // Times of the rays from place `at` on; behind the last one its own again.
  HWY_NOINLINE VF TimesAt(uint32_t at) const {
    HWY_ALIGN float times[StreamRays::kLanes];
    for (uint32_t j = 0; j < StreamRays::kLanes; ++j) {
      times[j] = times_[rays_.slot[std::min(at + j, rays_.size - 1)]];
    }
    return hn::Load(DF(), times);
  }

  // Four numbers of each ray of a vector, ray by ray.
  struct Fours {
    HWY_ALIGN float lane[StreamRays::kLanes][4];

    LANELIGHT_INLINE void Set(uint32_t i, const void* from) {
      std::memcpy(lane[i], from, sizeof lane[i]);
    }
    LANELIGHT_INLINE void Load(VF& a, VF& b, VF& c, VF& e) const {
      hn::LoadInterleaved4(DF(), lane[0], a, b, c, e);
    }
  };

  // kMoving: some instances move.
  template <bool kMoving>
  HWY_NOINLINE void EnterVector(const int32_t* list, uint32_t count) {
    const DF df;
    const Geometry& geometry = *scene_.geometry;
    Fours map[3], o, d, growth;
    for (uint32_t j = 0; j < StreamRays::kLanes; ++j) {
      // Lanes behind the last ray repeat it.
      const auto r = static_cast<uint32_t>(list[std::min(j, count - 1)]);
      const uint32_t instance = static_cast<uint32_t>(rays_.next[r]) & kRefIndex;
      const Bvh& group = scene_.accel->groups[geometry.instance_group[instance]];
      const float* m = geometry.instances[instance].object_from_scene;
      for (int k = 0; k < 3; ++k) map[k].Set(j, m + 4 * k);
      o.Set(j, top_level_.o + r);
      d.Set(j, top_level_.d + r);
      const float growths[4] = {group.slack, group.margin, group.reach, 0};
      growth.Set(j, growths);
      rays_.space[r] = instance;
    }
    VF m[12], slack, margin, reach, unused;
    V3 from_o, from_d;
    for (int k = 0; k < 3; ++k) {
      map[k].Load(m[4 * k], m[4 * k + 1], m[4 * k + 2], m[4 * k + 3]);
    }
    if constexpr (kMoving) MoveMaps(list, count, m);
    o.Load(from_o.x, from_o.y, from_o.z, unused);
    d.Load(from_d.x, from_d.y, from_d.z, unused);
    growth.Load(slack, margin, reach, unused);
    const Rays moved{MapLanes(m, from_o, true), MapLanes(m, from_d, false), hn::Zero(df),
                     FromNone()};
    PacketSlabs slabs(moved.o, moved.d, slack, margin);
    slabs.CloseOthers();
    // The places behind the last ray are where a vector is prepared.
    const uint32_t at = rays_.size;
    const AxisOrder order(moved.d);
    rays_.SetSlabs(slabs, at);
    rays_.SetShear(MakeShear(order, moved, reach), order, moved.from, at);
    for (uint32_t j = 0; j < count; ++j) {
      const auto r = static_cast<uint32_t>(list[j]);
      for (int a = 0; a < 3; ++a) rays_.slab[a][r] = rays_.slab[a][at + j];
      rays_.octant[r] = rays_.octant[at + j];
      rays_.shear_o[r] = rays_.shear_o[at + j];
      rays_.shear_s[r] = rays_.shear_s[at + j];
      rays_.axes[r] = rays_.axes[at + j];
    }
  }

  // The maps of those rays that enter instances that move.
  HWY_NOINLINE void MoveMaps(const int32_t* list, uint32_t count, VF m[12]) const {
    HWY_ALIGN float times[StreamRays::kLanes];
    HWY_ALIGN int32_t instances[StreamRays::kLanes];
    for (uint32_t j = 0; j < StreamRays::kLanes; ++j) {
      const int32_t r = list[std::min(j, count - 1)];
      times[j] = times_[rays_.slot[r]];
      instances[j] = static_cast<int32_t>(rays_.space[r]);
    }
    PutMovingMaps(scene_.geometry->motions, hn::Load(DI(), instances),
                  hn::Load(DF(), times), m);
  }

  const SceneParts& scene_;
  StreamRays& rays_;
  const float* const times_;
  // The rays in the tree over instances, by their places.
  struct TopLevelRays {
    HWY_ALIGN AxisSlab slab[3][StreamRays::kRoom];
    struct Origin {
      float x, y, z, octant;
    } o[StreamRays::kRoom];
    struct Direction {
      float x, y, z, unused;
    } d[StreamRays::kRoom];
  } top_level_;
};

/// Scenes without instances have one space.
struct NoSpaces {
  NoSpaces(const SceneParts&, const StreamRays&, const float*) {}
};
template <bool kInstances>
using Spaces = std::conditional_t<kInstances, RaySpaces, NoSpaces>;

LANELIGHT_END_KERNELS

#endif
