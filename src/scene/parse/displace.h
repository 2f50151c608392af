// Meshes that are moved along their normals by a float texture when the scene is loaded.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "src/base/image/image.h"
#include "src/scene/description/description.h"

namespace lanelight {

/// A float texture and its operands. Keeps a reference to the list of textures.
class HeightTexture {
 public:
  /// Reads the images that the texture needs; InputError at the texture if one cannot be.
  /// Requires that `Problem` is empty.
  HeightTexture(const std::vector<Texture>& textures, Index texture);

  /// Why the texture cannot be evaluated here, in words, or "": constant, scale, mix,
  /// checkerboard and imagemap over surface coordinates can be.
  static std::string Problem(const std::vector<Texture>& textures, Index texture);

  /// The value at surface coordinates (u, v): of images, level 0.
  double At(double u, double v) const { return Value(texture_, u, v); }

 private:
  // One value per texel, row 0 at the top, decoded.
  struct Texels {
    int width = 0, height = 0;
    std::vector<float> values;
  };
  void Load(Index texture);
  double Value(Index texture, double u, double v) const;
  double ImageValue(const Texture& texture, const Texels& texels, double s,
                    double t) const;

  const std::vector<Texture>& textures_;
  Index texture_;
  std::map<Index, Texels> images_;
};

/// Triangles that displacement makes of one mesh at most.
inline constexpr double kMaxDisplacedTriangles = 5e7;

/// As pbrt-v4: triangles are cut in two across their longest side until no side is as
/// long as `edge_length` in the world; every vertex moves along its normal, in object
/// space, by the texture's value; normals are then means of the faces around each vertex.
/// The mesh needs surface coordinates. `world_from_object` only measures. Throws
/// InputError without a place if that makes more than kMaxDisplacedTriangles triangles.
TriangleMesh Displace(const TriangleMesh& mesh, const Transform& world_from_object,
                      double edge_length, const HeightTexture& height);

}  // namespace lanelight
