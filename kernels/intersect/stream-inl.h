// A stream of independent rays through the triangle BVH: at the top of the tree vectors
// of rays together (stream_packet-inl.h), below that single rays, interleaved
// (stream_single-inl.h).
#ifndef LANELIGHT_INTERSECT_STREAM_INL_H_
#define LANELIGHT_INTERSECT_STREAM_INL_H_

#include <algorithm>
#include <new>
#include <type_traits>

#include "kernels/intersect/stream_packet-inl.h"
#include "kernels/intersect/stream_single-inl.h"
#include "src/scene/geometry/accel.h"
#include "src/vocabulary/path/wave.h"

LANELIGHT_BEGIN_KERNELS

template <bool kAny, bool kAlpha, bool kInstances>
class RayStream {
 public:
  /// The stream of this thread, empty: one at a time.
  static RayStream& OfThread(const Wave& wave) {
    static_assert(std::is_trivially_destructible_v<RayStream>);
    return *new (ThreadStream(sizeof(RayStream))) RayStream(wave, wave.path.time);
  }

  /// Takes the valid rays of a vector, and hands the stream to done() if it is full.
  template <class Done>
  LANELIGHT_INLINE void Add(const Rays& rays, VI slots, VI prims, MF valid, Done&& done) {
    rays_.Add(rays, slots, prims, static_cast<uint32_t>(hn::CountTrue(DF(), valid)));
    if (!rays_.HasRoom()) done();
  }
  bool empty() const { return rays_.size == 0; }

  /// Traces the rays and writes the hits to the columns.
  LANELIGHT_INLINE void Closest(const PathColumns& path) {
    Trace();
    for (uint32_t r = 0; r < rays_.size; ++r) {
      if (!rays_.found[r]) continue;
      const int32_t slot = rays_.slot[r];
      path.t[slot] = rays_.t[r];
      path.prim[slot] = static_cast<uint32_t>(rays_.prim[r]);
      path.b1[slot] = rays_.b1[r];
      path.b2[slot] = rays_.b2[r];
      if constexpr (kInstances) path.inst[slot] = rays_.inst[r];
    }
    rays_.size = 0;
  }

  /// Traces the rays and appends those that are not blocked to `kept`, in order.
  LANELIGHT_INLINE void KeepOpen(Queue& kept) {
    Trace();
    for (uint32_t r = 0; r < rays_.size; ++r) {
      kept.items[kept.size] = static_cast<uint32_t>(rays_.slot[r]);
      kept.size += !rays_.found[r];
    }
    rays_.size = 0;
  }

 private:
  RayStream(const SceneParts& scene, const float* times)
      : bvh_(scene.accel->groups[0]),
        rays_(std::max(bvh_.depth, kInstances ? scene.accel->top.depth : 0)),
        spaces_(scene, rays_, times),
        packets_(scene, rays_, spaces_),
        singles_(scene, rays_, spaces_) {}

  LANELIGHT_INLINE void Trace() {
    if constexpr (kInstances) {
      std::fill_n(rays_.space, rays_.size, kWorldInstance);
      std::fill_n(rays_.inst, rays_.size, kWorldInstance);
      if (bvh_.root != kEmptyRef) {
        TraceWorld();
      } else {
        std::fill_n(rays_.found, rays_.size, 0);
      }
      TraceTop();
    } else {
      TraceWorld();
    }
  }

  LANELIGHT_INLINE void TraceWorld() {
    singles_.live().size = 0;
    for (uint32_t at = 0; at < rays_.size; at += StreamRays::kLanes) {
      packets_.Run(at, singles_.live());
    }
    singles_.Run();
  }

  LANELIGHT_INLINE void TraceTop() {
    spaces_.BeginTop();
    singles_.live().size = 0;
    for (uint32_t at = 0; at < rays_.size; at += StreamRays::kLanes) {
      packets_.RunTop(at, singles_.live());
    }
    singles_.Run();
  }

  const Bvh& bvh_;
  StreamRays rays_;
  Spaces<kInstances> spaces_;
  PacketPhase<kAny, kAlpha, kInstances> packets_;
  SinglePhase<kAny, kAlpha, kInstances> singles_;
};

LANELIGHT_END_KERNELS

#endif
