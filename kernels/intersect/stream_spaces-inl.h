// Rays of a stream in the space of the scene and in those of instances.
#if defined(LANELIGHT_INTERSECT_STREAM_SPACES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LANELIGHT_INTERSECT_STREAM_SPACES_INL_H_
#undef LANELIGHT_INTERSECT_STREAM_SPACES_INL_H_
#else
#define LANELIGHT_INTERSECT_STREAM_SPACES_INL_H_
#endif

#include <algorithm>
#include <limits>

#include "kernels/intersect/instance-inl.h"
#include "kernels/intersect/stream_rays-inl.h"
#include "src/compiled/scene.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// What a ray's stack holds under the subtrees of an instance: the way back.
inline constexpr uint32_t kReturnRef = kEmptyRef - 1;
/// What it holds above subtrees that a packet left to it in an instance: the way there.
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
  RaySpaces(const CompiledScene& scene, StreamRays& rays) : scene_(scene), rays_(rays) {}

  /// Moves all rays, which are in the space of the scene, to the tree over instances.
  LANELIGHT_INLINE void BeginTop() {
    const Bvh& top = scene_.accel.top;
    for (uint32_t r = 0; r < rays_.size; r += StreamRays::kLanes) {
      rays_.SetSlabs(rays_.Load3(rays_.o, r), rays_.Load3(rays_.d, r), Splat(top.slack),
                     Splat(top.margin), r);
      CloseNoRays(r);
    }
    std::fill_n(rays_.space, rays_.size, kTopSpace);
    // A triangle may be in several instances.
    std::fill_n(rays_.from, rays_.size, kNoPrimitive);
  }

  /// Moves rays to the spaces of the instances that they are at. What is next stays.
  LANELIGHT_INLINE void Enter(const int32_t* list, uint32_t count) {
    for (uint32_t i = 0; i < count; i += StreamRays::kLanes) {
      EnterVector(list + i, std::min(count - i, StreamRays::kLanes));
    }
  }

  /// Keeps the ray's columns in the tree over instances, where it is, for its way back.
  LANELIGHT_INLINE void KeepHome(uint32_t r) {
    Home& home = home_[r];
    Copy([&](int k, float* column) HWY_ATTR { home.ray[k] = column[r]; });
  }

  /// Moves a ray back to the tree over instances. Its columns stay those of the instance
  /// unless a node is next: another instance has its own, which it makes of what was
  /// kept.
  LANELIGHT_INLINE void Leave(uint32_t r, uint32_t next) {
    rays_.space[r] = kTopSpace;
    if (next & kLeafBit) return;
    const Home& home = home_[r];
    Copy([&](int k, float* column) HWY_ATTR { column[r] = home.ray[k]; });
  }

  /// The ray, which lies in the space of the scene, in the one where it is.
  LANELIGHT_INLINE void Map(uint32_t r, float o[3], float d[3]) const {
    if (rays_.space[r] >= kTopSpace) return;
    const Rays own =
        MapRays(scene_.geometry.instances[rays_.space[r]], Splat3(o[0], o[1], o[2]),
                Splat3(d[0], d[1], d[2]), Splat(0));
    const VF from[6] = {own.o.x, own.o.y, own.o.z, own.d.x, own.d.y, own.d.z};
    for (int a = 0; a < 3; ++a)
      o[a] = hn::GetLane(from[a]), d[a] = hn::GetLane(from[3 + a]);
  }

 private:
  static constexpr int kWords = 13;
  struct Home {
    float ray[kWords];  // as Copy goes through the columns
  };

  // Calls f(k, column) for each column of node tests.
  template <class F>
  LANELIGHT_INLINE void Copy(F&& f) {
    int k = 0;
    const auto three = [&](auto(&columns)[3][StreamRays::kRoom]) HWY_ATTR {
      for (auto& column : columns) f(k++, reinterpret_cast<float*>(column));
    };
    three(rays_.rcp);
    three(rays_.near);
    three(rays_.far);
    three(rays_.lower);
    f(k, reinterpret_cast<float*>(rays_.octant));
  }

  // What Min and Max make of NaN differs between targets: such rays enter nothing.
  LANELIGHT_INLINE void CloseNoRays(uint32_t at) {
    const DF df;
    const VF sum = hn::Add(
        hn::LoadU(df, rays_.near[0] + at),
        hn::Add(hn::LoadU(df, rays_.near[1] + at), hn::LoadU(df, rays_.near[2] + at)));
    const MF ray = hn::IsFinite(sum);
    if (HWY_LIKELY(hn::AllTrue(df, ray))) return;
    const VF never = Splat(std::numeric_limits<float>::infinity());
    const auto set = [&](float* column, VF v) HWY_ATTR {
      hn::StoreU(hn::IfThenElse(ray, hn::LoadU(df, column), v), df, column);
    };
    for (int a = 0; a < 3; ++a) {
      set(rays_.rcp[a] + at, Splat(1.0f));
      set(rays_.near[a] + at, never);
      set(rays_.far[a] + at, hn::Neg(never));
    }
  }

  // The columns behind the last ray are the place where a vector is prepared.
  HWY_NOINLINE void EnterVector(const int32_t* list, uint32_t count) {
    const DF df;
    const Geometry& geometry = scene_.geometry;
    const Accel& accel = scene_.accel;
    HWY_ALIGN float map[12][StreamRays::kLanes] = {}, ray[6][StreamRays::kLanes] = {};
    HWY_ALIGN float slack[StreamRays::kLanes] = {}, margin[StreamRays::kLanes] = {},
                    reach[StreamRays::kLanes] = {};
    for (uint32_t j = 0; j < count; ++j) {
      const auto r = static_cast<uint32_t>(list[j]);
      const uint32_t instance = static_cast<uint32_t>(rays_.next[r]) & kRefIndex;
      const Bvh& group = accel.groups[geometry.instance_group[instance]];
      const float* m = geometry.instances[instance].object_from_scene;
      for (int k = 0; k < 12; ++k) map[k][j] = m[k];
      for (int a = 0; a < 3; ++a)
        ray[a][j] = rays_.o[a][r], ray[3 + a][j] = rays_.d[a][r];
      slack[j] = group.slack;
      margin[j] = group.margin;
      reach[j] = group.reach;
      rays_.space[r] = instance;
    }
    VF m[12];
    for (int k = 0; k < 12; ++k) m[k] = hn::Load(df, map[k]);
    const auto load = [&](int k) HWY_ATTR {
      return V3{hn::Load(df, ray[k]), hn::Load(df, ray[k + 1]), hn::Load(df, ray[k + 2])};
    };
    const uint32_t at = rays_.size;
    const Rays moved{MapLanes(m, load(0), true), MapLanes(m, load(3), false), Splat(0),
                     FromNone()};
    rays_.SetSlabs(moved.o, moved.d, hn::Load(df, slack), hn::Load(df, margin), at);
    CloseNoRays(at);
    rays_.SetShear(moved, hn::Load(df, reach), at);
    for (uint32_t j = 0; j < count; ++j) {
      const auto r = static_cast<uint32_t>(list[j]);
      Copy([&](int, float* column) HWY_ATTR { column[r] = column[at + j]; });
      for (int a = 0; a < 3; ++a) {
        rays_.shear_o[a][r] = rays_.shear_o[a][at + j];
        rays_.shear_s[a][r] = rays_.shear_s[a][at + j];
        rays_.row[a][r] = rays_.row[a][at + j];
      }
      rays_.t_scale[r] = rays_.t_scale[at + j];
    }
  }

  const CompiledScene& scene_;
  StreamRays& rays_;
  Home home_[StreamRays::kRoom];
};

/// Scenes without instances have one space.
struct NoSpaces {
  NoSpaces(const CompiledScene&, const StreamRays&) {}
};

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#endif
