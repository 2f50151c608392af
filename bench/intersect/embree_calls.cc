#include "bench/intersect/embree_calls.h"

#include <algorithm>
#include <bit>

namespace lanelight::bench {
namespace {

unsigned WidthOf(EmbreeCall call, std::size_t wave) {
  switch (call) {
    case EmbreeCall::kOne:
    case EmbreeCall::kStreamAos:
      return 1;
    case EmbreeCall::kFour:
      return 4;
    case EmbreeCall::kEight:
      return 8;
    case EmbreeCall::kSixteen:
    case EmbreeCall::kStreamPackets:
      return 16;
    case EmbreeCall::kStreamPointers:
      break;
  }
  return static_cast<unsigned>(wave);
}

// Word k of ray i of a packet in the order of RTCRayN and RTCHitN.
enum Word {
  kOrg = 0,
  kNear = 3,
  kDir = 4,
  kTime = 7,
  kFar = 8,
  kMask = 9,
  kId = 10,
  kFlags = 11,
  kPrim = 17,
  kGeom = 18
};

RTCRayNp RayColumns(float* m, unsigned n) {
  const auto column = [&](int k) { return m + k * n; };
  const auto bits = [&](int k) { return reinterpret_cast<unsigned*>(column(k)); };
  return {column(0), column(1), column(2), column(3), column(4), column(5),
          column(6), column(7), column(8), bits(9),   bits(10),  bits(11)};
}

RTCRayHitNp HitColumns(float* m, unsigned n) {
  const auto column = [&](int k) { return m + k * n; };
  const auto bits = [&](int k) { return reinterpret_cast<unsigned*>(column(k)); };
  RTCRayHitNp out;
  out.ray = RayColumns(m, n);
  out.hit = {column(12), column(13),  column(14),  column(15),
             column(16), bits(kPrim), bits(kGeom), {bits(19)}};
  return out;
}

alignas(64) constexpr int kAll[16] = {-1, -1, -1, -1, -1, -1, -1, -1,
                                      -1, -1, -1, -1, -1, -1, -1, -1};

}  // namespace

EmbreeWave::EmbreeWave(EmbreeCall call, bool shadow, std::size_t capacity)
    : call_(call),
      shadow_(shadow),
      width_(WidthOf(call, (capacity + 15) / 16 * 16)),
      memory_((capacity + width_ - 1) / width_ * width_ * words()) {}

void EmbreeWave::CopyRays(const TestRay* rays, std::size_t count) {
  rays_ = count;
  packets_ = (count + width_ - 1) / width_;
  for (std::size_t i = 0; i < packets_ * width_; ++i) {
    const TestRay& r = rays[std::min(i, count - 1)];  // a last packet is filled up
    float* lane = packet(i / width_) + i % width_;
    const auto word = [&](int k) -> float& { return lane[k * int(width_)]; };
    word(0) = r.o.x, word(1) = r.o.y, word(2) = r.o.z, word(kNear) = 0;
    word(4) = r.d.x, word(5) = r.d.y, word(6) = r.d.z, word(kTime) = r.time;
    word(kFar) = r.t_max, word(kMask) = std::bit_cast<float>(~0u);
    word(kId) = 0, word(kFlags) = 0;
    if (!shadow_) word(kGeom) = std::bit_cast<float>(RTC_INVALID_GEOMETRY_ID);
  }
}

void EmbreeWave::TracePackets(RTCScene scene, RTCIntersectContext* context) {
  for (std::size_t i = 0; i < packets_; ++i) {
    void* p = packet(i);
    switch (width_) {
      case 1:
        shadow_ ? rtcOccluded1(scene, context, static_cast<RTCRay*>(p))
                : rtcIntersect1(scene, context, static_cast<RTCRayHit*>(p));
        break;
      case 4:
        shadow_ ? rtcOccluded4(kAll, scene, context, static_cast<RTCRay4*>(p))
                : rtcIntersect4(kAll, scene, context, static_cast<RTCRayHit4*>(p));
        break;
      case 8:
        shadow_ ? rtcOccluded8(kAll, scene, context, static_cast<RTCRay8*>(p))
                : rtcIntersect8(kAll, scene, context, static_cast<RTCRayHit8*>(p));
        break;
      default:
        shadow_ ? rtcOccluded16(kAll, scene, context, static_cast<RTCRay16*>(p))
                : rtcIntersect16(kAll, scene, context, static_cast<RTCRayHit16*>(p));
    }
  }
}

// One call for the wave.
void EmbreeWave::TraceStream(RTCScene scene, RTCIntersectContext* context) {
  float* m = memory_.data();
  const auto count = static_cast<unsigned>(rays_);
  const auto packets = static_cast<unsigned>(packets_);
  const std::size_t stride = words() * width_ * sizeof(float);
  if (call_ == EmbreeCall::kStreamAos && shadow_) {
    rtcOccluded1M(scene, context, reinterpret_cast<RTCRay*>(m), count, stride);
  } else if (call_ == EmbreeCall::kStreamAos) {
    rtcIntersect1M(scene, context, reinterpret_cast<RTCRayHit*>(m), count, stride);
  } else if (call_ == EmbreeCall::kStreamPackets && shadow_) {
    rtcOccludedNM(scene, context, reinterpret_cast<RTCRayN*>(m), width_, packets, stride);
  } else if (call_ == EmbreeCall::kStreamPackets) {
    rtcIntersectNM(scene, context, reinterpret_cast<RTCRayHitN*>(m), width_, packets,
                   stride);
  } else if (shadow_) {
    const RTCRayNp columns = RayColumns(m, width_);
    rtcOccludedNp(scene, context, &columns, count);
  } else {
    const RTCRayHitNp columns = HitColumns(m, width_);
    rtcIntersectNp(scene, context, &columns, count);
  }
}

void EmbreeWave::Trace(RTCScene scene, bool coherent) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  if (coherent) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  switch (call_) {
    case EmbreeCall::kOne:
    case EmbreeCall::kFour:
    case EmbreeCall::kEight:
    case EmbreeCall::kSixteen:
      return TracePackets(scene, &context);
    default:
      return TraceStream(scene, &context);
  }
}

void EmbreeWave::Unpack(BenchHit* hits) const {
  for (std::size_t i = 0; i < rays_; ++i) {
    const float* lane = memory_.data() + i / width_ * words() * width_ + i % width_;
    const float far = lane[kFar * width_];
    if (shadow_) {
      hits[i] = {far < 0 ? 0 : INFINITY, 0};  // Embree marks blocked rays with -inf
      continue;
    }
    const auto geometry = std::bit_cast<unsigned>(lane[kGeom * width_]);
    hits[i] = {geometry == RTC_INVALID_GEOMETRY_ID ? INFINITY : far,
               std::bit_cast<std::uint32_t>(lane[kPrim * width_])};
  }
}

}  // namespace lanelight::bench
