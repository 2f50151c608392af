// The kinds of materials that have a shading kernel, with what the rest of the program
// must know of each. A kind gets a queue, a feature and a stage from its line.
#pragma once

#include <cstdint>

namespace lanelight {

/// Traits of a kind of material. kernels/shade/shade-inl.h checks each against the
/// members of its policy.
enum ShadeTraits : std::uint32_t {
  kPlainShading = 0,
  kSpecularOnly = 1 << 0,  // delta directions only: takes no light samples
  kChoosesLobe = 1 << 1,   // reads u_lobe
  kMicrofacets = 1 << 2,   // has a roughness
  kRefracting = 1 << 3,    // roulette must know the relative index
  kMetallic = 1 << 4,      // seen head-on: the Fresnel reflectance of color0, color1
  kClear = 1 << 5,         // seen head-on: white
  kInMedium = 1 << 6,      // a phase function: of points in a medium, not of surfaces
  kWalks = 1 << 7,         // its value is that of a random walk
  kEvenSides = 1 << 8,     // sends the same light to all directions on a side
  kTabulated = 1 << 9,     // how narrow its lobes are is not known
  kFibre = 1 << 10,        // of a fibre along dp/du, met where v says
};

// X(name, traits, meaning)
// clang-format off
#define LANELIGHT_SHADE_KINDS(X)                                                       \
  X(Diffuse, kEvenSides, "Lambertian diffuse material")                             \
  X(DiffuseUniform, kEvenSides, "uniform-scattering diffuse material")              \
  X(DiffuseInSphere, kEvenSides, "in-sphere diffuse material")                      \
  X(ConductorSmooth, kSpecularOnly | kMetallic, "smooth conductor")     \
  X(ConductorRough, kMicrofacets | kMetallic, "rough conductor")        \
  X(DielectricSmooth, kSpecularOnly | kChoosesLobe | kRefracting | kClear, "smooth dielectric") \
  X(DielectricRough, kMicrofacets | kChoosesLobe | kRefracting | kClear, "rough dielectric") \
  X(ThinDielectric, kSpecularOnly | kChoosesLobe | kClear, "thin dielectric")          \
  X(CoatedDiffuseSmooth, kChoosesLobe, "smooth coated diffuse")                        \
  X(CoatedDiffuseRough, kMicrofacets | kChoosesLobe, "rough coated diffuse")           \
  X(CoatedConductor, kMicrofacets | kChoosesLobe | kMetallic | kWalks, "coated conductor") \
  X(CoatedDiffuseMedium, kMicrofacets | kChoosesLobe | kWalks, "coated diffuse with a scattering medium between") \
  X(CoatedConductorMedium, kMicrofacets | kChoosesLobe | kMetallic | kWalks, "coated conductor with a scattering medium between") \
  X(DiffuseTransmission, kChoosesLobe | kEvenSides, "diffuse transmission")          \
  X(Measured, kTabulated, "measured reflectance")                                   \
  X(Hair, kChoosesLobe | kFibre, "hair")                                             \
  X(HenyeyGreenstein, kInMedium, "Henyey-Greenstein phase function")
// clang-format on

enum class ShadeKind : std::uint32_t {
#define X(name, traits, meaning) k##name,
  LANELIGHT_SHADE_KINDS(X)
#undef X
      kCount,
  kMix = kCount,  // resolved by the mix stage, has no kernel
  kInterface      // bounds a medium and does nothing else: paths go through
};
inline constexpr int kNumShadeKinds = static_cast<int>(ShadeKind::kCount);

inline constexpr std::uint32_t kTraitsOfShadeKinds[] = {
#define X(name, traits, meaning) traits,
    LANELIGHT_SHADE_KINDS(X)
#undef X
};

/// Returns whether a kind has a kernel; a mix does not: it has been replaced by another
/// kind.
constexpr bool IsShaded(ShadeKind kind) { return kind < ShadeKind::kCount; }

/// Returns whether a kind has a trait; kinds that are not shaded have none.
constexpr bool HasTrait(ShadeKind kind, ShadeTraits trait) {
  return IsShaded(kind) && (kTraitsOfShadeKinds[static_cast<int>(kind)] & trait) != 0;
}

}  // namespace lanelight
