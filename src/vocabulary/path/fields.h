// Every column of a path, declared once: type, name, features that need it, lifetime,
// initial value, meaning. The list determines allocation (null if not needed), poisoning
// in debug builds and bytes per path. It also determines initial values, what is carried
// to the next wave, what split paths inherit, and the plan's checks of reads and writes.
//
// A column is an array of 4-byte lanes indexed by path slot. A vector is three columns.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "src/vocabulary/path/features.h"

namespace lanelight {

/// The time for which the value of a column is needed.
enum class Lifetime : std::uint8_t {
  kCamera,    // to the stages of the camera
  kHit,       // until the surface at the hit is known
  kSurface,   // until the path scatters; copies of it take it over
  kBounce,    // within one scattering event, after roulette has decided
  kRay,       // to the next wave, with the ray; copies at a surface need it no more
  kPath,      // to the end of the path; copies take it over
  kGathered,  // to the end of the path; copies begin anew
};

/// No primitive: where a path that has not met a surface yet comes from.
inline constexpr std::uint32_t kNoPrimitive = 0xffffffffu;
/// No cell of the cache of path values (src/scene/prepare/tables.h).
inline constexpr std::uint32_t kNoCell = 0xffffffffu;

// Vectors: one column per component.
#define LANELIGHT_XYZ(X, type, name, ...) \
  X(type, name##_x, __VA_ARGS__)          \
  X(type, name##_y, __VA_ARGS__) X(type, name##_z, __VA_ARGS__)
#define LANELIGHT_RGB(X, type, name, ...) \
  X(type, name##_r, __VA_ARGS__)          \
  X(type, name##_g, __VA_ARGS__) X(type, name##_b, __VA_ARGS__)
#define LANELIGHT_2(X, type, name, ...) \
  X(type, name##_0, __VA_ARGS__) X(type, name##_1, __VA_ARGS__)
#define LANELIGHT_4(X, type, name, ...)   \
  LANELIGHT_2(X, type, name, __VA_ARGS__) \
  X(type, name##_2, __VA_ARGS__) X(type, name##_3, __VA_ARGS__)

// X(type, name, features; {} = always, lifetime, first value; () = a stage writes it,
// meaning) In them `f` is the set of features of the plan.
// clang-format off
#define LANELIGHT_PATH_FIELDS(X)                                                          \
  /* identity, written by the generate stage */                                           \
  X(u32, pixel, ({}), kPath, (), "pixel index, y * width + x: first coordinate of the random numbers") \
  X(u32, sample, ({}), kPath, (), "sample index of the pixel: second coordinate")       \
  X(u32, output, ({}), kPath, (), "slot of the sample in the task's sample buffer")     \
  X(u32, depth, ({}), kPath, (), "scattering events so far")                            \
  X(u32, branch, ({kSplitting}), kPath, (), "index of this split path in its sample, 0 = the first") \
  X(u32, budget, ({kSplitting}), kPath, (), "maximum number of split paths, itself included") \
  /* ray: origin and unit direction, scene units */                                       \
  LANELIGHT_XYZ(X, f32, o, ({}), kRay, (), "ray origin")                                \
  LANELIGHT_XYZ(X, f32, d, ({}), kPath, (), "ray direction, unit")                      \
  /* transport */                                                                         \
  LANELIGHT_RGB(X, f32, beta, ({}), kPath, (1.0f), "throughput")                          \
  LANELIGHT_RGB(X, f32, l, ({}), kGathered, (0.0f), "radiance gathered so far")           \
  X(f32, wavelength, ({kSpectral}), kPath, (), "random number that selected the wavelengths of the path; sign bit set: dispersive glass has left only one (src/scene/compiled/spectra.h)") \
  X(u32, regular, ({kRegularizes}), kPath, (0u), "1: a bounce was not specular; later surfaces are rougher") \
  X(f32, bsdf_pdf, ({kMis, kReuse, kLightPaths, kRegularizes}), kPath, (0.0f), "pdf_sa of the ray direction; 0 after a camera or specular vertex") \
  LANELIGHT_XYZ(X, f32, start_n, ({kProjectedHits}), kRay, (0.0f), "shading normal at the ray origin, on the side of the incoming path") \
  X(f32, eta_scale, ({kRefraction, kReuse, kLightPaths}), kPath, (1.0f), "product of eta^2 of refractions: undone by roulette") \
  X(u32, reuse, ({kReuse}), kPath, (0u), "progress of the path: ReuseState (src/vocabulary/path/block.h)") \
  /* light-paths=splats (kernels/light_paths/chain-inl.h) */                              \
  X(u32, lp_vertex, ({kLightPaths}), kPath, (0u), "vertices so far; kNotFromLight: no light subpath finds this path") \
  X(f32, lp_chain, ({kLightPaths}), kPath, (0.0f), "ratio of the densities of both directions so far") \
  X(f32, lp_pdf, ({kLightPaths}), kPath, (0.0f), "pdf_sa of the ray direction in it; 1 after a specular vertex; from lights at infinity minus the density of the ray's origin on a disk") \
  X(f32, lp_inverse, ({kLightPaths}), kBounce, (), "1 / pdf_area of the vertex") \
  LANELIGHT_XYZ(X, f32, lp_in, ({kLightPaths}), kBounce, (), "direction of the ray that found the vertex") \
  X(f32, hit_weight, ({kLightPaths}), kPath, (1.0f), "MIS weight of light that the ray hits, against light subpaths") \
  X(f32, lp_scale, ({kLightPaths}), kPath, (1.0f), "factor of the throughput of a light subpath") \
  /* film sample points */                                                                \
  LANELIGHT_2(X, f32, u_film, ({}), kCamera, (), "position in the pixel")               \
  LANELIGHT_2(X, f32, u_lens, ({kLens}), kCamera, (), "position on the lens")           \
  X(f32, weight, ({kSignedFilter, kRealisticCamera}), kPath, (), "weight of the sample: of filter and lens system") \
  X(f32, time, ({kMotion}), kPath, (), "time of the path, from 0 (shutter opens) to 1 (shutter closes)") \
  /* hit */                                                                               \
  X(f32, t, ({}), kRay, (std::numeric_limits<float>::infinity()), "hit distance, +inf = miss") \
  X(u32, prim, ({}), f.Has(Feature::kTriangles) ? kPath : kSurface, (kNoPrimitive), "primitive id of the hit (src/scene/geometry/geometry.h); before the ray is intersected, the primitive where it starts") \
  X(f32, b1, ({kTriangles, kCurves}), kHit, (), "barycentric weight of vertex 1; of a curve: its parameter, 0 to 1") \
  X(f32, b2, ({kTriangles}), kHit, (), "barycentric weight of vertex 2")                \
  X(u32, inst, ({kInstances}), kHit, (), "instance of the hit, 0xffffffff = world")     \
  /* surface at the hit */                                                                \
  LANELIGHT_XYZ(X, f32, p, ({kScatters, kAov}), kSurface, (), "hit point")              \
  X(f32, p_error, ({kScatters, kAov}), kSurface, (), "offset along ng that exceeds the rounding error of p") \
  LANELIGHT_XYZ(X, f32, ng, ({kScatters, kAov}), kSurface, (), "geometric normal, unit, emitting side") \
  LANELIGHT_XYZ(X, f32, ns, ({kVertexNormals, kBumps, kNormalMaps}), kSurface, (), "shading normal, unit")   \
  LANELIGHT_XYZ(X, f32, tg, ({kTangents, kBumps, kNormalMaps, kTextureFootprints}), kSurface, (), "dp/du, not normalised")       \
  LANELIGHT_XYZ(X, f32, tv, ({kBumps, kTextureFootprints}), kSurface, (), "dp/dv, not normalised")       \
  LANELIGHT_4(X, f32, footprint, ({kTextureFootprints}), kSurface, (), "footprint of a pixel in surface coordinates: du/dx, du/dy, dv/dx, dv/dy (src/scene/compiled/camera.h)") \
  X(f32, uv_u, ({kUv}), kSurface, (), "surface coordinate")                             \
  X(f32, uv_v, ({kUv}), kSurface, (), "surface coordinate")                             \
  X(u32, material, ({kScatters, kAov}), kSurface, (), "material index")                 \
  /* material parameters that are textured, or depend on the wavelength */                                                      \
  LANELIGHT_RGB(X, f32, color0, ({kTextures, kPlainSpectra}), kSurface, (), "first colour parameter")  \
  LANELIGHT_RGB(X, f32, color1, ({kTexturedColor1, kSpectralColor1}), kSurface, (), "second colour parameter") \
  X(f32, alpha_x, ({kTexturedRoughness}), kSurface, (), "GGX alpha along the tangent")  \
  X(f32, alpha_y, ({kTexturedRoughness}), kSurface, (), "GGX alpha across it")          \
  X(f32, coat_thickness, ({kTexturedCoat}), kSurface, (), "thickness of a coat") \
  LANELIGHT_2(X, f32, alpha2, ({kTexturedCoat}), kSurface, (), "GGX alpha of the metal under a coat") \
  LANELIGHT_RGB(X, f32, coat_albedo, ({kTexturedCoatMedium}), kSurface, (), "albedo of the medium in a coat") \
  X(f32, coat_g, ({kTexturedCoatMedium}), kSurface, (), "its asymmetry")                 \
  X(f32, eta, ({kDispersion}), kSurface, (), "relative index of glass at the wavelength of the path") \
  /* sample points of the bounce */                                                       \
  X(f32, u_lobe, (KindsWith(kChoosesLobe)), kBounce, (), "choice of lobe")              \
  LANELIGHT_2(X, f32, u_bsdf, ({kScatters}), kBounce, (), "direction")                  \
  X(f32, u_select, ({kManyLights}), kBounce, (), "choice of light")                     \
  LANELIGHT_2(X, f32, u_light, ({kLights}), kBounce, (), "point on the light")          \
  X(f32, u_roulette, ({kRoulette}), kBounce, (), "survival")                            \
  /* media (src/scene/compiled/media.h) */                                                      \
  X(u32, medium, ({kMedia}), kPath, (), "medium that the ray is in; 0xffffffff = none")  \
  LANELIGHT_2(X, f32, u_medium, ({kMedia}), kPath, (), "distance in the medium along the ray, choice of colour channel") \
  X(u32, walked, ({kSubsurface}), kPath, (0u), "events inside materials, which the maximum depth does not count") \
  LANELIGHT_RGB(X, f32, inside, ({kSubsurfaceTextures}), kPath, (0.0f), "albedo of the medium inside the current material, from the texture at the entry point") \
  X(f32, passed, ({kInterfaces}), kPath, (0.0f), "distance from the last scattering event to the ray origin, through interfaces") \
  X(u32, crossings, ({kInterfaces}), kPath, (0u), "interfaces that the path has crossed") \
  LANELIGHT_RGB(X, f32, odds, ({kMedia}), kPath, (1.0f), "density of the path if sampled for this channel only, divided by the mean over the channels") \
  LANELIGHT_XYZ(X, f32, sh_o, ({kInterfaces}), kBounce, (), "origin of the remaining shadow ray") \
  LANELIGHT_XYZ(X, f32, sh_n, ({kInterfaces}), kBounce, (), "geometric normal at the surface that it hits") \
  LANELIGHT_XYZ(X, f32, sh_ns, ({kInterfaces}), kBounce, (), "shading normal there")       \
  LANELIGHT_XYZ(X, f32, sh_p, ({kInterfaces}), kBounce, (), "point of that hit")         \
  X(f32, sh_p_error, ({kInterfaces}), kBounce, (), "offset that exceeds its rounding error") \
  X(f32, sh_left, ({kInterfaces}), kBounce, (), "length of the remaining shadow ray")                     \
  X(f32, sh_t, ({kInterfaces}), kBounce, (), "distance of the surface")                   \
  X(u32, sh_prim, ({kInterfaces}), kBounce, (), "primitive of the surface")               \
  X(u32, sh_material, ({kInterfaces}), kBounce, (), "its material")                       \
  X(u32, sh_medium, ({kInterfaces}), kBounce, (), "medium at the origin of the remaining shadow ray")       \
  /* light sample */                                                                      \
  X(u32, ls_light, ({kManyLights}), kBounce, (), "selected light")                      \
  LANELIGHT_XYZ(X, f32, ls, ({kLights}), kBounce, (), "unit direction to the light")    \
  X(f32, ls_distance, ({kLights}), kBounce, (), "length of the shadow ray; ends just before the light") \
  LANELIGHT_RGB(X, f32, ls, ({kLights}), kBounce, (), "radiance / pdf of the light sample (selection included); 0 = no light") \
  X(f32, ls_pdf, ({kLights}), kBounce, (), "pdf_sa of that direction, selection included; 0 = delta light") \
  X(f32, light_pmf, ({kLightTree}), kBounce, (), "probability of selecting the light that was hit, later of the selected light") \
  X(u32, light_row, ({kLearnedLights}), kPath, (0u), "row of LearnedLights by which the last light was selected") \
  /* the light sample kept of several candidates */                                       \
  LANELIGHT_XYZ(X, f32, kept, ({kLightCandidates}), kBounce, (), "its direction")         \
  X(f32, kept_distance, ({kLightCandidates}), kBounce, (), "its distance")                \
  LANELIGHT_RGB(X, f32, kept, ({kLightCandidates}), kBounce, (), "its radiance / pdf")    \
  X(f32, kept_pdf, ({kLightCandidates}), kBounce, (), "its pdf_sa, as a single candidate") \
  X(u32, kept_light, ({kLightCandidates}), kBounce, (), "its light")                      \
  X(f32, candidate_weight, ({kLightCandidates}), kBounce, (), "luminance that it would add unshadowed") \
  X(f32, candidate_weight_sum, ({kLightCandidates}), kBounce, (), "the same luminance, summed over the candidates so far") \
  X(f32, u_candidate, ({kLightCandidates}), kBounce, (), "choice between the kept candidate and the next one") \
  /* shadow ray */                                                                        \
  LANELIGHT_RGB(X, f32, sh, ({kLights}), kBounce, (), "radiance the shadow ray carries if unoccluded") \
  /* control variates */                                                                  \
  X(u32, first_film, ({kRegressionControl}), kPath, (), "u_film of the path, as codes (src/vocabulary/path/dimensions.h)") \
  X(u32, first_bsdf, ({kRegressionControl}), kPath, (0u), "u_bsdf of the first event that is not specular; 0 = none") \
  X(u32, first_light, ({kRegressionControl}), kPath, (0u), "u_light of that event; 0 = none") \
  X(u32, choices, ({kRegressionControl}), kPath, (0u), "the first two choices of lobes; 0 = none") \
  /* training pass: the first vertices of a path */                                       \
  LANELIGHT_4(X, u32, cell, ({kRecordsPaths}), kPath, (kNoCell), "cache cell of vertex 0, 1, 2, 3; 0xffffffff = none") \
  LANELIGHT_4(X, f32, at, ({kRecordsPaths}), kPath, (0.0f), "luminance of the throughput there") \
  LANELIGHT_4(X, f32, got, ({kRecordsPaths}), kPath, (0.0f), "luminance gathered before it") \
  LANELIGHT_4(X, u32, lit_by, ({kRecordsPaths}), kPath, (0u), "light sampled there") \
  LANELIGHT_4(X, f32, direct, ({kRecordsPaths}), kPath, (0.0f), "luminance that it adds") \
  X(f32, risk_0, ({kRecordsSinglePaths}), kPath, (0.0f), "second moments that roulette would add (kernels/roulette/single_path_records.cc)") \
  X(f32, risk_1, ({kRecordsSinglePaths}), kPath, (0.0f), "second moments, linear part")         \
  X(f32, risk_2, ({kRecordsSinglePaths}), kPath, (0.0f), "second moments, constant part")       \
  /* training pass with splitting: what the path would be without (kernels/roulette/single_path_records.cc) */ \
  X(f32, copy_weight, ({kRecordsSinglePaths}), kPath, (1.0f), "product of 1/r of its decisions so far") \
  X(f32, decided_at, ({kRecordsSinglePaths}), kPath, (-1.0f), "brightness of the throughput before the last decision; negative after it survived") \
  X(f32, single_gathered, ({kRecordsSinglePaths}), kPath, (0.0f), "brightness gathered up to its last decision, without weights of split paths") \
  X(f32, single_l, ({kRecordsSinglePaths}), kGathered, (0.0f), "brightness of the gathered radiance at that time") \
  /* auxiliary output: first hit */                                                       \
  LANELIGHT_RGB(X, f32, aov_albedo, ({kAov}), kPath, (0.0f), "albedo")                    \
  LANELIGHT_XYZ(X, f32, aov_n, ({kAov}), kPath, (0.0f), "shading normal")                 \
  X(f32, aov_depth, ({kAov}), kPath, (0.0f), "distance from the camera, scene units") \
  /* of the same, in the space that --gbuffer names */                                    \
  X(f32, gb_hit, ({kGbuffer}), kPath, (0.0f), "1 = there is a first hit")               \
  LANELIGHT_XYZ(X, f32, gb_p, ({kGbuffer}), kPath, (0.0f), "hit point")                   \
  LANELIGHT_XYZ(X, f32, gb_ng, ({kGbuffer}), kPath, (0.0f), "geometric normal, unit")     \
  LANELIGHT_XYZ(X, f32, gb_ns, ({kGbuffer}), kPath, (0.0f), "shading normal, unit")       \
  LANELIGHT_2(X, f32, gb_uv, ({kGbuffer}), kPath, (0.0f), "surface coordinates")          \
  LANELIGHT_2(X, f32, gb_dz, ({kGbuffer}), kPath, (0.0f), "change of z to the next pixel, in x and y")
// clang-format on

using f32 = float;
using u32 = std::uint32_t;
using i32 = std::int32_t;

enum class Field : std::uint8_t {
#define X(type, name, ...) name,
  LANELIGHT_PATH_FIELDS(X)
#undef X
      kCount
};
inline constexpr std::size_t kNumFields = static_cast<std::size_t>(Field::kCount);

/// Pointers to the columns of one wavefront; null = this scene does not need the column.
struct PathColumns {
#define X(type, name, ...) type* name = nullptr;
  LANELIGHT_PATH_FIELDS(X)
#undef X
};

using FieldSet = EnumSet<Field>;

/// The 32 bits that a column begins with.
struct FirstValue {
  bool any = false;
  std::uint32_t bits = 0;

  constexpr FirstValue() = default;
  constexpr FirstValue(float v) : any(true), bits(std::bit_cast<std::uint32_t>(v)) {}
  constexpr FirstValue(std::uint32_t v) : any(true), bits(v) {}
};

const char* FieldName(Field field);
const char* FieldMeaning(Field field);
/// "f32", "u32" or "i32".
const char* FieldType(Field field);
/// Returns the features of which any one makes the column live; empty = always.
FeatureSet FieldFeatures(Field field);
/// Returns whether renders with these features need the field.
bool IsLive(Field field, const FeatureSet& features);
/// Returns the lifetime in a plan with the features `f`.
Lifetime FieldLifetime(Field field, const FeatureSet& f);
/// Returns the value that the camera stage writes; none if another stage writes it.
FirstValue FieldFirstValue(Field field);

/// Returns whether the value goes from one wave to the next.
constexpr bool IsCarried(Lifetime lifetime) { return lifetime >= Lifetime::kRay; }
/// Returns whether a copy of a path at a surface, made before the numbers of the bounce
/// are drawn, needs it.
constexpr bool IsCopied(Lifetime lifetime) {
  return lifetime == Lifetime::kSurface || lifetime == Lifetime::kPath;
}

// Groups used in the declarations of stages.
namespace fields {
/// Fields that some plan carries from wave to wave; fields that the camera stage
/// initialises.
FieldSet EverCarried();
FieldSet WithFirstValue();

inline constexpr FieldSet kRay = {Field::o_x, Field::o_y, Field::o_z,
                                  Field::d_x, Field::d_y, Field::d_z};
inline constexpr FieldSet kHit = {Field::t, Field::prim, Field::b1, Field::b2,
                                  Field::inst};
inline constexpr FieldSet kThroughput = {Field::beta_r, Field::beta_g, Field::beta_b};
inline constexpr FieldSet kRadiance = {Field::l_r, Field::l_g, Field::l_b};
inline constexpr FieldSet kPoint = {Field::p_x, Field::p_y, Field::p_z, Field::p_error};
inline constexpr FieldSet kNormal = {Field::ng_x, Field::ng_y, Field::ng_z,
                                     Field::ns_x, Field::ns_y, Field::ns_z};
inline constexpr FieldSet kStartNormal = {Field::start_n_x, Field::start_n_y,
                                          Field::start_n_z};
inline constexpr FieldSet kTangent = {Field::tg_x, Field::tg_y, Field::tg_z};
inline constexpr FieldSet kTangents = {Field::tg_x, Field::tg_y, Field::tg_z,
                                       Field::tv_x, Field::tv_y, Field::tv_z};
inline constexpr FieldSet kUv = {Field::uv_u, Field::uv_v};
inline constexpr FieldSet kFootprint = {Field::footprint_0, Field::footprint_1,
                                        Field::footprint_2, Field::footprint_3};
inline constexpr FieldSet kParameters = {Field::color0_r,       Field::color0_g,
                                         Field::color0_b,       Field::color1_r,
                                         Field::color1_g,       Field::color1_b,
                                         Field::alpha_x,        Field::alpha_y,
                                         Field::alpha2_0,       Field::alpha2_1,
                                         Field::coat_thickness, Field::coat_albedo_r,
                                         Field::coat_albedo_g,  Field::coat_albedo_b,
                                         Field::coat_g,         Field::eta};
inline constexpr FieldSet kBounceNumbers = {
    Field::u_lobe,     Field::u_bsdf_0,  Field::u_bsdf_1,   Field::u_select,
    Field::u_light_0,  Field::u_light_1, Field::u_roulette, Field::u_candidate,
    Field::u_medium_0, Field::u_medium_1};
/// The rest of a shadow ray that goes through interfaces.
inline constexpr FieldSet kShadowRest = {
    Field::sh_o_x,  Field::sh_o_y,      Field::sh_o_z,     Field::sh_n_x,  Field::sh_n_y,
    Field::sh_n_z,  Field::sh_ns_x,     Field::sh_ns_y,    Field::sh_ns_z, Field::sh_p_x,
    Field::sh_p_y,  Field::sh_p_z,      Field::sh_p_error, Field::sh_left, Field::sh_t,
    Field::sh_prim, Field::sh_material, Field::sh_medium};
inline constexpr FieldSet kLightSample = {Field::ls_x,        Field::ls_y,  Field::ls_z,
                                          Field::ls_distance, Field::ls_r,  Field::ls_g,
                                          Field::ls_b,        Field::ls_pdf};
inline constexpr FieldSet kKeptSample = {
    Field::kept_x,     Field::kept_y,          Field::kept_z, Field::kept_distance,
    Field::kept_r,     Field::kept_g,          Field::kept_b, Field::kept_pdf,
    Field::kept_light, Field::candidate_weight};
inline constexpr FieldSet kAov = {
    Field::aov_albedo_r, Field::aov_albedo_g, Field::aov_albedo_b, Field::aov_n_x,
    Field::aov_n_y,      Field::aov_n_z,      Field::aov_depth};
inline constexpr FieldSet kGbuffer = {
    Field::gb_hit,  Field::gb_p_x,  Field::gb_p_y,  Field::gb_p_z,  Field::gb_ng_x,
    Field::gb_ng_y, Field::gb_ng_z, Field::gb_ns_x, Field::gb_ns_y, Field::gb_ns_z,
    Field::gb_uv_0, Field::gb_uv_1, Field::gb_dz_0, Field::gb_dz_1};
inline constexpr FieldSet kShadow = {Field::sh_r, Field::sh_g, Field::sh_b};
inline constexpr FieldSet kFirstNumbers = {Field::first_film, Field::first_bsdf,
                                           Field::first_light, Field::choices};
inline constexpr FieldSet kVertices = {
    Field::cell_0,   Field::cell_1,   Field::cell_2,   Field::cell_3,   Field::lit_by_0,
    Field::lit_by_1, Field::lit_by_2, Field::lit_by_3, Field::direct_0, Field::direct_1,
    Field::direct_2, Field::direct_3, Field::at_0,     Field::at_1,     Field::at_2,
    Field::at_3,     Field::got_0,    Field::got_1,    Field::got_2,    Field::got_3};
inline constexpr FieldSet kSinglePath = {Field::copy_weight, Field::decided_at,
                                         Field::single_gathered, Field::single_l};
inline constexpr FieldSet kRisk = {Field::risk_0, Field::risk_1, Field::risk_2};
}  // namespace fields

}  // namespace lanelight
