#include "bench/intersect/ray_sets.h"

#include <algorithm>
#include <random>

#include "kernels/stages.h"

namespace lanelight::bench {
namespace {

/// A hit: a point just outside the surface, the normal on the ray's side, the ray's
/// direction, the triangle, and the ray's number.
struct Vertex {
  Vec3f p, n, d;
  std::uint32_t prim;
  std::size_t ray;
};

std::vector<Vertex> FindHits(const CompiledScene& scene,
                             const std::vector<TestRay>& rays) {
  constexpr std::size_t kWave = 4096;
  std::vector<Vertex> out;
  WaveFixture f(scene, kWave);
  for (std::size_t at = 0; at < rays.size(); at += kWave) {
    const std::vector<TestRay> part(rays.begin() + at,
                                    rays.begin() + std::min(rays.size(), at + kWave));
    f.SetRays(part);
    f.Run(IntersectTrianglesStage, {});
    Queue& hits = f.wave.queue(QueueId::kSurface);
    hits.size = 0;
    for (std::uint32_t i = 0; i < part.size(); ++i) {
      if (!std::isinf(f.wave.path.t[i])) hits.items[hits.size++] = i;
    }
    f.Run(SurfaceTriangleStage, {Feature::kScatters});
    for (std::uint32_t k = 0; k < hits.size; ++k) {
      const std::uint32_t i = hits.items[k];
      Vec3f n = f.Ng(i);
      if (Dot(n, part[i].d) > 0) n = -n;
      out.push_back({f.P(i) + n * f.wave.path.p_error[i], n, part[i].d,
                     f.wave.path.prim[i], at + i});
    }
  }
  return out;
}

class RayMaker {
 public:
  explicit RayMaker(const Mesh& mesh) : mesh_(mesh) {}

  std::vector<TestRay> Primary(int size) {
    std::vector<TestRay> rays;
    for (int ty = 0; ty < size; ty += 16) {
      for (int tx = 0; tx < size; tx += 16) {
        for (int block = 0; block < 16; ++block) {
          const int bx = tx + 4 * (block % 4), by = ty + 4 * (block / 4);
          for (int i = 0; i < 16; ++i) {
            rays.push_back(Camera(float(bx + i % 4), float(by + i / 4), float(size)));
          }
        }
      }
    }
    return rays;
  }

  TestRay ToLight(const Vertex& from) {
    const float u = Uniform(), v = Uniform();
    return To(mesh_.light_corner + u * mesh_.light_u + v * mesh_.light_v, from);
  }

  static TestRay To(Vec3f goal, const Vertex& from) {
    const float distance = Length(goal - from.p);
    // A ray into the surface meets it first.
    const bool leaves = Dot(goal - from.p, from.n) > 0;
    return {from.p, (goal - from.p) / distance, 0.999f * distance,
            leaves ? from.prim : kNoPrimitive};
  }

  TestRay Diffuse(const Vertex& from) {
    for (;;) {
      const float x = Uniform(), y = Uniform(), z = Uniform();
      const Vec3f v{2 * x - 1, 2 * y - 1, 2 * z - 1};
      const float length = Length(v);
      if (length > 1 || length < 0.01f) continue;
      const Vec3f d = from.n + v / length;
      if (Length(d) > 1e-3f) return {from.p, Normalize(d), INFINITY, from.prim};
    }
  }

  static TestRay Mirror(const Vertex& from) {
    const Vec3f d = Normalize(from.d - (2 * Dot(from.n, from.d)) * from.n);
    return {from.p, d, INFINITY, from.prim};
  }

 private:
  float Uniform() { return uniform_(engine_); }

  TestRay Camera(float x, float y, float size) {
    const Vec3f forward = Normalize(mesh_.at - mesh_.eye);
    const Vec3f right = Normalize(Cross(forward, mesh_.up));
    const Vec3f up = Cross(right, forward);
    const float half = std::tan(mesh_.fov * static_cast<float>(M_PI) / 360);
    x += Uniform();
    y += Uniform();
    const float u = half * (2 * x / size - 1), v = half * (1 - 2 * y / size);
    return {mesh_.eye, Normalize(forward + u * right + v * up)};
  }

  const Mesh& mesh_;
  std::mt19937 engine_{1};
  std::uniform_real_distribution<float> uniform_{0, 1};
};

template <class Make>
std::vector<TestRay> FromEach(const std::vector<Vertex>& vertices, Make&& make) {
  std::vector<TestRay> rays;
  rays.reserve(vertices.size());
  for (const Vertex& v : vertices) rays.push_back(make(v));
  return rays;
}

// Makes rays as path reuse has them: from the vertices of each 16 rays to one that a ray
// from one of them has found.
std::vector<TestRay> ToCommonPoints(const std::vector<Vertex>& first,
                                    const std::vector<Vertex>& second) {
  constexpr std::size_t kBlock = 16;
  std::vector<TestRay> rays;
  std::size_t next = 0;  // whose block has no goal yet
  for (const Vertex& goal : second) {
    if (goal.ray < next) continue;
    const std::size_t block = goal.ray / kBlock * kBlock;
    next = std::min(block + kBlock, first.size());
    for (std::size_t i = block; i < next; ++i) {
      rays.push_back(RayMaker::To(goal.p, first[i]));
    }
  }
  return rays;
}

}  // namespace

std::vector<RaySet> MakeRaySets(const Mesh& mesh, const CompiledScene& scene, int size) {
  RayMaker maker(mesh);
  const auto diffuse = [&](const Vertex& v) { return maker.Diffuse(v); };
  const auto to_light = [&](const Vertex& v) { return maker.ToLight(v); };
  std::vector<TestRay> camera = maker.Primary(size);
  const std::vector<Vertex> first = FindHits(scene, camera);
  std::vector<TestRay> shadow = FromEach(first, to_light);
  std::vector<TestRay> bounce = FromEach(first, diffuse);
  const std::vector<Vertex> second_hits = FindHits(scene, bounce);
  std::vector<TestRay> second = FromEach(second_hits, diffuse);
  std::vector<TestRay> common = ToCommonPoints(first, second_hits);
  std::vector<TestRay> mirror = FromEach(first, RayMaker::Mirror);
  return {{"primary", false, std::move(camera), {}},
          {"shadow", true, std::move(shadow), {}},
          {"bounce1", false, std::move(bounce), {}},
          {"bounce2", false, std::move(second), {}},
          {"mirror", false, std::move(mirror), {}},
          {"common", true, std::move(common), {}}};
}

RaySet EveryWave(const RaySet& set, std::size_t wave, std::size_t step,
                 std::size_t first) {
  RaySet out{set.name, set.shadow, {}, {}};
  std::size_t index = 0;
  ForEachWave(set, wave, [&](std::size_t begin, std::size_t end) {
    if (index++ % step != first) return;
    out.rays.insert(out.rays.end(), set.rays.begin() + begin, set.rays.begin() + end);
    out.waves.push_back(end - begin);
  });
  return out;
}

std::size_t LargestWave(const RaySet& set, std::size_t wave) {
  std::size_t largest = 0;
  ForEachWave(set, wave, [&](std::size_t begin, std::size_t end) {
    largest = std::max(largest, end - begin);
  });
  return largest;
}

}  // namespace lanelight::bench
