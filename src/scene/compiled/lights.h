// Lights as the kernels read them, and the selection probabilities of a strategy.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "src/base/core/aligned.h"
#include "src/vocabulary/path/light_shapes.h"

namespace lanelight {

/// Light record: 23 words. Emitters in instances are copied into the world at compile.
struct LightRecord {
  std::uint32_t shape;       // LightShape
  std::uint32_t two_sided;   // 0 or 1
  float area;                // scene units; 0 for lights without area
  float radiance[3];         // radiance; point/spot: intensity in scene units (W/sr times
                             // scale^2); distant: irradiance on a facing surface. With
                             // an image: what a texel of 1 stands for
  std::uint32_t primitive;   // id of the emitting primitive
  float position[3];         // point, spot, goniometric, projection; rectangle: a corner
  std::int32_t environment;  // index into LightTable::environments, or -1
  float direction[3];  // spot, projection: axis, away from the light; distant: unit,
                       // pointing TOWARD the light; rectangle: unit, along a side
                       // that begins at `position`
  // Spot: 1 - cos of the cone and of where its falloff begins, exact for narrow cones.
  float versine_total, versine_falloff;
  float side[3];  // rectangle: unit, along the other side; its normal, on the side that
                  // emits, is cross(direction, side)
  // Rectangle: lengths of the two sides. Sphere: the first is the square of the distance
  // from its centre beyond which its cone is sampled; nearer, its area. Spot, projection:
  // the first is 1 - cos of a cone around `direction` that holds all of the light.
  float size[2];
  std::uint32_t second_primitive;  // rectangle: the other triangle
  std::uint32_t image;  // index into LightTable::images, 0 if it has none; portals: into
                        // LightTable::portals
};
static_assert(sizeof(LightRecord) == 92);

/// LightRecord::size[0] of a sphere whose far side is not visible from outside.
inline float ConeFrom(float radius) { return radius * radius * 1.0001f; }

/// Image that a light shines with: 16 words. Texels are linear and not negative, row 0 at
/// the top, in LightTable::texels. A unit vector w away from the light is (x, y, z) =
/// (dot(x_axis, w), ...) for it, of any length where the light is stretched:
///   goniometric   equal-area octahedral map of (x, y, z); pbrt-v4 has the light's own z
///                 for the map's y, and the reverse
///   projection    (s, t) = (1 + (x, y) / z) / 2 for z > 0, t downwards
///   area lights   (s, t) = (u, 1 - v) of the surface coordinates; no axes
///   spot          only where LightTable::stretched_spots; the cone is about z
struct LightImage {
  std::int32_t first;  // texel
  std::int32_t width, height;
  float x_axis[3], y_axis[3], z_axis[3];  // in the scene
  std::uint32_t pad[4];
};
static_assert(sizeof(LightImage) == 64);

/// Texel probabilities of an environment image; pdf_sa = p * size^2 / (4 pi). Sampled by
/// inverting the cumulative distributions of row and column, which keeps the
/// stratification of the sample points. Empty for a black image.
struct EnvironmentTable {
  AlignedVector<float> row_cdf;      // size + 1
  AlignedVector<float> column_cdf;   // size + 1 per row
  AlignedVector<float> probability;  // per texel, sums to 1
  // Where to look in a distribution for u in [k, k + 1) / 2^guide_bits: from entry k of
  // its guide, the largest step with a value of at most k / 2^guide_bits, to entry k + 1.
  std::int32_t guide_bits = 0;
  AlignedVector<std::int32_t> row_guide;     // 2^guide_bits + 1
  AlignedVector<std::int32_t> column_guide;  // 2^guide_bits + 1 per row
};

/// Environment image: size x size equal-area octahedral map (Clarberg 2008; pbrt-v4).
/// Looked up without interpolation, as pbrt does.
struct Environment {
  std::int32_t size = 0;
  AlignedVector<float> rgb;                        // 3 per texel, row by row, scaled
  float light_from_scene[9], scene_from_light[9];  // row-major, of determinant 1 or -1
  bool stretched = false;                          // else they are rotations, or mirror
  /// Distribution of texels, unless a strategy uses the compensated one.
  std::shared_ptr<const EnvironmentTable> table;
};

/// Environment that is seen through a rectangular portal only (Bitterli, Novak and Jarosz
/// 2015, "Portal-Masked Environment Map Sampling"; pbrt-v4). A direction has the
/// components (x, y, z) along the portal's sides and its normal; (s, t) = (atan(x / z),
/// atan(y / z)) / pi + 1/2 for z > 0: from any point the portal is a rectangle of the
/// square of (s, t). Radiance and the density's weight are constant over each texel.
struct Portal {
  std::int32_t size = 0;
  AlignedVector<float> rgb;  // 3 per texel, scaled; row by row, t upwards
  // Sums of the weights (luminance times solid angle per (s, t)) of all texels before a
  // column and a row: (size + 1)^2, row by row.
  AlignedVector<double> sums;
  float x_axis[3], y_axis[3], z_axis[3];  // unit, scene
  float low[3], high[3];                  // opposite corners, scene
};

struct LightTable {
  AlignedVector<LightRecord> lights;
  /// With kSpectral, of each light: row of SpectrumTable, per unit of luminance; -1: by
  /// the colour of its image.
  AlignedVector<std::int32_t> spectrum;
  std::vector<double> power;  // of each light, raised to a least share
  std::vector<Environment> environments;
  std::vector<Portal> portals;
  AlignedVector<LightImage> images;  // the first is white: of lights without one
  AlignedVector<float> texels;       // 3 each, of all images
  bool has_goniometric = false, has_projection = false;
  bool stretched_spots = false;         // all spots then have axes in `images`
  std::vector<std::uint32_t> infinite;  // indices of lights that escaped rays see
  /// Sphere around all shapes but infinite planes.
  float center[3] = {}, radius = 0;
};

/// Node of a tree of lights, 16 words. The two children of an inner node are neighbours.
/// Light leaves `axis` within acos(cos_axis), and from there within a right angle.
struct LightNode {
  float low[3];
  std::int32_t child;  // first of two children; ~light for a leaf
  float high[3];
  float power;  // of all lights below
  float axis[3];
  float cos_axis;  // half angle of the normals' cone; -1 = all directions
  std::int32_t parent;
  std::uint32_t pad[3];
};
static_assert(sizeof(LightNode) == 64);

/// Tree over the lights that have a place (not environments and distant lights, of which
/// each is selected with `pmf_far`).
struct LightTree {
  AlignedVector<LightNode> nodes;              // root first; empty = no light has a place
  AlignedVector<std::int32_t> primitive_leaf;  // leaf of each primitive; -1 = dark
  AlignedVector<std::uint32_t> far;            // lights without a place
  float pmf_far = 0;                           // of each of those
};

/// Centre of a light, 4 words: distances=equiangular samples points around it.
struct LightAnchor {
  float position[3];
  float keep;  // of Walker's alias table
};
static_assert(sizeof(LightAnchor) == 16);

/// Probabilities of the lights at which light subpaths start. Walker's alias table as in
/// LightChances.
struct LightStarts {
  AlignedVector<float> pmf;  // per light; 0: none start there
  AlignedVector<float> alias_q;
  AlignedVector<std::uint32_t> alias;
};

/// Lights at which light subpaths start (light-paths=splats), selected by power.
struct LightEmission : LightStarts {
  std::uint32_t shapes = 0;  // of those lights: a bit for each LightShape
  bool has_images = false;   // emitting shapes with an image
  bool has_cuts = false;     // emitting shapes with alpha
  /// Subpaths from lights without extent may begin with a mirror: caustics that camera
  /// paths never find.
  bool delta_caustics = true;
  /// Two for each light: the media behind its surface and before it. Empty: all start in
  /// the camera's.
  AlignedVector<std::int32_t> media;

  bool empty() const { return pmf.empty(); }
  bool Has(LightShape shape) const {
    return (shapes >> static_cast<std::uint32_t>(shape) & 1) != 0;
  }
  bool HasAny(LightTraits trait) const {
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(LightShape::kCount); ++i) {
      const auto shape = static_cast<LightShape>(i);
      if (Has(shape) && HasTrait(shape, trait)) return true;
    }
    return false;
  }
};

/// Selection of lights by a strategy (src/scene/prepare/prepared_scene.h).
struct LightChances {
  /// Per light: probability of being selected; with a tree, only of lights without a
  /// position.
  AlignedVector<float> pmf;
  AlignedVector<float> alias_q;        // Walker-Vose table over lights: with u*n = i + f,
  AlignedVector<std::uint32_t> alias;  // pick i if f < alias_q[i], else alias[i]
  LightTree tree;                      // light-selection=tree only
  /// One per LightTable::environments.
  std::vector<std::shared_ptr<const EnvironmentTable>> environments;
  // Centres of all lights, drawn by power, for distances=equiangular. Lights without a
  // position have one that is not finite.
  AlignedVector<LightAnchor> anchors;
  AlignedVector<std::uint32_t> anchor_alias;
  LightEmission emission;  // with light-paths=splats, or a trial run that may choose it
};

}  // namespace lanelight
