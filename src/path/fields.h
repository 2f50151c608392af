// Every column of a path, declared once: type, name, the feature that needs it, its
// meaning. Allocation (null when not needed), poisoning in debug builds, the dump, bytes
// per path, and the read/write checks of the plan all derive from this list.
//
// A column is an array of 4-byte lanes indexed by path slot. A vector is three columns.
#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <initializer_list>

#include "src/path/features.h"

namespace lanelight {

// X(type, name, features of which any one needs it; {} = always, meaning)
// clang-format off
#define LANELIGHT_PATH_FIELDS(X)                                                          \
  /* identity */                                                                          \
  X(u32, pixel,    ({}), "pixel index, y * width + x: first coordinate of the random numbers") \
  X(u32, sample,   ({}), "sample index of the pixel: second coordinate")                  \
  X(u32, output,   ({}), "slot of the sample in the task's sample buffer")                \
  X(u32, depth,    ({}), "scattering events so far")                                      \
  /* ray: origin and unit direction, scene units */                                       \
  X(f32, o_x, ({}), "ray origin") X(f32, o_y, ({}), "ray origin") X(f32, o_z, ({}), "ray origin") \
  X(f32, d_x, ({}), "ray direction") X(f32, d_y, ({}), "ray direction") X(f32, d_z, ({}), "ray direction") \
  /* transport */                                                                         \
  X(f32, beta_r, ({}), "throughput") X(f32, beta_g, ({}), "throughput") X(f32, beta_b, ({}), "throughput") \
  X(f32, l_r, ({}), "radiance gathered so far") X(f32, l_g, ({}), "radiance gathered so far") X(f32, l_b, ({}), "radiance gathered so far") \
  X(f32, bsdf_pdf, ({Feature::kMis}), "pdf_sa of the ray direction; 0 after a camera or specular vertex") \
  X(f32, eta_scale, ({Feature::kRefraction}), "product of eta^2 of refractions, undone by roulette") \
  X(u32, branch, ({Feature::kSplitting}), "which copy of its sample the path is, 0 = the first") \
  X(u32, budget, ({Feature::kSplitting}), "copies that the path may still become, itself included") \
  /* film sample points */                                                                \
  X(f32, u_film_0, ({}), "position in the pixel") X(f32, u_film_1, ({}), "position in the pixel") \
  X(f32, u_lens_0, ({Feature::kLens}), "position on the lens") X(f32, u_lens_1, ({Feature::kLens}), "position on the lens") \
  X(f32, weight, ({Feature::kSignedFilter}), "filter weight of the sample")               \
  /* hit */                                                                               \
  X(f32, t,    ({}), "hit distance, +inf = miss")                                         \
  X(u32, prim, ({}), "primitive id of the hit (src/compiled/scene.h); of the last one, where the ray starts, until there is a new one") \
  X(f32, b1, ({Feature::kTriangles}), "barycentric weight of vertex 1") X(f32, b2, ({Feature::kTriangles}), "barycentric weight of vertex 2") \
  X(u32, inst, ({Feature::kInstances}), "instance of the hit, 0xffffffff = world")        \
  /* surface at the hit */                                                                \
  X(f32, p_x, ({Feature::kScatters, Feature::kAov}), "hit point") X(f32, p_y, ({Feature::kScatters, Feature::kAov}), "hit point") X(f32, p_z, ({Feature::kScatters, Feature::kAov}), "hit point") \
  X(f32, p_error, ({Feature::kScatters, Feature::kAov}), "offset along ng that clears the rounding error of p") \
  X(f32, ng_x, ({Feature::kScatters, Feature::kAov}), "geometric normal, unit, emitting side") X(f32, ng_y, ({Feature::kScatters, Feature::kAov}), "geometric normal") X(f32, ng_z, ({Feature::kScatters, Feature::kAov}), "geometric normal") \
  X(f32, ns_x, ({Feature::kVertexNormals}), "shading normal, unit") X(f32, ns_y, ({Feature::kVertexNormals}), "shading normal") X(f32, ns_z, ({Feature::kVertexNormals}), "shading normal") \
  X(f32, tg_x, ({Feature::kTangents}), "dp/du, not normalised") X(f32, tg_y, ({Feature::kTangents}), "dp/du") X(f32, tg_z, ({Feature::kTangents}), "dp/du") \
  X(f32, uv_u, ({Feature::kUv}), "surface coordinate") X(f32, uv_v, ({Feature::kUv}), "surface coordinate") \
  X(u32, material, ({Feature::kScatters, Feature::kAov}), "material index")               \
  /* textured material parameters */                                                      \
  X(f32, color0_r, ({Feature::kTextures}), "first colour parameter") X(f32, color0_g, ({Feature::kTextures}), "first colour parameter") X(f32, color0_b, ({Feature::kTextures}), "first colour parameter") \
  X(f32, color1_r, ({Feature::kTexturedColor1}), "second colour parameter") X(f32, color1_g, ({Feature::kTexturedColor1}), "second colour parameter") X(f32, color1_b, ({Feature::kTexturedColor1}), "second colour parameter") \
  X(f32, alpha_x, ({Feature::kTexturedRoughness}), "GGX alpha along the tangent") X(f32, alpha_y, ({Feature::kTexturedRoughness}), "GGX alpha across it") \
  /* sample points of the bounce */                                                       \
  X(f32, u_lobe,   ({Feature::kDielectricSmooth, Feature::kDielectricRough, Feature::kThinDielectric, Feature::kCoatedDiffuseSmooth, Feature::kCoatedDiffuseRough, Feature::kCoatedConductor, Feature::kDiffuseTransmission}), "choice of lobe") \
  X(f32, u_bsdf_0, ({Feature::kScatters}), "direction") X(f32, u_bsdf_1, ({Feature::kScatters}), "direction") \
  X(f32, u_select, ({Feature::kManyLights}), "choice of light")                           \
  X(f32, u_light_0, ({Feature::kLights}), "point on the light") X(f32, u_light_1, ({Feature::kLights}), "point on the light") \
  X(f32, u_roulette, ({Feature::kRoulette}), "survival")                                  \
  /* light sample */                                                                      \
  X(u32, ls_light, ({Feature::kManyLights}), "selected light")                                \
  X(f32, ls_x, ({Feature::kLights}), "unit direction to the light") X(f32, ls_y, ({Feature::kLights}), "direction to the light") X(f32, ls_z, ({Feature::kLights}), "direction to the light") \
  X(f32, ls_distance, ({Feature::kLights}), "length of the shadow ray, already short of the light") \
  X(f32, ls_r, ({Feature::kLights}), "radiance / pdf of the light sample (selection included); 0 = no light") X(f32, ls_g, ({Feature::kLights}), "radiance / pdf") X(f32, ls_b, ({Feature::kLights}), "radiance / pdf") \
  X(f32, ls_pdf, ({Feature::kLights}), "pdf_sa of that direction, selection included; 0 = delta light") \
  X(f32, light_pmf, ({Feature::kLightTree}), "probability of selecting the light that was hit, then of the one selected") \
  /* shadow ray */                                                                        \
  X(f32, sh_r, ({Feature::kLights}), "radiance the shadow ray carries if unoccluded") X(f32, sh_g, ({Feature::kLights}), "shadow radiance") X(f32, sh_b, ({Feature::kLights}), "shadow radiance") \
  /* control variates */                                                                  \
  X(f32, k_r, ({Feature::kControlDifference}), "sum over the path of throughput (h - E[h])") X(f32, k_g, ({Feature::kControlDifference}), "control difference") X(f32, k_b, ({Feature::kControlDifference}), "control difference") \
  X(f32, first_0, ({Feature::kRegressionControl}), "u_bsdf_0 of the first bounce; -1 = none") X(f32, first_1, ({Feature::kRegressionControl}), "u_bsdf_1 of the first bounce") \
  X(f32, first_2, ({Feature::kRegressionControl}), "u_light_0 of the first bounce; -1 = none") X(f32, first_3, ({Feature::kRegressionControl}), "u_light_1 of the first bounce") \
  /* pilot pass: the first vertices of a path */                                          \
  X(u32, cell_0, ({Feature::kPilot}), "cache cell of vertex 0; 0xffffffff = none") X(u32, cell_1, ({Feature::kPilot}), "cache cell of vertex 1") X(u32, cell_2, ({Feature::kPilot}), "cache cell of vertex 2") X(u32, cell_3, ({Feature::kPilot}), "cache cell of vertex 3") \
  X(f32, at_0, ({Feature::kPilot}), "luminance of the throughput there") X(f32, at_1, ({Feature::kPilot}), "throughput at vertex 1") X(f32, at_2, ({Feature::kPilot}), "throughput at vertex 2") X(f32, at_3, ({Feature::kPilot}), "throughput at vertex 3") \
  X(f32, got_0, ({Feature::kPilot}), "luminance gathered before it") X(f32, got_1, ({Feature::kPilot}), "gathered before vertex 1") X(f32, got_2, ({Feature::kPilot}), "gathered before vertex 2") X(f32, got_3, ({Feature::kPilot}), "gathered before vertex 3") \
  X(f32, risk_0, ({Feature::kPilot}), "second moments that roulette would add (kernels/roulette/record.cc)") X(f32, risk_1, ({Feature::kPilot}), "second moments, linear part") X(f32, risk_2, ({Feature::kPilot}), "second moments, constant part") \
  /* auxiliary output: first hit */                                                       \
  X(f32, aov_albedo_r, ({Feature::kAov}), "albedo") X(f32, aov_albedo_g, ({Feature::kAov}), "albedo") X(f32, aov_albedo_b, ({Feature::kAov}), "albedo") \
  X(f32, aov_n_x, ({Feature::kAov}), "shading normal") X(f32, aov_n_y, ({Feature::kAov}), "shading normal") X(f32, aov_n_z, ({Feature::kAov}), "shading normal") \
  X(f32, aov_depth, ({Feature::kAov}), "distance from the camera, scene units")
// clang-format on

using f32 = float;
using u32 = std::uint32_t;
using i32 = std::int32_t;

enum class Field : std::uint8_t {
#define X(type, name, features, meaning) name,
  LANELIGHT_PATH_FIELDS(X)
#undef X
      kCount
};
inline constexpr std::size_t kNumFields = static_cast<std::size_t>(Field::kCount);

/// Pointers to the columns of one wavefront; null = this scene does not need the column.
struct PathColumns {
#define X(type, name, features, meaning) type* name = nullptr;
  LANELIGHT_PATH_FIELDS(X)
#undef X
};

/// A set of columns, for what a stage reads and writes.
class FieldSet {
 public:
  FieldSet() = default;
  FieldSet(std::initializer_list<Field> fields) {
    for (Field f : fields) bits_.set(static_cast<std::size_t>(f));
  }
  bool Has(Field f) const { return bits_.test(static_cast<std::size_t>(f)); }
  FieldSet operator|(const FieldSet& o) const {
    FieldSet r;
    r.bits_ = bits_ | o.bits_;
    return r;
  }

 private:
  std::bitset<kNumFields> bits_;
};

const char* FieldName(Field f);
const char* FieldMeaning(Field f);
/// "f32", "u32" or "i32".
const char* FieldType(Field f);
/// Features of which any one makes the column live; empty = always.
FeatureSet FieldFeatures(Field f);

// Groups used in the declarations of stages.
namespace fields {
inline const FieldSet kRay = {Field::o_x, Field::o_y, Field::o_z,
                              Field::d_x, Field::d_y, Field::d_z};
inline const FieldSet kHit = {Field::t, Field::prim, Field::b1, Field::b2, Field::inst};
inline const FieldSet kThroughput = {Field::beta_r, Field::beta_g, Field::beta_b};
inline const FieldSet kRadiance = {Field::l_r, Field::l_g, Field::l_b};
inline const FieldSet kPoint = {Field::p_x, Field::p_y, Field::p_z, Field::p_error};
inline const FieldSet kNormal = {Field::ng_x, Field::ng_y, Field::ng_z,
                                 Field::ns_x, Field::ns_y, Field::ns_z};
inline const FieldSet kTangent = {Field::tg_x, Field::tg_y, Field::tg_z};
inline const FieldSet kUv = {Field::uv_u, Field::uv_v};
inline const FieldSet kParameters = {Field::color0_r, Field::color0_g, Field::color0_b,
                                     Field::color1_r, Field::color1_g, Field::color1_b,
                                     Field::alpha_x,  Field::alpha_y};
inline const FieldSet kBouncePoints = {
    Field::u_lobe,    Field::u_bsdf_0,  Field::u_bsdf_1,  Field::u_select,
    Field::u_light_0, Field::u_light_1, Field::u_roulette};
inline const FieldSet kLightSample = {Field::ls_x,        Field::ls_y,  Field::ls_z,
                                      Field::ls_distance, Field::ls_r,  Field::ls_g,
                                      Field::ls_b,        Field::ls_pdf};
inline const FieldSet kAov = {
    Field::aov_albedo_r, Field::aov_albedo_g, Field::aov_albedo_b, Field::aov_n_x,
    Field::aov_n_y,      Field::aov_n_z,      Field::aov_depth};
inline const FieldSet kShadow = {Field::sh_r, Field::sh_g, Field::sh_b};
inline const FieldSet kControl = {Field::k_r, Field::k_g, Field::k_b};
inline const FieldSet kFirstBounce = {Field::first_0, Field::first_1, Field::first_2,
                                      Field::first_3};
inline const FieldSet kVertices = {Field::cell_0, Field::cell_1, Field::cell_2,
                                   Field::cell_3, Field::at_0,   Field::at_1,
                                   Field::at_2,   Field::at_3,   Field::got_0,
                                   Field::got_1,  Field::got_2,  Field::got_3};
inline const FieldSet kRisk = {Field::risk_0, Field::risk_1, Field::risk_2};
}  // namespace fields

}  // namespace lanelight
