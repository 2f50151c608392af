// The scene as the kernels read it: flat float32 arrays, recentred and scaled by a power
// of two (p_scene = (p_world - center) * scale), built once by CompileScene.
//
// Per-primitive data are fixed-size records, because a shading kernel gathers many words
// of one primitive: a record is one or two cache lines, while one array per word would
// touch a line per word. The word offsets are named below.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "src/accel/accel.h"
#include "src/core/aligned.h"
#include "src/core/vec.h"
#include "src/scene/description.h"
#include "src/scene/features.h"
#include "src/scene/texture_table.h"

namespace lanelight {

// ---- Primitives -------------------------------------------------------------------
// A primitive id counts triangles first, then spheres, disks, planes.
/// No primitive: where a path that has not met a surface yet comes from.
inline constexpr std::uint32_t kNoPrimitive = 0xffffffffu;

struct PrimitiveRanges {
  std::uint32_t spheres = 0, disks = 0, planes = 0, end = 0;  // first id of each; end
};

/// Triangle record: 12 words. Wound so that cross(p1-p0, p2-p0) is the surface normal
/// (ReverseOrientation and mirroring transforms are already applied; uv and normals are
/// permuted alike). Triangles of object definitions are in object space.
struct TriangleRecord {
  float p[3][3];
  std::uint32_t material;
  std::int32_t light;   // index into LightTable::lights, -1 = not emitting
  std::uint32_t flags;  // kAlphaTested: bit 0
};
static_assert(sizeof(TriangleRecord) == 48);
inline constexpr std::uint32_t kAlphaTested = 1;

/// Sphere record: 16 words. `normal_sign` -1: normal points inward (ReverseOrientation).
struct SphereRecord {
  float center[3];
  float radius;
  std::uint32_t material;
  std::int32_t light;
  std::uint32_t flags;
  float normal_sign;
  float x_axis[3],
      z_axis[3];  // object axes in scene space, unit, for uv; y = cross(z, x)*
  float y_sign;   // *times y_sign (mirrored transforms)
  std::uint32_t pad;
};
static_assert(sizeof(SphereRecord) == 64);

/// Disk record: 16 words.
struct DiskRecord {
  float center[3];
  float radius;
  float normal[3];  // unit, on the emitting side
  float inner_radius;
  float u_axis[3];  // unit, object x; v axis = v_sign * cross(normal, u_axis)
  std::uint32_t material;
  std::int32_t light;
  std::uint32_t flags;
  float v_sign;
  std::uint32_t pad;
};
static_assert(sizeof(DiskRecord) == 64);

/// Infinite plane record: 16 words. uv = (dot(p - point, u_axis), dot(p - point,
/// v_axis)), axes scaled so that uv are object-space x and y.
struct PlaneRecord {
  float point[3];
  std::uint32_t material;
  float normal[3];
  std::int32_t light;  // always -1: an infinite plane cannot emit
  float u_axis[3];
  std::uint32_t flags;
  float v_axis[3];
  std::uint32_t pad;
};
static_assert(sizeof(PlaneRecord) == 64);

/// Instance record: 24 words, row-major 3x4 affine maps.
struct InstanceRecord {
  float object_from_scene[12];
  float scene_from_object[12];
};

struct Geometry {
  PrimitiveRanges ranges;
  AlignedVector<TriangleRecord> triangles;
  AlignedVector<float>
      normals;               // 9 per triangle (3 vertices); empty without kVertexNormals.
                             // Unit; triangles without normals hold their face normal.
  AlignedVector<float> uvs;  // 6 per triangle; empty without kUv and kTangents
  AlignedVector<SphereRecord> spheres;
  AlignedVector<DiskRecord> disks;
  AlignedVector<PlaneRecord> planes;
  AlignedVector<InstanceRecord> instances;
  /// Triangle ranges that form one acceleration structure each: [0] is the world (may be
  /// empty), the others are object definitions.
  struct TriangleGroup {
    std::uint32_t begin = 0, end = 0;
  };
  std::vector<TriangleGroup> groups;
  std::vector<std::uint32_t> instance_group;  // group of each instance
  Vec3f bounds_min, bounds_max;               // of everything finite, scene space
};

// ---- Materials --------------------------------------------------------------------
/// The shading kernels, one queue each.
#define LANELIGHT_SHADE_KINDS(X)                                                  \
  X(kDiffuse)                                                                     \
  X(kDiffuseUniform)                                                              \
  X(kDiffuseInSphere)                                                             \
  X(kConductorSmooth) X(kConductorRough) X(kDielectricSmooth) X(kDielectricRough) \
      X(kThinDielectric) X(kCoatedDiffuseSmooth) X(kCoatedDiffuseRough)           \
          X(kCoatedConductor) X(kDiffuseTransmission)

enum class ShadeKind : std::uint32_t {
#define X(name) name,
  LANELIGHT_SHADE_KINDS(X)
#undef X
      kCount,
  kMix = kCount  // resolved by the route stage, has no kernel
};
inline constexpr int kNumShadeKinds = static_cast<int>(ShadeKind::kCount);

/// The feature that says that a scene has this kind.
constexpr Feature ShadeFeature(ShadeKind kind) {
  constexpr Feature kFeatures[] = {
#define X(name) Feature::name,
      LANELIGHT_SHADE_KINDS(X)
#undef X
  };
  return kFeatures[static_cast<int>(kind)];
}

/// Transmittance of a (rough) dielectric coat seen from outside, tabulated over
/// mu = |cos theta| at (i / (kCoatTableSize - 1)); see src/scene/coat_table.h.
inline constexpr int kCoatTableSize = 64;

/// One column per parameter, one entry per material. A texture index >= 0 replaces the
/// constant. What color0 and color1 are depends on the kind:
///   diffuse*, coateddiffuse*: color0 = reflectance
///   diffusetransmission: color0 = reflectance, color1 = transmittance
///   conductor*, coatedconductor: color0 = eta, color1 = k (of the metal relative to
///     what is above it)
///   kMix: alpha_x = amount of the second; mix0, mix1 = materials
struct MaterialTable {
  AlignedVector<std::uint32_t> kind;  // ShadeKind
  AlignedVector<float> color0_r, color0_g, color0_b;
  AlignedVector<float> color1_r, color1_g, color1_b;
  AlignedVector<float> alpha_x, alpha_y;    // GGX alpha of the (outer) interface
  AlignedVector<float> alpha2_x, alpha2_y;  // of the metal below a coat
  AlignedVector<float> eta;                 // relative index of the dielectric
  AlignedVector<std::int32_t> coat;     // offset of its table in coat_transmittance, -1
  AlignedVector<float> coat_internal;   // mean internal reflectance under the coat
  AlignedVector<float> coat_thickness;  // of a coat: the medium absorbs exp(-t / cos)
  AlignedVector<std::uint32_t> coat_depth;  // layer crossings at most (pbrt's maxdepth)
  AlignedVector<std::int32_t> color0_texture, color1_texture;
  AlignedVector<std::int32_t> alpha_x_texture, alpha_y_texture;
  AlignedVector<std::uint32_t> alpha_remap;  // 1: textured roughness goes through sqrt
  AlignedVector<std::int32_t> mix0, mix1;
  AlignedVector<float> coat_transmittance;  // kCoatTableSize per distinct coat
  std::vector<std::string> names;
  std::size_t size() const { return kind.size(); }
};

// ---- Lights -----------------------------------------------------------------------
enum class LightShape : std::uint32_t {
  kTriangle,
  kSphere,
  kDisk,
  kPoint,
  kSpot,
  kDistant,
  kInfiniteConstant,
  kInfiniteImage
};

/// Light record: 20 words.
struct LightRecord {
  std::uint32_t shape;       // LightShape
  std::uint32_t two_sided;   // 0 or 1
  float pmf;                 // probability of being selected
  float area;                // scene units; 0 for lights without area
  float radiance[3];         // radiance; point/spot: intensity in scene units (W/sr times
                             // scale^2); distant: irradiance on a facing surface
  std::uint32_t primitive;   // id of the emitting primitive
  float position[3];         // point, spot
  std::int32_t environment;  // index into LightTable::environments, or -1
  float direction[3];        // spot: axis, pointing away from the light; distant: unit,
                             // pointing TOWARD the light
  std::int32_t instance;     // of the emitting primitive, -1 (emitters in instances are
                             // copied into the world at compile)
  float cos_total, cos_falloff;  // spot
  float pad[2];
};
static_assert(sizeof(LightRecord) == 80);

/// Environment image: size x size equal-area octahedral map (Clarberg 2008; pbrt-v4).
/// Texel probabilities are proportional to luminance; pdf_sa = p * size^2 / (4 pi).
/// Looked up without interpolation, as pbrt does. Sampled by inverting the cumulative
/// distributions of row and column, which keeps the stratification of the sample points.
struct Environment {
  std::int32_t size = 0;
  AlignedVector<float> rgb;          // 3 per texel, row by row, scaled
  AlignedVector<float> row_cdf;      // size + 1
  AlignedVector<float> column_cdf;   // size + 1 per row
  AlignedVector<float> probability;  // per texel, sums to 1
  // Where to look in a distribution for u in [k, k + 1) / 2^guide_bits: from entry k of
  // its guide, the largest step with a value of at most k / 2^guide_bits, to entry k + 1.
  std::int32_t guide_bits = 0;
  AlignedVector<std::int32_t> row_guide;     // 2^guide_bits + 1
  AlignedVector<std::int32_t> column_guide;  // 2^guide_bits + 1 per row
  float light_from_scene[9];                 // rotation, row-major
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

struct LightTable {
  AlignedVector<LightRecord> lights;
  std::vector<double> power;           // of each light, raised to a least share
  AlignedVector<float> alias_q;        // Walker-Vose table over lights: with u*n = i + f,
  AlignedVector<std::uint32_t> alias;  // pick i if f < alias_q[i], else alias[i]
  std::vector<Environment> environments;
  std::vector<std::uint32_t> infinite;  // indices of lights that escaped rays see
  LightTree tree;                       // light-selection=tree only
};

// ---- Camera -----------------------------------------------------------------------
struct CompiledCamera {
  CameraKind kind = CameraKind::kPerspective;
  // Camera-space direction (perspective) or origin (orthographic) of film position
  // (x, y) in pixels: base + x * dx + y * dy, in camera space, perspective: z = 1.
  Vec3f base, dx, dy;
  float lens_radius = 0, focal_distance = 1;  // scene units
  // Camera to scene: rotation columns (unit or scaled axes) and origin.
  Vec3f right, up, forward, origin;
};

/// Separable filter, sampled by inverting a piecewise-linear CDF per axis. Weight of a
/// sample: sign_x * sign_y * weight (positive filters: 1).
struct CompiledFilter {
  static constexpr int kSize = 64;
  float x_radius = 0.5f, y_radius = 0.5f;
  bool is_box = true;                   // then the tables are unused
  AlignedVector<float> x_cdf, y_cdf;    // kSize + 1 entries each, of |f|
  AlignedVector<float> x_sign, y_sign;  // kSize entries, +-1
  float weight = 1;                     // integral |f| / integral f over both axes
};

struct CompiledScene {
  Vec3d center;         // world position of the scene origin
  double scale = 1;     // power of two, scene units per world unit
  FeatureSet features;  // what the scene contains (options may add or remove more)
  Geometry geometry;
  Accel accel;
  MaterialTable materials;
  TextureTable textures;
  /// Per primitive, only with kAlpha: texture of the alpha cut-out or -1, and constant.
  AlignedVector<std::int32_t> alpha_texture;
  AlignedVector<float> alpha_constant;
  LightTable lights;
  CompiledCamera camera;
  CompiledFilter filter;
  Film film;
  Sampler sampler;
  Integrator integrator;
  Strategy strategy;        // what UseStrategy has prepared the light tables for
  std::vector<Note> notes;  // what compiling left out, such as degenerate triangles
};

}  // namespace lanelight
