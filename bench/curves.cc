// Rays among the curves of a scene, beside Embree's flat Bezier curves.
//
//   bench_curves SCENE [rays] [rounds]
//
// The rays are those of a render of one thread, 4 samples a pixel: what stands in the
// queues before the stages of curves, in the order in which they are traced. Both take
// them in turns, wave by wave; processor time, median of the rounds. Embree has one ray a
// call, and 16 rays a call, quality high, its own tessellation rate (4).
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "bench/recorded_rays.h"
#include "src/base/core/error.h"

namespace lanelight::bench {
namespace {

RTCScene EmbreeCurves(RTCDevice device, const Geometry& geometry) {
  RTCScene scene = rtcNewScene(device);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
  RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_FLAT_BEZIER_CURVE);
  const std::size_t n = geometry.curves.size();
  auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(
      g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 16, 4 * n));
  auto* first = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, 4, n));
  for (std::size_t i = 0; i < n; ++i) {
    const CurveRecord& curve = geometry.curves[i];
    first[i] = static_cast<unsigned>(4 * i);
    for (int k = 0; k < 4; ++k, points += 4) {
      std::copy(curve.p[k], curve.p[k] + 3, points);
      const float fraction = static_cast<float>(k) / 3;
      points[3] = 0.5f * ((1 - fraction) * curve.width[0] + fraction * curve.width[1]);
    }
  }
  rtcCommitGeometry(g);
  rtcAttachGeometry(scene, g);
  rtcReleaseGeometry(g);
  rtcCommitScene(scene);
  return scene;
}

void RunCurveBench(const std::string& path, int rounds) {
  const Job job = RecordJob(path, "curves");
  const Geometry& geometry = job.scene.compiled->geometry;
  if (geometry.curves.empty()) throw InputError(path + ": no curves");
  fmt::print("{} curves, {:.1f} bytes of trees for each\n", geometry.curves.size(),
             static_cast<double>(job.scene.compiled->accel.Bytes()) /
                 static_cast<double>(geometry.curves.size()));
  RTCDevice device = rtcNewDevice("threads=1");
  RTCScene peer = EmbreeCurves(device, geometry);
  MeasureAll(*job.scene.compiled, peer, rounds);
  rtcReleaseScene(peer);
  rtcReleaseDevice(device);
}

}  // namespace
}  // namespace lanelight::bench

int main(int argc, char** argv) {
  return lanelight::bench::RunRecorded(argc, argv, "bench_curves",
                                       lanelight::bench::RunCurveBench);
}
