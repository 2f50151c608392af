// Curved patches as triangles: where they are, their normals and coordinates.
#include "src/scene/parse/bilinear_patch.h"

#include <catch2/catch.hpp>

#include "tests/scene/parse/parse_text.h"

namespace lanelight {
namespace {

BilinearPatch Saddle(double lift) {
  BilinearPatch patch;
  patch.p = {{{0, 0, 0}, {2, 0, 0.3}, {0.5, 1, 0}, {2, 1.5, lift}}};
  return patch;
}

TriangleMesh MeshOf(const BilinearPatch& patch) {
  TriangleMesh mesh;
  AddPatch(patch, &mesh);
  return mesh;
}

double Size(const BilinearPatch& patch) {
  double size = 0;
  for (const Vec3d& corner : patch.p) size = std::max(size, Length(corner - patch.p[0]));
  return size;
}

// The farthest that the middles of faces and sides are from the patch.
double FarthestOff(const BilinearPatch& patch) {
  const TriangleMesh mesh = MeshOf(patch);
  double maximum = 0;
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    for (const auto& w : {Vec3d{0.5, 0.5, 0}, Vec3d{0, 0.5, 0.5}, Vec3d{0.5, 0, 0.5},
                          Vec3d{1, 1, 1} / 3.0}) {
      Vec3d p;
      double u = 0, v = 0;
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t i = mesh.indices[t + static_cast<std::size_t>(k)];
        p += mesh.positions[i] * w[k];
        u += mesh.uvs[i][0] * w[k];
        v += mesh.uvs[i][1] * w[k];
      }
      maximum = std::max(maximum, Length(p - patch.Point(u, v)));
    }
  }
  return maximum;
}

TEST_CASE("curved patches: tessellated to the tolerance and no finer", "[parse]") {
  int last = 0;
  for (const double lift : {0.31, 0.4, 1.0, 3.0, -20.0}) {
    CAPTURE(lift);
    const BilinearPatch patch = Saddle(lift);
    const double off = FarthestOff(patch) / Size(patch);
    CHECK(off <= kPatchTolerance * (1 + 1e-9));
    CHECK(off >= 0.3 * kPatchTolerance);
    CHECK(PatchSteps(patch) >= last);
    last = PatchSteps(patch);
  }
  CHECK(last > 20);
}

TEST_CASE("curved patches: vertices have the surface's normals", "[parse]") {
  const BilinearPatch patch = Saddle(1.5);
  const TriangleMesh mesh = MeshOf(patch);
  REQUIRE(mesh.normals.size() == mesh.positions.size());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const auto [u, v] = mesh.uvs[i];
    CHECK(Length(mesh.positions[i] - patch.Point(u, v)) < 1e-14);
    // Differences are exact where a function is linear in what changes.
    const Vec3d du = patch.Point(u + 0.5, v) - patch.Point(u - 0.5, v);
    const Vec3d dv = patch.Point(u, v + 0.5) - patch.Point(u, v - 0.5);
    CHECK(Length(mesh.normals[i] - Normalize(Cross(du, dv))) < 1e-12);
  }
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    const Vec3d a = mesh.positions[mesh.indices[t]];
    const Vec3d face = Cross(mesh.positions[mesh.indices[t + 1]] - a,
                             mesh.positions[mesh.indices[t + 2]] - a);
    CHECK(Dot(face, mesh.normals[mesh.indices[t]]) > 0);
  }
}

TEST_CASE("curved patches: given normals and coordinates are bilinear", "[parse]") {
  BilinearPatch patch = Saddle(1);
  patch.n = {{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}}};
  patch.uv = {{{0, 0}, {2, 0}, {0, 3}, {2, 3}}};
  const TriangleMesh mesh = MeshOf(patch);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const double u = mesh.uvs[i][0] / 2, v = mesh.uvs[i][1] / 3;
    CHECK(Length(mesh.positions[i] - patch.Point(u, v)) < 1e-14);
    CHECK(Length(mesh.normals[i] - Normalize(Vec3d{u, v, 1})) < 1e-14);
  }
}

TEST_CASE("flat patches: four different normals are interpolated bilinearly", "[parse]") {
  BilinearPatch patch;
  patch.p = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}};
  patch.n = {{{-0.2, 0, 1}, {0.2, 0, 1}, {0, 0.3, 1}, {0, -0.3, 1}}};
  const TriangleMesh mesh = MeshOf(patch);
  CHECK(mesh.rotates_tangents);
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    Vec3d p, n;  // in the middle of each triangle, as kernels interpolate
    for (std::size_t k = 0; k < 3; ++k) {
      p += mesh.positions[mesh.indices[t + k]] / 3;
      n += mesh.normals[mesh.indices[t + k]] / 3;
    }
    const double u = p.x, v = p.y;
    const Vec3d exact = {-0.2 * (1 - u) * (1 - v) + 0.2 * u * (1 - v),
                         0.3 * (1 - u) * v - 0.3 * u * v, 1};
    CHECK(Length(Normalize(n) - Normalize(exact)) < kNormalTolerance);
  }
  // Two triangles have the normals of those that change evenly.
  patch.n = {{{-0.2, 0, 1}, {0.2, 0, 1}, {-0.2, 0, 1}, {0.2, 0, 1}}};
  CHECK(MeshOf(patch).indices.size() == 6);
  CHECK(MeshOf(patch).rotates_tangents);
  patch.n.reset();
  CHECK_FALSE(MeshOf(patch).rotates_tangents);
}

TEST_CASE("patches of a scene: curved, crossing and flat ones", "[parse]") {
  const auto mesh_of = [](const std::string& points) {
    return ParseWorld("Shape \"bilinearmesh\" " + points).shapes.back().mesh;
  };
  CHECK(mesh_of("\"point3 P\" [ 0 0 0  1 0 0  0 1 0  1 1 0.5 ]")->indices.size() > 1000);
  // A sheet that is turned over: flat, but its outline crosses itself.
  const auto crossing = mesh_of("\"point3 P\" [ 0 0 0  1 0 0  1 1 0  0 1 0 ]");
  double area = 0;
  for (std::size_t t = 0; t < crossing->indices.size(); t += 3) {
    const auto p = [&](std::size_t k) {
      return crossing->positions[crossing->indices[t + k]];
    };
    area += Length(Cross(p(1) - p(0), p(2) - p(0))) / 2;
  }
  CHECK(area == Approx(0.5).epsilon(1e-2));  // two triangles of height and width 1/2, 1
  // The flat one beside a curved one keeps its two triangles, and their normals.
  const auto both = mesh_of(R"("point3 P" [ 0 0 0  1 0 0  0 1 0  1 1 0  0 2 0  1 2 1 ]
      "integer indices" [ 0 1 2 3  2 3 4 5 ])");
  REQUIRE(both->normals.size() == both->positions.size());
  CHECK(both->normals[0] == Vec3d{});
  CHECK(both->normals[4].z > 0);
  CHECK(both->indices[5] == 3);
  CHECK(both->indices[6] == 4);
}

}  // namespace
}  // namespace lanelight
