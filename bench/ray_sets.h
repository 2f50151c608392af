// The ray sets of the intersection benchmark, made with our own kernels: camera rays in
// tile order, rays to the light, first and second diffuse bounces in the same order.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "bench/mesh.h"
#include "kernels/intersect/stages.h"
#include "kernels/surface/stages.h"
#include "tests/wavefront/wave_fixture.h"

namespace lanelight::bench {

struct RaySet {
  std::string name;
  bool shadow = false;
  std::vector<TestRay> rays;
};

inline Geometry ToGeometry(const Mesh& mesh) {
  Geometry g;
  for (const auto& t : mesh.triangles) {
    g.triangles.push_back(
        MakeTriangle(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]));
  }
  return g;
}

class RayMaker {
 public:
  RayMaker(const Mesh& mesh, const CompiledScene& scene) : mesh_(mesh), scene_(scene) {}

  std::vector<RaySet> All(int size) {
    const std::vector<TestRay> camera = Primary(size);
    std::vector<TestRay> shadow, first, second, unused;
    Scatter(camera, &shadow, first);
    Scatter(first, nullptr, second);
    return {{"primary", false, camera},
            {"shadow", true, shadow},
            {"bounce 1", false, first},
            {"bounce 2", false, second}};
  }

 private:
  float Uniform() { return uniform_(engine_); }

  // size x size pixels in tiles of 16 x 16, one jittered sample each.
  std::vector<TestRay> Primary(int size) {
    const Vec3f z = Normalize(mesh_.at - mesh_.eye);
    const Vec3f x = Normalize(Cross(z, mesh_.up)), y = Cross(x, z);
    const float half = std::tan(mesh_.fov * static_cast<float>(M_PI) / 360);
    std::vector<TestRay> rays;
    for (int ty = 0; ty < size; ty += 16) {
      for (int tx = 0; tx < size; tx += 16) {
        for (int i = 0; i < 256; ++i) {
          const float px = tx + i % 16 + Uniform(), py = ty + i / 16 + Uniform();
          const float u = half * (2 * px / size - 1), v = half * (1 - 2 * py / size);
          rays.push_back({mesh_.eye, Normalize(z + u * x + v * y)});
        }
      }
    }
    return rays;
  }

  // Cosine-distributed rays from the hits of `in`, and rays to the light.
  void Scatter(const std::vector<TestRay>& in, std::vector<TestRay>* shadow,
               std::vector<TestRay>& out) {
    constexpr std::size_t kWave = 4096;
    for (std::size_t at = 0; at < in.size(); at += kWave) {
      const std::vector<TestRay> part(in.begin() + at,
                                      in.begin() + std::min(in.size(), at + kWave));
      WaveFixture f(scene_, kWave);
      f.SetRays(part);
      f.Run(IntersectTrianglesStage(), {});
      Queue& hits = f.wave.queue(QueueId::kSurface);
      for (std::uint32_t i = 0; i < part.size(); ++i) {
        if (!std::isinf(f.wave.path.t[i])) hits.items[hits.size++] = i;
      }
      f.Run(SurfaceTriangleStage(), {Feature::kScatters});
      for (std::uint32_t k = 0; k < hits.size; ++k) {
        const std::uint32_t i = hits.items[k];
        Vec3f n = f.Ng(i);
        if (Dot(n, part[i].d) > 0) n = -n;
        const Vec3f p = f.P(i) + n * f.wave.path.p_error[i];
        if (shadow) shadow->push_back(ToLight(p));
        out.push_back({p, Cosine(n)});
      }
    }
  }

  TestRay ToLight(Vec3f p) {
    const Vec3f goal =
        mesh_.light_corner + Uniform() * mesh_.light_u + Uniform() * mesh_.light_v;
    const float distance = Length(goal - p);
    return {p, (goal - p) / distance, 0.999f * distance};
  }

  Vec3f Cosine(Vec3f n) {
    for (;;) {
      const Vec3f v{2 * Uniform() - 1, 2 * Uniform() - 1, 2 * Uniform() - 1};
      const float length = Length(v);
      if (length > 1 || length < 0.01f) continue;
      const Vec3f d = n + v / length;
      if (Length(d) > 1e-3f) return Normalize(d);
    }
  }

  const Mesh& mesh_;
  const CompiledScene& scene_;
  std::mt19937 engine_{1};
  std::uniform_real_distribution<float> uniform_{0, 1};
};

}  // namespace lanelight::bench
