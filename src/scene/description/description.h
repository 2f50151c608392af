// Content of a scene file in double precision and the file's own units, after the parser
// has resolved names, transforms and spectra. ParseScene (src/scene/parse/parse.h) makes
// it; CompileScene (src/scene/compile/compile.h) and the scalar reference tracer of the
// tests read it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "src/base/core/source_location.h"
#include "src/base/core/transform.h"
#include "src/base/core/vec.h"
#include "src/base/image/spectrum_integral.h"
#include "src/scene/description/film.h"
#include "src/scene/description/note.h"
#include "src/vocabulary/path/scene_kinds.h"
#include "src/vocabulary/strategy/strategy.h"

namespace lanelight {

struct MeasuredReflectance;  // src/base/image/measured_reflectance.h
class SparseGrid;            // src/base/core/sparse_grid.h

/// Index into one of the vectors of SceneDescription; kNone = absent.
using Index = std::int32_t;
inline constexpr Index kNone = -1;

/// The spectrum that a colour was stated as; null for an rgb. For light, up to a factor.
using OwnSpectrum = std::shared_ptr<const Spectrum>;

/// A parameter that is either constant or textured. With a texture, the constant is
/// unused.
struct ColorValue {
  Rgb constant;
  Index texture = kNone;
  OwnSpectrum spectrum = nullptr;
};
struct FloatValue {
  double constant = 0;
  Index texture = kNone;
};

enum class Encoding { kSrgb, kLinear, kGamma };

/// kUv: uv' = (su*u + du, sv*v + dv). kPlanar: uv' = (p.v1 + du, p.v2 + dv), p the point
/// in texture space.
struct UvMapping {
  double su = 1, sv = 1, du = 0, dv = 0;
  MappingKind kind = MappingKind::kUv;
  Vec3d v1{1, 0, 0}, v2{0, 1, 0};  // kPlanar
};

/// Float textures are stored as grey colours (r = g = b).
struct Texture {
  TextureKind kind = TextureKind::kConstant;
  std::string name;
  SourceLocation where;
  bool is_float = false;
  Rgb value;              // kConstant
  ColorValue tex1, tex2;  // kScale uses tex1; kMix, kCheckerboard and kDirectionMix both;
                          // kDots: inside, outside
  FloatValue amount;      // kScale: factor; kMix: weight of tex2
  UvMapping mapping;      // kCheckerboard, kImage, kDots, kBilinear
  std::string path;       // kImage: resolved path
  WrapMode wrap = WrapMode::kRepeat;
  Encoding encoding = Encoding::kSrgb;  // of 8-bit files
  double gamma = 2.2;                   // for Encoding::kGamma
  double scale = 1;
  bool invert = false;   // 1 - scale * value, negative results cut at 0 (as pbrt)
  bool bilinear = true;  // false: nearest
  // kCheckerboard is filtered over the footprint of a pixel with kTrilinear and kEwa.
  ImageFilter filter = ImageFilter::kBilinear;
  double max_anisotropy = 8;     // kEwa
  Transform texture_from_world;  // for mappings and patterns of positions
  int dimension = 2;             // kCheckerboard: 2 or 3
  int octaves = 8;               // kFbm, kWrinkled, kMarble
  double roughness = 0.5;        // the same: falloff from octave to octave
  double noise_scale = 1;        // kMarble
  double variation = 0.2;        // kMarble
  Vec3d direction{0, 1, 0};      // kDirectionMix, in the world
  ColorValue corners[4];         // kBilinear: v00, v01, v10, v11
};

enum class MaterialKind {
  kDiffuse,
  kConductor,
  kDielectric,
  kThinDielectric,
  kCoatedDiffuse,
  kCoatedConductor,
  kDiffuseTransmission,
  kMeasured,
  kHair,
  kMix,
  kInterface
};

/// Roughness values are what the file says; alpha = remap ? sqrt(roughness) : roughness.
struct Material {
  MaterialKind kind = MaterialKind::kDiffuse;
  std::string name;
  SourceLocation where;
  Scattering scattering = Scattering::kLambertian;
  ColorValue reflectance{{0.5, 0.5, 0.5},
                         kNone};  // diffuse, coateddiffuse, diffusetransmission, hair
  ColorValue transmittance{{0.25, 0.25, 0.25}, kNone};  // diffusetransmission
  ColorValue eta, k;                                    // conductor (also below a coat)
  bool has_reflectance = false;  // conductor given by `reflectance`: normal-incidence
                                 // reflectance; eta = 1, k = 2 sqrt(r / (1 - r)).
                                 // hair: `reflectance` of much of it, else `sigma_a`
  double scale = 1;  // diffusetransmission: factor on both colours, which are clamped to
                     // 1 after it
  Rgb sigma_a;       // hair: absorption, per radius of a fibre
  OwnSpectrum sigma_a_spectrum;       // spectrum of `sigma_a`
  double beta_m = 0.3, beta_n = 0.3;  // hair: roughness along a fibre and around it
  double tilt = 2;                    // hair: of its scales, degrees
  double interface_eta = 1.5;         // dielectric, thindielectric, coats, hair
  OwnSpectrum dispersion;  // dielectric, thindielectric: eta by wavelength, or null
  FloatValue uroughness, vroughness;                      // of the (outer) interface
  FloatValue conductor_uroughness, conductor_vroughness;  // coatedconductor
  bool remap_roughness = true;
  double thickness = 0.01;          // coats
  FloatValue coat_g;                // coats: Henyey-Greenstein, of the medium between
  ColorValue coat_albedo;           // its scattering albedo; 0 everywhere: it absorbs
  Index thickness_texture = kNone;  // replaces `thickness`
  int coat_max_depth = 10;
  Index mix[2] = {kNone, kNone};
  FloatValue mix_amount{0.5, kNone};  // weight of mix[1]
  /// Bump map: height in the world's units; flat without texture and constant.
  FloatValue displacement;
  std::string normal_map;  // resolved path; empty: none
  Index inside = kNone;    // dielectric: the medium in it (pbrt's "subsurface"), or none
  std::shared_ptr<const MeasuredReflectance> measured;  // kMeasured
};

/// Object-space triangles. Normals and uvs are per vertex, or empty.
struct TriangleMesh {
  std::vector<Vec3d> positions;
  std::vector<Vec3d> normals;
  std::vector<std::array<double, 2>> uvs;
  std::vector<std::uint32_t> indices;  // 3 per triangle, all < positions.size()
  // Per triangle: it belongs to the same face as the previous one. Empty: each is a face.
  std::vector<bool> continues;
  // dp/du is rotated from the normal of the face to the shading normal instead of
  // projected, as pbrt-v4 does on bilinear patches with normals.
  bool rotates_tangents = false;
};

/// A cubic Bezier curve in object space with a linearly varying width. u runs along it
/// from 0 to 1, v across it.
struct Curve {
  Vec3d p[4];
  double width[2] = {1, 1};
  CurveType type = CurveType::kFlat;
  Vec3d normal[2];  // kRibbon: unit, at both ends
};

enum class ShapeKind { kMesh, kSphere, kDisk, kPlane, kCylinder, kCurves };

/// Media on both sides of a surface; kNone: empty space. If they are the same, paths keep
/// their medium at the surface (as pbrt).
struct MediumInterface {
  Index inside = kNone, outside = kNone;

  bool IsTransition() const { return inside != outside; }
};

struct Shape {
  ShapeKind kind = ShapeKind::kMesh;
  SourceLocation where;
  Transform world_from_object;  // inside an object definition: object_from_shape
  bool reverse_orientation = false;
  Index material = kNone;  // always set by the parser
  Index area_light = kNone;
  FloatValue alpha{1, kNone};
  std::shared_ptr<const TriangleMesh> mesh;    // kMesh (bilinear patches become meshes)
  std::shared_ptr<std::vector<Curve>> curves;  // kCurves: at least one
  double radius = 1;                           // kSphere, kDisk
  double inner_radius = 0;                     // kDisk
  double height = 0;                           // kDisk: object-space z; normal +z
  // Remaining part of a kSphere or kCylinder (finite there); z_min <= z_max.
  double z_min = -std::numeric_limits<double>::infinity();
  double z_max = std::numeric_limits<double>::infinity();
  double phi_max = 360;  // kSphere, kCylinder, kDisk: degrees >= 0, about +z from +x
  MediumInterface media;
  // kPlane: infinite, through the object-space origin, normal +z, uv = (x, y).
};

/// Transform at the time when the shutter closes; null for what does not move
/// (src/base/core/motion.h).
using EndTransform = std::shared_ptr<const Transform>;

struct Instance {
  Index object = kNone;
  Transform world_from_object;
  SourceLocation where;
  EndTransform end = nullptr;
};
/// Shapes of one ObjectBegin/End, in the coordinates at ObjectBegin; or a shape that
/// moves, in its own.
struct ObjectDefinition {
  std::string name;
  std::vector<Shape> shapes;
};

/// Emission of a shape: radiance `radiance * scale`, one-sided along the surface normal
/// unless two_sided. If power > 0, it is scaled so that a round shape, or each face of a
/// mesh, emits this power: pbrt's Phi = pi * area * (two_sided ? 2 : 1) * Y(L), with the
/// mean of an image.
struct AreaLight {
  SourceLocation where;
  Rgb radiance{1, 1, 1};
  OwnSpectrum spectrum;  // spectrum of `radiance`
  double scale = 1;
  double power = -1;
  bool two_sided = false;
  std::string image_path;  // emitted radiance by surface coordinates; empty: none
};

enum class LightKind { kPoint, kSpot, kDistant, kInfinite, kGoniometric, kProjection };

/// Intensities include every scale, power and illuminance parameter of the file.
struct Light {
  LightKind kind = LightKind::kPoint;
  SourceLocation where;
  Transform world_from_light;
  Rgb emission;          // kPoint, kSpot: W/sr. kDistant: irradiance on a facing surface.
                         // kInfinite without image: radiance.
  OwnSpectrum spectrum;  // spectrum of `emission`
  Vec3d from;            // light space; kPoint, kSpot, kDistant
  Vec3d to{0, 0, 1};     // light space; kSpot, kDistant
  double cone_angle = 30, cone_delta = 5;  // kSpot, degrees
  std::string image_path;                  // kInfinite: equal-area octahedral map, square
  double image_scale = 1;
  double illuminance = -1;    // kInfinite: if > 0, rescale to this illuminance on +z
  double power = -1;          // kGoniometric, kProjection: if > 0, rescale to this power
  double fov = 90;            // kProjection, degrees, of the shorter side
  std::vector<Vec3d> portal;  // kInfinite: four corners in the world; empty: none
};

struct Camera {
  CameraKind kind = CameraKind::kPerspective;
  SourceLocation where;
  Transform world_from_camera;  // camera looks along +z, x right, y up
  double fov = 90;              // degrees, of the shorter image axis
  double lens_radius = 0, focal_distance = 1e6;
  double frame_aspect = 0;                 // 0: from the resolution
  double screen_window[4] = {0, 0, 0, 0};  // x0 x1 y0 y1; all 0: from the aspect
  SphericalMapping mapping = SphericalMapping::kEqualArea;
  std::vector<double> lens;      // kRealistic: curvature, thickness, eta, aperture; mm
  double aperture_diameter = 1;  // kRealistic, mm
  std::string aperture;          // kRealistic: built-in shape or resolved path
  double film_diagonal = 35;     // kRealistic, mm
  Index medium = kNone;          // medium around the camera
  EndTransform end = nullptr;
  // Time of motions while the shutter is open: first + u * rate, u from 0 to 1, clamped
  // to 0..1.
  double time_first = 0, time_rate = 1;
};

enum class FilterKind { kBox, kTriangle, kGaussian, kMitchell, kLanczos };
struct Filter {
  FilterKind kind = FilterKind::kGaussian;
  double x_radius = 1.5, y_radius = 1.5;
  double sigma = 0.5;             // gaussian
  double b = 1. / 3, c = 1. / 3;  // mitchell
  double tau = 3;                 // lanczos
};

struct Sampler {
  int spp = 16;
  std::uint64_t seed = 0;
};

enum class MediumKind { kHomogeneous, kUniformGrid, kRgbGrid, kCloud, kNanoVdb };

/// A participating medium. Coefficients are per unit of length of the world, scales of
/// the file included.
struct Medium {
  MediumKind kind = MediumKind::kHomogeneous;
  std::string name;
  SourceLocation where;
  Rgb sigma_a{1, 1, 1}, sigma_s{1, 1, 1};
  Rgb emission;  // radiance of the blackbody limit: sigma_a * emission per length
  OwnSpectrum emission_spectrum;  // spectrum of `emission`
  double g = 0;                   // Henyey-Greenstein
  Transform world_from_medium;
  /// The inside of a material of index `eta`; a walk in it counts as one event. If
  /// `by_reflectance`, sigma_s is the extinction and sigma_a 0; the albedo is such that a
  /// deep material returns `reflectance` of the light that enters along the normal.
  bool in_material = false, by_reflectance = false;
  double eta = 1;
  ColorValue reflectance;
  // Varying media: a box in medium space, with samples at the centres of its voxels, x
  // fastest. kUniformGrid: factors on the coefficients. kRgbGrid: sigma_a and sigma_s.
  Vec3d box_min{0, 0, 0}, box_max{1, 1, 1};
  int grid_size[3] = {1, 1, 1};
  std::vector<float> grid;
  // Factors on `emission` at the same voxels; empty: 1. kUniformGrid: one number each, or
  // one for a grid of one voxel. kRgbGrid: three.
  std::vector<float> emission_grid;
  // kUniformGrid: t at the same voxels, or empty. The emission is multiplied by the
  // colour of a black body (RgbOfBlackbody) of (t - offset) * scale kelvin, 0 up to 100
  // kelvin.
  std::vector<float> temperature;
  double temperature_offset = 0, temperature_scale = 1;
  double density = 1, wispiness = 1, frequency = 5;  // kCloud, as pbrt
  // kNanoVdb: factors on the coefficients; t, null: no emission.
  std::shared_ptr<const SparseGrid> sparse_density, sparse_temperature;
};

struct SceneDescription {
  std::string path;
  Camera camera;
  Film film;
  Filter filter;
  Sampler sampler;
  Integrator integrator;
  Strategy strategy;                // of Sampler and Integrator together
  std::vector<Texture> textures;    // a texture refers only to earlier ones
  std::vector<Material> materials;  // a mix refers only to earlier ones
  std::vector<Medium> media;
  std::vector<AreaLight> area_lights;
  std::vector<Light> lights;
  std::vector<Shape> shapes;  // world space
  std::vector<ObjectDefinition> objects;
  std::vector<Instance> instances;
  std::vector<Note> notes;
};

}  // namespace lanelight
