// One bit for everything a scene or a render option may need. Fields, stages and kernel
// variants name the bits they need; the plan drops the rest.
#pragma once

#include <cstdint>
#include <initializer_list>

namespace lanelight {

// X(bit name, what it means when set)
#define LANELIGHT_FEATURES(X)                                                 \
  X(kTriangles, "triangle meshes")                                            \
  X(kSpheres, "spheres")                                                      \
  X(kDisks, "disks")                                                          \
  X(kPlanes, "infinite planes")                                               \
  X(kInstances, "object instances")                                           \
  X(kVertexNormals, "interpolated vertex normals")                            \
  X(kUv, "surface coordinates (a texture is looked up)")                      \
  X(kTangents, "tangent frames (an anisotropic material)")                    \
  X(kTextures, "textured material parameters")                                \
  X(kTexturedRoughness, "textured roughness")                                 \
  X(kTexturedColor1, "a textured second colour parameter")                    \
  X(kColor1, "a second colour parameter (conductor k, transmittance)")        \
  X(kAlpha, "alpha cut-outs")                                                 \
  X(kMix, "mix materials")                                                    \
  X(kDiffuse, "Lambertian diffuse material")                                  \
  X(kDiffuseUniform, "uniform-scattering diffuse material")                   \
  X(kDiffuseInSphere, "in-sphere diffuse material")                           \
  X(kConductorSmooth, "smooth conductor")                                     \
  X(kConductorRough, "rough conductor")                                       \
  X(kDielectricSmooth, "smooth dielectric")                                   \
  X(kDielectricRough, "rough dielectric")                                     \
  X(kThinDielectric, "thin dielectric")                                       \
  X(kCoatedDiffuseSmooth, "smooth coated diffuse")                            \
  X(kCoatedDiffuseRough, "rough coated diffuse")                              \
  X(kCoatedConductor, "coated conductor")                                     \
  X(kDiffuseTransmission, "diffuse transmission")                             \
  X(kRefraction, "a refracting interface (roulette must know eta)")           \
  X(kLights, "light that is sampled")                                         \
  X(kManyLights, "more than one light")                                       \
  X(kTriangleLights, "emitting triangles")                                    \
  X(kSphereLights, "emitting spheres")                                        \
  X(kDiskLights, "emitting disks")                                            \
  X(kPointLights, "point lights")                                             \
  X(kSpotLights, "spot lights")                                               \
  X(kDistantLights, "distant lights")                                         \
  X(kInfiniteConstant, "constant environment")                                \
  X(kInfiniteImage, "environment image")                                      \
  X(kAreaLights, "emitting shapes")                                           \
  X(kInfiniteLights, "an environment")                                        \
  X(kMis, "a light that BSDF sampling can hit: multiple importance sampling") \
  X(kScatters, "paths of more than zero bounces (maximum depth > 0)")         \
  X(kLens, "a thin lens")                                                     \
  X(kOrthographic, "an orthographic camera")                                  \
  X(kFiltered, "a pixel filter other than the box")                           \
  X(kSignedFilter, "a pixel filter with negative lobes")                      \
  X(kAov, "auxiliary output (--aov)")                                         \
  X(kIndependentPoints, "points=independent")                                 \
  X(kStratifiedPoints, "points=stratified")                                   \
  X(kCmjPoints, "points=cmj")                                                 \
  X(kPmj02Points, "points=pmj02")                                             \
  X(kSobolPoints, "points=sobol")                                             \
  X(kHaltonPoints, "points=halton")                                           \
  X(kLatticePoints, "points=lattice")                                         \
  X(kSampledHittableLights, "light samples of lights that rays can hit")      \
  X(kUniformDirections, "directions=uniform")                                 \
  X(kAntithetic, "pairs=antithetic")                                          \
  X(kLightTable, "light-selection=power or uniform")                          \
  X(kLightTree, "light-selection=tree")                                       \
  X(kRoulette, "roulette on scattered rays (and a maximum depth > 1)")        \
  X(kConstantRoulette, "roulette=constant")                                   \
  X(kThroughputRoulette, "roulette=throughput")                               \
  X(kLuminanceRoulette, "roulette=luminance")                                 \
  X(kSplitting, "paths that split (roulette=adjoint, efficiency)")            \
  X(kAdjointRoulette, "roulette=adjoint")                                     \
  X(kEfficiencyRoulette, "roulette=efficiency")                               \
  X(kPilot, "a pilot pass that records what paths find")                      \
  X(kControl, "a control variate (samples may be negative)")                  \
  X(kAnalyticControl, "control=analytic")                                     \
  X(kAmbientControl, "control=ambient")                                       \
  X(kRegressionControl, "control=regression")                                 \
  X(kControlDifference, "a control variate with an estimated coefficient")

enum class Feature : std::uint8_t {
#define X(name, meaning) name,
  LANELIGHT_FEATURES(X)
#undef X
      kCount
};

class FeatureSet {
 public:
  constexpr FeatureSet() = default;
  constexpr FeatureSet(std::initializer_list<Feature> features) {
    for (Feature f : features) Add(f);
  }
  constexpr void Add(Feature f) { Word(f) |= Bit(f); }
  constexpr void Remove(Feature f) { Word(f) &= ~Bit(f); }
  constexpr bool Has(Feature f) const {
    return ((static_cast<int>(f) < 64 ? low_ : high_) & Bit(f)) != 0;
  }
  constexpr bool HasAll(FeatureSet o) const {
    return (o.low_ & ~low_) == 0 && (o.high_ & ~high_) == 0;
  }
  constexpr bool HasAny(FeatureSet o) const {
    return (o.low_ & low_) != 0 || (o.high_ & high_) != 0;
  }
  constexpr bool empty() const { return low_ == 0 && high_ == 0; }
  friend constexpr bool operator==(const FeatureSet&, const FeatureSet&) = default;

 private:
  static constexpr std::uint64_t Bit(Feature f) {
    return std::uint64_t{1} << (static_cast<int>(f) % 64);
  }
  constexpr std::uint64_t& Word(Feature f) {
    return static_cast<int>(f) < 64 ? low_ : high_;
  }
  std::uint64_t low_ = 0, high_ = 0;
};
static_assert(static_cast<int>(Feature::kCount) <= 128);

/// Identifier without the leading k, e.g. "ConductorRough".
const char* FeatureName(Feature f);
/// One-line meaning from the list above.
const char* FeatureMeaning(Feature f);

}  // namespace lanelight
