// Rays among instances that move, beside Embree's.
//
//   bench_moving SCENE [rays] [rounds]
//
// The rays are those of a render of one thread, 4 samples a pixel, with the times of
// their paths. Embree has the triangles of each object in a scene of their own, instances
// with two times where they move (a quaternion between them), quality high.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "bench/recorded_rays.h"
#include "src/base/core/error.h"

namespace lanelight::bench {
namespace {

RTCScene TrianglesOf(RTCDevice device, const Geometry& geometry, std::size_t group) {
  const auto [begin, end] = geometry.groups[group];
  const std::size_t n = end - begin;
  RTCScene scene = rtcNewScene(device);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
  if (n == 0) return scene;
  RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(
      g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, 3 * n));
  auto* corners = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, n));
  for (std::size_t i = 0; i < n; ++i) {
    std::memcpy(points + 9 * i, geometry.triangles[begin + i].p, 9 * sizeof(float));
    for (unsigned k = 0; k < 3; ++k)
      corners[3 * i + k] = static_cast<unsigned>(3 * i) + k;
  }
  rtcCommitGeometry(g);
  rtcAttachGeometry(scene, g);
  rtcReleaseGeometry(g);
  rtcCommitScene(scene);
  return scene;
}

// Of a rotation, by its largest component (w x y z).
std::array<double, 4> QuaternionOf(const Transform& r) {
  const double x = r(0, 0), y = r(1, 1), z = r(2, 2);
  const double squares[4] = {1 + x + y + z, 1 + x - y - z, 1 - x + y - z, 1 - x - y + z};
  const auto largest = std::max_element(squares, squares + 4) - squares;
  const double wx = r(2, 1) - r(1, 2), wy = r(0, 2) - r(2, 0), wz = r(1, 0) - r(0, 1);
  const double xy = r(0, 1) + r(1, 0), yz = r(1, 2) + r(2, 1), zx = r(2, 0) + r(0, 2);
  const double products[4][4] = {{squares[0], wx, wy, wz},
                                 {wx, squares[1], xy, zx},
                                 {wy, xy, squares[2], yz},
                                 {wz, zx, yz, squares[3]}};
  std::array<double, 4> q;
  const double scale = 1 / (2 * std::sqrt(squares[largest]));
  for (std::size_t k = 0; k < 4; ++k) q[k] = products[largest][k] * scale;
  return q;
}

// A motion whose ends are turned and evenly scaled, which Embree interpolates alike.
RTCQuaternionDecomposition DecompositionOf(const Motion& motion, double s) {
  const Transform t = motion.At(s);
  const double scale = std::cbrt(t.Determinant3());
  const auto f = [](double v) { return static_cast<float>(v); };
  RTCQuaternionDecomposition q;
  rtcInitQuaternionDecomposition(&q);
  rtcQuaternionDecompositionSetScale(&q, f(scale), f(scale), f(scale));
  rtcQuaternionDecompositionSetTranslation(&q, f(t(0, 3)), f(t(1, 3)), f(t(2, 3)));
  const auto [w, x, y, z] =
      QuaternionOf(t * Transform::Scale({1 / scale, 1 / scale, 1 / scale}));
  rtcQuaternionDecompositionSetQuaternion(&q, f(w), f(x), f(y), f(z));
  return q;
}

RTCScene EmbreeInstances(RTCDevice device, const Geometry& geometry) {
  std::vector<RTCScene> groups;
  for (std::size_t i = 0; i < geometry.groups.size(); ++i) {
    groups.push_back(TrianglesOf(device, geometry, i));
  }
  RTCScene top = rtcNewScene(device);
  rtcSetSceneBuildQuality(top, RTC_BUILD_QUALITY_HIGH);
  const auto attach = [&](RTCGeometry g) {
    rtcCommitGeometry(g);
    rtcAttachGeometry(top, g);
    rtcReleaseGeometry(g);
  };
  const auto instance_of = [&](std::size_t group, unsigned times) {
    RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(g, groups[group]);
    rtcSetGeometryTimeStepCount(g, times);
    return g;
  };
  if (geometry.groups[0].end > geometry.groups[0].begin) attach(instance_of(0, 1));
  for (std::size_t i = 0; i < geometry.instances.size(); ++i) {
    const bool moves = i < geometry.motions.size();
    RTCGeometry g = instance_of(geometry.instance_group[i], moves ? 2 : 1);
    if (moves) {
      const Motion motion = MotionOf(geometry.motions[i]);
      for (const unsigned time : {0u, 1u}) {
        const auto q = DecompositionOf(motion, time);
        rtcSetGeometryTransformQuaternion(g, time, &q);
      }
    } else {
      rtcSetGeometryTransform(g, 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR,
                              geometry.instances[i].scene_from_object);
    }
    attach(g);
  }
  rtcCommitScene(top);
  return top;
}

void RunMovingBench(const std::string& path, int rounds) {
  const Job job = RecordJob(path, "triangles");
  const Geometry& geometry = job.scene.compiled->geometry;
  if (geometry.instances.empty()) throw InputError(path + ": no instances");
  fmt::print("{} instances, {} of them move\n", geometry.instances.size(),
             geometry.motions.size());
  RTCDevice device = rtcNewDevice("threads=1");
  RTCScene peer = EmbreeInstances(device, geometry);
  MeasureAll(*job.scene.compiled, peer, rounds);
  rtcReleaseScene(peer);
  rtcReleaseDevice(device);
}

}  // namespace
}  // namespace lanelight::bench

int main(int argc, char** argv) {
  return lanelight::bench::RunRecorded(argc, argv, "bench_moving",
                                       lanelight::bench::RunMovingBench);
}
