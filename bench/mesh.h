// Meshes for the intersection benchmark: triangles and a camera.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "src/core/vec.h"

namespace lanelight::bench {

struct Mesh {
  std::string name;
  std::vector<Vec3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  // Camera and the rectangle that shadow rays go to.
  Vec3f eye, at, up{0, 1, 0};
  float fov = 40;
  Vec3f light_corner, light_u, light_v;
};

inline void Require(bool good, const std::string& path, const char* what) {
  if (!good) throw std::runtime_error(path + ": " + what);
}

/// Binary little-endian PLY with float x, y, z and triangles as "uchar int" lists, the
/// form of the benchmark's meshes.
inline void ReadPly(const std::string& path, Mesh& mesh) {
  std::ifstream in(path, std::ios::binary);
  Require(in.good(), path, "cannot open");
  std::size_t vertices = 0, faces = 0;
  std::string line;
  while (std::getline(in, line) && line != "end_header") {
    std::istringstream words(line);
    std::string word, kind;
    words >> word >> kind;
    if (word == "format") Require(kind == "binary_little_endian", path, "not binary");
    if (word == "element" && kind == "vertex") words >> vertices;
    if (word == "element" && kind == "face") words >> faces;
  }
  mesh.vertices.resize(vertices);
  mesh.triangles.resize(faces);
  in.read(reinterpret_cast<char*>(mesh.vertices.data()),
          static_cast<std::streamsize>(vertices * sizeof(Vec3f)));
  for (auto& triangle : mesh.triangles) {
    char count = 0;
    in.read(&count, 1);
    in.read(reinterpret_cast<char*>(triangle.data()), sizeof(triangle));
    Require(count == 3, path, "a face is not a triangle");
    for (const std::uint32_t v : triangle) Require(v < vertices, path, "bad index");
  }
  Require(in.good(), path, "truncated");
}

/// Lines "eye x y z", "at", "up", "fov degrees", "light corner edge edge".
inline void ReadCamera(const std::string& path, Mesh& mesh) {
  std::ifstream in(path);
  Require(in.good(), path, "cannot open");
  const auto read = [&](Vec3f& v) { in >> v.x >> v.y >> v.z; };
  for (std::string key; in >> key;) {
    if (key == "eye") read(mesh.eye);
    if (key == "at") read(mesh.at);
    if (key == "up") read(mesh.up);
    if (key == "fov") in >> mesh.fov;
    if (key == "light") {
      read(mesh.light_corner);
      read(mesh.light_u);
      read(mesh.light_v);
    }
  }
}

inline Mesh LoadMesh(const std::string& folder, const std::string& name) {
  Mesh mesh;
  mesh.name = name;
  ReadPly(folder + "/" + name + ".ply", mesh);
  ReadCamera(folder + "/" + name + ".cam", mesh);
  return mesh;
}

/// The Cornell box of the shared scenes in shape: five walls, a light and two boxes, 36
/// triangles.
inline Mesh CornellBox() {
  Mesh mesh;
  mesh.name = "cornell";
  const auto quad = [&](Vec3f a, Vec3f u, Vec3f v) {
    const auto n = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), {a, a + u, a + u + v, a + v});
    mesh.triangles.push_back({n, n + 1, n + 2});
    mesh.triangles.push_back({n, n + 2, n + 3});
  };
  quad({-1, 0, -1}, {2, 0, 0}, {0, 0, 2});
  quad({-1, 2, -1}, {2, 0, 0}, {0, 0, 2});
  quad({-1, 0, -1}, {2, 0, 0}, {0, 2, 0});
  quad({-1, 0, -1}, {0, 2, 0}, {0, 0, 2});
  quad({1, 0, -1}, {0, 2, 0}, {0, 0, 2});
  quad({-0.24f, 1.98f, -0.22f}, {0.47f, 0, 0}, {0, 0, 0.38f});
  const auto box = [&](Vec3f c, float half, float height, float angle) {
    const Vec3f u = Vec3f{std::cos(angle), 0, std::sin(angle)} * (2 * half);
    const Vec3f w = Vec3f{-std::sin(angle), 0, std::cos(angle)} * (2 * half);
    const Vec3f h = {0, height, 0}, a = c - 0.5f * (u + w);
    quad(a, u, w), quad(a + h, u, w), quad(a, u, h), quad(a + w, u, h), quad(a, w, h);
    quad(a + u, w, h);
  };
  box({0.33f, 0, 0.35f}, 0.3f, 0.6f, 0.3f);
  box({-0.33f, 0, -0.3f}, 0.3f, 1.2f, -0.3f);
  mesh.eye = {0, 1, 6.8f};
  mesh.at = {0, 1, 0};
  mesh.fov = 19.5f;
  mesh.light_corner = {-0.24f, 1.97f, -0.22f};
  mesh.light_u = {0.47f, 0, 0};
  mesh.light_v = {0, 0, 0.38f};
  return mesh;
}

/// A closed room with a lumpy ball of about n triangles: sizes between the small scenes
/// and the scanned meshes.
inline Mesh Ball(int n) {
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
      mesh.vertices.push_back(
          {static_cast<float>(radius * std::sin(theta) * std::cos(phi)),
           static_cast<float>(0.7 + radius * std::cos(theta)),
           static_cast<float>(radius * std::sin(theta) * std::sin(phi))});
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

}  // namespace lanelight::bench
