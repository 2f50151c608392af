// Meshes for the intersection benchmark: triangles, a camera and a light.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "src/scene/compiled/scene.h"

namespace lanelight::bench {

struct Mesh {
  std::string name;
  std::vector<Vec3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  // Camera and the rectangle that shadow rays go to.
  Vec3f eye, at, up{0, 1, 0};
  float fov = 40;  // degrees
  Vec3f light_corner, light_u, light_v;
  bool closed = false;  // rays cannot leave
};

/// NAME.ply and NAME.cam of a folder. The PLY is binary little-endian with float x, y, z
/// and triangles as "uchar int" lists; the .cam has lines "eye x y z", "at", "up",
/// "fov degrees", "light corner edge edge". Throws InputError.
Mesh LoadMesh(const std::string& folder, const std::string& name);
bool HasMesh(const std::string& folder, const std::string& name);

/// The Cornell box of the shared scenes in shape: five walls, a light and two boxes, 36
/// triangles.
Mesh CornellBox();

/// A closed room with a lumpy ball of about n triangles: sizes between the small scenes
/// and the scanned meshes.
Mesh Ball(int n);

/// Splits each triangle into four at the midpoints of its edges; neighbours go on sharing
/// vertices.
void Subdivide(Mesh& mesh);

/// Puts the mesh into a closed box that also holds the camera and the light. Its floor is
/// the ground, just below the mesh.
void Enclose(Mesh& mesh);

Geometry ToGeometry(const Mesh& mesh);

/// The world's triangles of a scene; equal vertices become one.
Mesh FromScene(const std::string& name, const CompiledScene& scene);

}  // namespace lanelight::bench
