// Meshes that are moved along their normals by a texture when the scene is loaded.
#pragma once

#include "src/scene/parse/height_texture.h"

namespace lanelight {

/// Triangles that displacement makes of one mesh at most.
inline constexpr double kMostDisplaced = 5e7;

/// As pbrt-v4: triangles are cut in two across their longest side until no side is as
/// long as `edge_length` in the world; every vertex moves along its normal, in object
/// space, by the texture's value; normals are then means of the faces around each vertex.
/// The mesh needs surface coordinates. `world_from_object` only measures. Throws
/// InputError without a place if that makes more than kMostDisplaced triangles.
TriangleMesh Displace(const TriangleMesh& mesh, const Transform& world_from_object,
                      double edge_length, const HeightTexture& height);

}  // namespace lanelight
