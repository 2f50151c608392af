// One bit for everything a scene or a render option may need. Fields, stages and kernel
// variants name the bits they need; the plan drops the rest.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <string>

#include "src/vocabulary/path/shade_kinds.h"
#include "src/vocabulary/strategy/choices.h"

namespace lanelight {

// Features of scenes and options. X(bit name, what it means when set)
#define LANELIGHT_COMMON_FEATURES(X)                                          \
  X(kTriangles, "triangle meshes")                                            \
  X(kSpheres, "spheres")                                                      \
  X(kDisks, "disks")                                                          \
  X(kPlanes, "infinite planes")                                               \
  X(kLargeSpheres, "spheres much larger than the camera's distance to them")  \
  X(kCurves, "curves")                                                        \
  X(kInstances, "object instances")                                           \
  X(kMotion, "shapes that move while the shutter is open")                    \
  X(kMovingInstances, "object instances that move")                           \
  X(kMovingCamera, "a camera that moves")                                     \
  X(kVertexNormals, "interpolated vertex normals")                            \
  X(kUv, "textures that need surface coordinates")                            \
  X(kTangents, "anisotropic materials, which need tangents")                  \
  X(kTextures, "textured material parameters")                                \
  X(kTexturedRoughness, "textured roughness")                                 \
  X(kTexturedColor1, "a textured second colour parameter")                    \
  X(kTexturedCoat, "textured layers of a coat")                               \
  X(kTexturedCoatMedium, "a textured medium in a coat")                       \
  X(kTexturePlaces, "textures that depend on the position")                   \
  X(kTextureFootprints, "textures filtered over the footprint of a pixel")    \
  X(kBumps, "displacement textures, shaded as bumps")                         \
  X(kNormalMaps, "normal maps")                                               \
  X(kSpectral, "paths that carry wavelengths (transport=spectral)")           \
  X(kPlainSpectra, "spectral colours without textures")                       \
  X(kSpectralColor1, "a spectral second colour parameter")                    \
  X(kDispersion, "glass whose index depends on the wavelength")               \
  X(kForcedDiffuse, "one scattering model for all surfaces (--scattering)")   \
  X(kRegularizes, "regularization: rougher surfaces after a rough bounce")    \
  X(kAlpha, "alpha cut-outs")                                                 \
  X(kMix, "mix materials")                                                    \
  X(kRefraction, "a refracting interface, whose eta roulette uses")           \
  X(kOtherEvents, "events away from surfaces, such as points in a medium")    \
  X(kMedia, "participating media")                                            \
  X(kMediumGrids, "media whose density varies")                               \
  X(kMediumEmission, "media that emit light")                                 \
  X(kMediumChanges, "surfaces next to media")                                 \
  X(kInterfaces, "interfaces (surfaces that only bound a medium)")            \
  X(kSubsurface, "subsurface scattering")                                     \
  X(kSubsurfaceTextures, "subsurface scattering with a textured albedo")      \
  X(kOpaqueShadows, "shadow rays that any surface stops")                     \
  X(kLights, "sampled lights")                                                \
  X(kManyLights, "more than one light")                                       \
  X(kTriangleLights, "emitting triangles")                                    \
  X(kRectangleLights, "emitting rectangles (two triangles each)")             \
  X(kSphereLights, "emitting spheres")                                        \
  X(kDiskLights, "emitting disks")                                            \
  X(kPointLights, "point lights")                                             \
  X(kSpotLights, "spot lights")                                               \
  X(kDistantLights, "distant lights")                                         \
  X(kImageLights, "point lights with an image of their directions")           \
  X(kEmissionImages, "emitting shapes with an image")                         \
  X(kEmissionCuts, "emitting shapes with alpha cut-outs")                     \
  X(kUnseenLights, "emitting shapes that rays pass through")                  \
  X(kPortals, "an environment seen through a portal")                         \
  X(kInfiniteConstant, "constant environment")                                \
  X(kInfiniteImage, "environment image")                                      \
  X(kAreaLights, "emitting shapes")                                           \
  X(kInfiniteLights, "an environment")                                        \
  X(kMis, "light that BSDF sampling can hit (multiple importance sampling)")  \
  X(kScatters, "paths of more than zero bounces (maximum depth > 0)")         \
  X(kPerspective, "a perspective camera")                                     \
  X(kOrthographic, "an orthographic camera")                                  \
  X(kSphericalCamera, "a spherical camera")                                   \
  X(kRealisticCamera, "a camera with a lens system")                          \
  X(kLens, "a thin lens")                                                     \
  X(kFiltered, "a pixel filter other than the box")                           \
  X(kSignedFilter, "a pixel filter with negative lobes")                      \
  X(kAov, "auxiliary output (--aov)")                                         \
  X(kGbuffer, "auxiliary output of first-hit positions (--gbuffer)")          \
  X(kSpectralFilm, "a film that keeps spectra (Film \"spectral\")")           \
  X(kSampledHittableLights, "light samples of shapes and environments")       \
  X(kLightTable, "light-selection=power or uniform")                          \
  X(kLightTree, "light-selection=tree")                                       \
  X(kLearnedLights, "light-selection=learned")                                \
  X(kRoulette, "roulette on scattered rays (and a maximum depth > 1)")        \
  X(kSplitting, "paths that split (roulette=adjoint)")                        \
  X(kRecordsPaths, "a training pass that records the radiance of paths")      \
  X(kSolidAngleLights, "light-points=solid-angle")                            \
  X(kProjectedLights, "light-points=projected")                               \
  X(kProjectedHits, "light-points=projected, with hits weighted by it (MIS)") \
  X(kLightCandidates, "further candidates for each light sample")             \
  X(kReuse, "path reuse in pixel blocks (reuse=block)")                       \
  X(kReuseGlossy, "path reuse on glossy surfaces")                            \
  X(kLightPaths, "light subpaths (light-paths=splats)")                       \
  X(kGuidedEmission, "light subpaths from lights at infinity")                \
  X(kLightSubpath, "paths that start at lights")                              \
  X(kDecides, "a strategy chosen by a trial run")                             \
  X(kRecordsSinglePaths,                                                      \
    "a training pass that records the contributions of single "               \
    "paths")

// Choices of strategies that have a stage or kernel of their own, and kinds of materials.
#define LANELIGHT_OWN_FEATURE_STAGE(name, meaning) X(name, meaning)
#define LANELIGHT_OWN_FEATURE_PLAIN(name, meaning)
#define LANELIGHT_CHOICE_FEATURE(Type, key, name, own, also, text, ...) \
  LANELIGHT_OWN_FEATURE_##own(k##name##Type, key "=" text)
#define LANELIGHT_AXIS_FEATURES(Type, member, key, CHOICES) \
  CHOICES(LANELIGHT_CHOICE_FEATURE, Type, key)
#define LANELIGHT_SHADE_FEATURE(name, traits, meaning) X(k##name, meaning)

// X(bit name, meaning), by that name: the lists that this one is made of ask for it.
#define LANELIGHT_FEATURES(X)                    \
  LANELIGHT_COMMON_FEATURES(X)                   \
  LANELIGHT_SHADE_KINDS(LANELIGHT_SHADE_FEATURE) \
  LANELIGHT_AXES(LANELIGHT_AXIS_FEATURES)

enum class Feature : std::uint8_t {
#define X(name, meaning) name,
  LANELIGHT_FEATURES(X)
#undef X
      kCount
};

/// A set of the values of an enumeration that ends with kCount. Not a std::bitset: sets
/// are known when kernels are compiled, so that no code of a kernel file runs before main
/// has examined the processor.
template <class E>
class EnumSet {
 public:
  constexpr EnumSet() = default;
  constexpr EnumSet(std::initializer_list<E> values) {
    for (E v : values) Add(v);
  }
  static constexpr EnumSet All() {
    EnumSet all;
    all.words_.fill(~std::uint64_t{0});
    return all;
  }
  constexpr void Add(E v) { words_[Word(v)] |= Bit(v); }
  constexpr void Add(const EnumSet& o) { *this = *this | o; }
  constexpr void Remove(E v) { words_[Word(v)] &= ~Bit(v); }
  constexpr void Remove(const EnumSet& o) {
    for (std::size_t i = 0; i < words_.size(); ++i) words_[i] &= ~o.words_[i];
  }
  constexpr bool Has(E v) const { return (words_[Word(v)] & Bit(v)) != 0; }
  constexpr bool HasAll(const EnumSet& o) const {
    EnumSet missing = o;
    missing.Remove(*this);
    return missing.empty();
  }
  constexpr bool HasAny(const EnumSet& o) const {
    EnumSet rest = o;
    rest.Remove(*this);
    return !(rest == o);
  }
  constexpr bool empty() const { return *this == EnumSet(); }
  constexpr EnumSet operator|(const EnumSet& o) const {
    EnumSet both = *this;
    for (std::size_t i = 0; i < words_.size(); ++i) both.words_[i] |= o.words_[i];
    return both;
  }
  friend constexpr bool operator==(const EnumSet&, const EnumSet&) = default;

 private:
  static constexpr std::size_t Word(E v) { return static_cast<std::size_t>(v) / 64; }
  static constexpr std::uint64_t Bit(E v) {
    return std::uint64_t{1} << (static_cast<std::size_t>(v) % 64);
  }

  std::array<std::uint64_t, (static_cast<std::size_t>(E::kCount) + 63) / 64> words_{};
};
using FeatureSet = EnumSet<Feature>;
static_assert(static_cast<int>(Feature::kCount) < 256);  // Feature's own type

/// Returns the feature of a kind of material.
constexpr Feature ShadeFeature(ShadeKind kind) {
  constexpr Feature kFeatures[] = {
#define X(name, traits, meaning) Feature::k##name,
      LANELIGHT_SHADE_KINDS(X)
#undef X
          Feature::kMix,
      Feature::kInterfaces};
  static_assert(std::size(kFeatures) == kNumShadeKinds + 2);
  return kFeatures[static_cast<int>(kind)];
}

/// Returns the kinds of materials with a trait.
constexpr FeatureSet KindsWith(ShadeTraits trait) {
  FeatureSet features;
  for (int k = 0; k < kNumShadeKinds; ++k) {
    const auto kind = static_cast<ShadeKind>(k);
    if (HasTrait(kind, trait)) features.Add(ShadeFeature(kind));
  }
  return features;
}

/// The features that a choice of a strategy turns on, from the lists in
/// src/vocabulary/strategy/choices.h.
#define LANELIGHT_AXIS(Type, ...) FeatureSet TurnsOn(Type choice);
LANELIGHT_AXES(LANELIGHT_AXIS)
#undef LANELIGHT_AXIS

/// Returns the identifier without the leading k, e.g. "ConductorRough".
const char* FeatureName(Feature f);
/// Returns the meaning from the list above.
const char* FeatureMeaning(Feature f);
/// Describes a scene without the feature: "no thin lens", "not points=sobol".
std::string WithoutFeature(Feature f);

}  // namespace lanelight
