#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

#include "bench/intersect/mesh.h"
#include "tests/support/wave_fixture.h"

namespace lanelight::bench {
namespace {

struct Bounds {
  Vec3f lo{INFINITY, INFINITY, INFINITY}, hi{-INFINITY, -INFINITY, -INFINITY};

  void Extend(Vec3f p) {
    lo = Min(lo, p);
    hi = Max(hi, p);
  }
};

void AddQuad(Mesh& mesh, Vec3f a, Vec3f u, Vec3f v) {
  const auto n = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {a, a + u, a + u + v, a + v});
  mesh.triangles.push_back({n, n + 1, n + 2});
  mesh.triangles.push_back({n, n + 2, n + 3});
}

// Upright, turned by `angle` about the vertical.
void AddBlock(Mesh& mesh, Vec3f c, float half, float height, float angle) {
  const Vec3f u = Vec3f{std::cos(angle), 0, std::sin(angle)} * (2 * half);
  const Vec3f w = Vec3f{-std::sin(angle), 0, std::cos(angle)} * (2 * half);
  const Vec3f h = {0, height, 0}, a = c - 0.5f * (u + w);
  AddQuad(mesh, a, u, w), AddQuad(mesh, a + h, u, w), AddQuad(mesh, a, u, h);
  AddQuad(mesh, a + w, u, h), AddQuad(mesh, a, w, h), AddQuad(mesh, a + u, w, h);
}

// Along the axes, from corner to corner.
void AddBox(Mesh& mesh, Vec3f lo, Vec3f hi) {
  const Vec3f e = hi - lo, x{e.x, 0, 0}, y{0, e.y, 0}, z{0, 0, e.z};
  AddQuad(mesh, lo, x, y), AddQuad(mesh, lo, y, z), AddQuad(mesh, lo, z, x);
  AddQuad(mesh, lo + z, x, y), AddQuad(mesh, lo + x, y, z), AddQuad(mesh, lo + y, z, x);
}

}  // namespace

Mesh CornellBox() {
  Mesh mesh;
  mesh.name = "cornell";
  AddQuad(mesh, {-1, 0, -1}, {2, 0, 0}, {0, 0, 2});
  AddQuad(mesh, {-1, 2, -1}, {2, 0, 0}, {0, 0, 2});
  AddQuad(mesh, {-1, 0, -1}, {2, 0, 0}, {0, 2, 0});
  AddQuad(mesh, {-1, 0, -1}, {0, 2, 0}, {0, 0, 2});
  AddQuad(mesh, {1, 0, -1}, {0, 2, 0}, {0, 0, 2});
  AddQuad(mesh, {-0.24f, 1.98f, -0.22f}, {0.47f, 0, 0}, {0, 0, 0.38f});
  AddBlock(mesh, {0.33f, 0, 0.35f}, 0.3f, 0.6f, 0.3f);
  AddBlock(mesh, {-0.33f, 0, -0.3f}, 0.3f, 1.2f, -0.3f);
  mesh.eye = {0, 1, 6.8f};
  mesh.at = {0, 1, 0};
  mesh.fov = 19.5f;
  mesh.light_corner = {-0.24f, 1.97f, -0.22f};
  mesh.light_u = {0.47f, 0, 0};
  mesh.light_v = {0, 0, 0.38f};
  mesh.closed = true;  // as far as a room with an open front is
  return mesh;
}

Mesh Ball(int n) {
  Mesh mesh = CornellBox();
  mesh.triangles.resize(12);
  mesh.name = "ball" + std::to_string(n);
  const int rings = std::max(3, static_cast<int>(std::sqrt(n / 4.0)));
  const int segments = 2 * rings;
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int r = 0; r <= rings; ++r) {
    for (int s = 0; s < segments; ++s) {
      const double theta = M_PI * r / rings, phi = 2 * M_PI * s / segments;
      const double radius = 0.6 + 0.05 * std::sin(7 * theta) * std::cos(5 * phi);
      const double flat = radius * std::sin(theta);
      mesh.vertices.push_back(VecCast<float>(Vec3d{
          flat * std::cos(phi), 0.7 + radius * std::cos(theta), flat * std::sin(phi)}));
    }
  }
  for (int r = 0; r < rings; ++r) {
    for (int s = 0; s < segments; ++s) {
      const auto at = [&](int dr, int ds) {
        return first +
               static_cast<std::uint32_t>((r + dr) * segments + (s + ds) % segments);
      };
      mesh.triangles.push_back({at(0, 0), at(1, 0), at(1, 1)});
      mesh.triangles.push_back({at(0, 0), at(1, 1), at(0, 1)});
    }
  }
  return mesh;
}

void Subdivide(Mesh& mesh) {
  std::unordered_map<std::uint64_t, std::uint32_t> middle;
  middle.reserve(2 * mesh.triangles.size());
  const auto between = [&](std::uint32_t a, std::uint32_t b) {
    const std::uint64_t key = std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
    const auto next = static_cast<std::uint32_t>(mesh.vertices.size());
    const auto [at, is_new] = middle.try_emplace(key, next);
    if (is_new) mesh.vertices.push_back(0.5f * (mesh.vertices[a] + mesh.vertices[b]));
    return at->second;
  };
  std::vector<std::array<std::uint32_t, 3>> finer;
  finer.reserve(4 * mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::uint32_t ab = between(a, b), bc = between(b, c), ca = between(c, a);
    finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  mesh.triangles = std::move(finer);
}

void Enclose(Mesh& mesh) {
  Bounds box;
  for (const Vec3f& v : mesh.vertices) box.Extend(v);
  const Bounds inner = box;
  for (const Vec3f& v : {mesh.eye, mesh.light_corner, mesh.light_corner + mesh.light_u,
                         mesh.light_corner + mesh.light_v}) {
    box.Extend(v);
  }
  const Vec3f room = 0.05f * Length(box.hi - box.lo) * Vec3f{1, 1, 1};
  Vec3f lo = box.lo - room;
  const Vec3f hi = box.hi + room;
  // Not quite in the plane of a flat bottom, so that there are no ties.
  const auto ground = [](float low, float high) { return low - 1e-3f * (high - low); };
  if (mesh.up.y > 0.9f) lo.y = std::min(box.lo.y, ground(inner.lo.y, inner.hi.y));
  if (mesh.up.z > 0.9f) lo.z = std::min(box.lo.z, ground(inner.lo.z, inner.hi.z));
  AddBox(mesh, lo, hi);
  mesh.closed = true;
}

Geometry ToGeometry(const Mesh& mesh) {
  Geometry g;
  g.triangles.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    g.triangles.push_back(
        MakeTriangle(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]));
  }
  return g;
}

Mesh FromScene(const std::string& name, const CompiledScene& scene) {
  Mesh mesh;
  mesh.name = name;
  std::map<std::array<float, 3>, std::uint32_t> known;
  const auto world = scene.geometry.groups.at(0);
  for (std::uint32_t i = world.begin; i < world.end; ++i) {
    std::array<std::uint32_t, 3> corners{};
    for (int k = 0; k < 3; ++k) {
      const float* p = scene.geometry.triangles[i].p[k];
      const auto next = static_cast<std::uint32_t>(mesh.vertices.size());
      const auto [at, is_new] = known.try_emplace({p[0], p[1], p[2]}, next);
      if (is_new) mesh.vertices.push_back({p[0], p[1], p[2]});
      corners[static_cast<std::size_t>(k)] = at->second;
    }
    mesh.triangles.push_back(corners);
  }
  return mesh;
}

}  // namespace lanelight::bench
