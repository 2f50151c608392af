#include "bench/intersect/embree_scene.h"

#include <cstring>

namespace lanelight::bench {

std::string EmbreeConfig(const std::string& target, int threads,
                         const std::string& more) {
  std::string isa;
  if (target == "AVX2") isa = ",isa=avx2";
  if (target == "SSE4" || target == "EMU128") isa = ",isa=sse4.2";
  return "threads=" + std::to_string(threads) + isa + (more.empty() ? "" : "," + more);
}

RTCScene NewEmbreeScene(RTCDevice device, const Mesh& mesh, RTCBuildQuality quality,
                        bool robust) {
  RTCScene scene = rtcNewScene(device);
  rtcSetSceneBuildQuality(scene, quality);
  if (robust) rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
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
  return scene;
}

}  // namespace lanelight::bench
