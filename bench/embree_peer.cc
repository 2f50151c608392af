#include "bench/embree_peer.h"

#include <embree3/rtcore.h>
#include <pmmintrin.h>

#include <cstring>

#include "bench/cpu_clock.h"

namespace lanelight::bench {
namespace {

template <typename Packet>
void SetLane(Packet& ray, int k, const TestRay& r) {
  ray.org_x[k] = r.o.x, ray.org_y[k] = r.o.y, ray.org_z[k] = r.o.z;
  ray.dir_x[k] = r.d.x, ray.dir_y[k] = r.d.y, ray.dir_z[k] = r.d.z;
  ray.tnear[k] = 0, ray.tfar[k] = r.t_max, ray.time[k] = 0;
  ray.mask[k] = ~0u, ray.id[k] = 0, ray.flags[k] = 0;
}

RTCRay MakeRay(const TestRay& r) {
  RTCRay ray{};
  ray.org_x = r.o.x, ray.org_y = r.o.y, ray.org_z = r.o.z;
  ray.dir_x = r.d.x, ray.dir_y = r.d.y, ray.dir_z = r.d.z;
  ray.tfar = r.t_max;
  ray.mask = ~0u;
  return ray;
}

RTCScene BuildScene(RTCDevice device, const Mesh& mesh, RTCBuildQuality quality) {
  RTCScene scene = rtcNewScene(device);
  rtcSetSceneBuildQuality(scene, quality);
  RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetGeometryBuildQuality(g, quality);
  void* v = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                    sizeof(Vec3f), mesh.vertices.size());
  std::memcpy(v, mesh.vertices.data(), mesh.vertices.size() * sizeof(Vec3f));
  void* i = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12,
                                    mesh.triangles.size());
  std::memcpy(i, mesh.triangles.data(), mesh.triangles.size() * 12);
  rtcCommitGeometry(g);
  rtcAttachGeometry(scene, g);
  rtcReleaseGeometry(g);
  rtcCommitScene(scene);
  return scene;
}

template <typename RayHitN, typename RayN, int kN>
double TracePackets(RTCScene scene, const std::vector<TestRay>& rays, bool shadow,
                    bool coherent, std::vector<PeerHit>* hits) {
  const std::size_t count = (rays.size() + kN - 1) / kN;
  std::vector<RayHitN> packets(shadow ? 0 : count);
  std::vector<RayN> shadows(shadow ? count : 0);
  for (std::size_t i = 0; i < count * kN; ++i) {
    const TestRay& r = rays[std::min(i, rays.size() - 1)];
    if (shadow) {
      SetLane(shadows[i / kN], i % kN, r);
    } else {
      SetLane(packets[i / kN].ray, i % kN, r);
      packets[i / kN].hit.geomID[i % kN] = RTC_INVALID_GEOMETRY_ID;
    }
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  if (coherent) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  alignas(64) int valid[kN];
  std::fill(valid, valid + kN, -1);
  const CpuTimer timer;
  for (std::size_t i = 0; i < count; ++i) {
    if constexpr (kN == 8) {
      if (shadow) rtcOccluded8(valid, scene, &context, &shadows[i]);
      if (!shadow) rtcIntersect8(valid, scene, &context, &packets[i]);
    } else {
      if (shadow) rtcOccluded16(valid, scene, &context, &shadows[i]);
      if (!shadow) rtcIntersect16(valid, scene, &context, &packets[i]);
    }
  }
  const double seconds = timer.Seconds();
  for (std::size_t i = 0; hits && i < rays.size(); ++i) {
    if (shadow) {
      (*hits)[i] = {shadows[i / kN].tfar[i % kN] < 0 ? 0 : INFINITY, 0};
    } else {
      const auto& p = packets[i / kN];
      const bool hit = p.hit.geomID[i % kN] != RTC_INVALID_GEOMETRY_ID;
      (*hits)[i] = {hit ? p.ray.tfar[i % kN] : INFINITY, p.hit.primID[i % kN]};
    }
  }
  return seconds;
}

double TraceStream(RTCScene scene, const std::vector<TestRay>& rays, bool shadow) {
  std::vector<RTCRayHit> hits(shadow ? 0 : rays.size());
  std::vector<RTCRay> shadows(shadow ? rays.size() : 0);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (shadow) {
      shadows[i] = MakeRay(rays[i]);
    } else {
      hits[i].ray = MakeRay(rays[i]);
      hits[i].hit.geomID = RTC_INVALID_GEOMETRY_ID;
    }
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  constexpr std::size_t kStream = 1024;
  const CpuTimer timer;
  for (std::size_t at = 0; at < rays.size(); at += kStream) {
    const auto n = static_cast<unsigned>(std::min(kStream, rays.size() - at));
    if (shadow) rtcOccluded1M(scene, &context, &shadows[at], n, sizeof(RTCRay));
    if (!shadow) rtcIntersect1M(scene, &context, &hits[at], n, sizeof(RTCRayHit));
  }
  return timer.Seconds();
}

double TraceOne(RTCScene scene, const std::vector<TestRay>& rays, bool shadow,
                std::vector<PeerHit>* hits) {
  std::vector<RTCRayHit> work(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    work[i].ray = MakeRay(rays[i]);
    work[i].hit.geomID = RTC_INVALID_GEOMETRY_ID;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  const CpuTimer timer;
  for (RTCRayHit& r : work) {
    if (shadow) rtcOccluded1(scene, &context, &r.ray);
    if (!shadow) rtcIntersect1(scene, &context, &r);
  }
  const double seconds = timer.Seconds();
  for (std::size_t i = 0; hits && i < rays.size(); ++i) {
    const bool hit = work[i].hit.geomID != RTC_INVALID_GEOMETRY_ID;
    (*hits)[i] = {shadow ? (work[i].ray.tfar < 0 ? 0 : INFINITY)
                  : hit  ? work[i].ray.tfar
                         : INFINITY,
                  work[i].hit.primID};
  }
  return seconds;
}

}  // namespace

struct EmbreePeer::Impl {
  RTCDevice device = rtcNewDevice("threads=1");
  RTCScene high = nullptr, medium = nullptr;
};

EmbreePeer::EmbreePeer(const Mesh& mesh) : impl_(std::make_unique<Impl>()) {
  // As Embree's manual asks for speed.
  _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
  _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
  impl_->high = BuildScene(impl_->device, mesh, RTC_BUILD_QUALITY_HIGH);
  impl_->medium = BuildScene(impl_->device, mesh, RTC_BUILD_QUALITY_MEDIUM);
}
EmbreePeer::~EmbreePeer() {
  rtcReleaseScene(impl_->high);
  rtcReleaseScene(impl_->medium);
  rtcReleaseDevice(impl_->device);
}

std::vector<std::string> EmbreePeer::Modes(bool shadow, bool coherent) const {
  std::vector<std::string> modes;
  for (const std::string quality : {"high", "medium"}) {
    for (const std::string call : {" 1", " 8", " 16", " stream"})
      modes.push_back(quality + call);
    if (coherent && !shadow) modes.push_back(quality + " 16c");
  }
  return modes;
}

double EmbreePeer::Trace(const std::string& mode, bool shadow,
                         const std::vector<TestRay>& rays, std::vector<PeerHit>* hits) {
  RTCScene scene = mode.starts_with("high") ? impl_->high : impl_->medium;
  if (hits) hits->assign(rays.size(), {});
  if (mode.ends_with(" 1")) return TraceOne(scene, rays, shadow, hits);
  if (mode.ends_with(" 8")) {
    return TracePackets<RTCRayHit8, RTCRay8, 8>(scene, rays, shadow, false, hits);
  }
  if (mode.ends_with(" stream")) return TraceStream(scene, rays, shadow);
  return TracePackets<RTCRayHit16, RTCRay16, 16>(scene, rays, shadow,
                                                 mode.ends_with("16c"), hits);
}

}  // namespace lanelight::bench
