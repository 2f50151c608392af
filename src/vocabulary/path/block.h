// Records of reuse=block for the paths of a task: the first vertex of each, which
// receives light, and the second, which other pixels may reuse. When the paths have
// ended, those of a block are connected (kernels/reuse/): one sample each of some pixels
// of the tile.
#pragma once

#include <cstdint>

#include "src/vocabulary/path/fields.h"
#include "src/vocabulary/path/shade_kinds.h"
#include "src/vocabulary/strategy/strategy.h"

namespace lanelight {

/// The progress of a path (column `reuse`).
enum class ReuseState : std::uint32_t {
  kNoVertex,  // it has met mirrors and the like only
  kFirst,     // its first vertex is kept; what it meets next is its second
  kOwn,       // its second vertex is not reused
  kSecond,    // it is kept too: what the path gathers from there is offered to all
  // The same of a second vertex that sends other light to others:
  kGlossy,   // not yet shaded
  kOnward,   // its light sample is kept; what comes next has been found by a density
  kFar,      // what was gathered before the vertex after it is kept as well
  kMirrored  // its light sample is kept; what comes next has been found by a mirror
};
/// Returns whether the second vertex is offered to other paths.
constexpr bool IsReusable(std::uint32_t state) {
  return state >= static_cast<std::uint32_t>(ReuseState::kSecond);
}
/// Returns whether, moreover, the radiance that it sends depends on the direction.
constexpr bool IsReusableGlossy(std::uint32_t state) {
  return state > static_cast<std::uint32_t>(ReuseState::kSecond);
}

/// Kinds of materials, a bit for each.
constexpr std::uint32_t KindBits(ShadeTraits with, std::uint32_t without = 0) {
  std::uint32_t bits = 0;
  for (int k = 0; k < kNumShadeKinds; ++k) {
    const std::uint32_t traits = kTraitsOfShadeKinds[k];
    const bool has = (traits & with) == with && (traits & without) == 0;
    bits |= std::uint32_t{has} << k;
  }
  return bits;
}
static_assert(kNumShadeKinds <= 32);
/// Kinds that make a vertex the first one: their value and their density for a pair of
/// directions are known.
inline constexpr std::uint32_t kReceivingKinds =
    KindBits(kPlainShading, kSpecularOnly | kWalks | kInMedium);
/// Kinds of second vertices that are reused: the radiance that they send is the same for
/// all directions on a side, or depends on the direction. (Glass sends little except
/// where it refracts; each path meets hair at another place across its width.)
inline constexpr std::uint32_t kEvenSidedKinds = KindBits(kEvenSides);
inline constexpr std::uint32_t kGlossyKinds =
    KindBits(kPlainShading, kSpecularOnly | kWalks | kInMedium | kEvenSides |
                                kRefracting | kTabulated | kFibre);
/// Smallest roughness of metals that are reused: narrower lobes contribute to few paths.
inline constexpr float kMinGlossyAlpha = 0.1f;

/// Returns the fields of a first vertex that are kept. `fibres`: some materials may be
/// hair. `measured`: some have tables by wavelength.
inline FieldSet FirstVertexFields(bool fibres, bool measured) {
  using namespace fields;
  return (fibres ? FieldSet{Field::uv_v} : FieldSet{}) |
         (measured ? FieldSet{Field::wavelength} : FieldSet{}) | kThroughput | kPoint |
         kNormal | kTangent | kParameters |
         FieldSet{Field::pixel, Field::sample, Field::depth, Field::d_x,
                  Field::d_y,   Field::d_z,    Field::prim,  Field::material};
}

/// Returns the fields of a glossy second vertex that are kept: those of its material.
inline FieldSet GlossyVertexFields() {
  using namespace fields;
  return kNormal | kTangent | kParameters | FieldSet{Field::material};
}

// Columns of each sample of a task, beside those of its first vertex: X(type, name,
// meaning). Vectors are in the scene's space.
#define LANELIGHT_REUSE_COLUMNS(X)                                                      \
  X(u32, state, "ReuseState when the path ended")                                       \
  LANELIGHT_RGB(X, f32, before,                                                         \
                "radiance gathered up to the second vertex, its emission included")     \
  X(f32, x, "the second vertex")                                                        \
  X(f32, y, "the second vertex")                                                        \
  X(f32, z, "the second vertex")                                                        \
  X(f32, p_error, "offset along the normal that exceeds the rounding error")            \
  LANELIGHT_XYZ(X, f32, ng, "geometric normal there, on the side of the incoming path") \
  LANELIGHT_XYZ(X, f32, ns, "shading normal there, on the same side")

struct ReuseColumns {
#define X(type, name, meaning) type* name = nullptr;
  LANELIGHT_REUSE_COLUMNS(X)
#undef X
};

// Columns of second vertices that are glossy. Colours are radiance that the path itself
// gets, until kernels/reuse/own_light.cc; then they are without what the material makes
// of light from there.
#define LANELIGHT_GLOSSY_COLUMNS(X)                                                     \
  LANELIGHT_XYZ(X, f32, light, "direction of the light sample, unit, scene")            \
  LANELIGHT_XYZ(X, f32, next, "direction of the next ray of the path, unit, scene")     \
  LANELIGHT_RGB(X, f32, lit, "radiance of the light sample")                            \
  LANELIGHT_RGB(X, f32, hit,                                                            \
                "radiance of the light sample and of lights that the next ray hits; "   \
                "later of the latter alone")                                            \
  LANELIGHT_RGB(                                                                        \
      X, f32, far,                                                                      \
      "radiance of all later vertices, times the density of the next ray's direction")  \
  LANELIGHT_RGB(X, f32, beta,                                                           \
                "throughput up to the second vertex, its own sampling weight included") \
  X(f32, sent,                                                                          \
    "brightest channel of the radiance that can be reused, as its own path receives it")

struct GlossyColumns {
#define X(type, name, meaning) type* name = nullptr;
  LANELIGHT_GLOSSY_COLUMNS(X)
#undef X
};

/// Columns of a path that are kept, and where.
struct StoredColumns {
  const std::uint32_t* from[kNumFields];
  std::uint32_t* to[kNumFields];
  std::uint32_t count = 0;
};

// Columns of each pair of a second vertex j and a first one i; densities are in area
// measure at j.
#define LANELIGHT_PAIR_COLUMNS(X)                                                \
  LANELIGHT_RGB(X, f32, f,                                                       \
                "throughput to the camera: of the prefix of i, and from j to i") \
  X(f32, pdf_area, "density with which i would have sampled j")                  \
  X(f32, visible, "1 or 0")

struct PairColumns {
#define X(type, name, meaning) type* name = nullptr;
  LANELIGHT_PAIR_COLUMNS(X)
#undef X
};

/// Lanes of the widest vectors of all targets.
inline constexpr std::uint32_t kMaxLanes = 16;

struct Wave;

/// The part of the radiance of a second vertex that has one set of weights. Unless it is
/// kEven, its colour is already in the f of its pairs.
enum class SuffixPart : std::uint32_t {
  kEven,  // all, alike to all
  kNear,  // of a glossy one, from its light sample and lights hit from there
  kFar    // what comes from further
};

/// A row of pairs, one for each receiver.
struct SuffixRow {
  std::uint32_t record = 0;
  std::uint32_t rays = 0;  // row that has the shadow rays
  float weight = 1;        // 1 / probability that roulette has left it
  SuffixPart part = SuffixPart::kEven;
};

/// The block that is being connected, and what kernels know of all of the task.
/// A record is a sample in the order of samples, then of pixels: sample * num_pixels +
/// place of its pixel in the task.
struct Block {
  ReuseColumns second;   // by record
  GlossyColumns glossy;  // by record; null without kReuseGlossy
  // First vertices, and second ones that are glossy, as waves whose slots are records:
  // kernels that read surfaces read them there.
  Wave* first = nullptr;
  Wave* glossy_surface = nullptr;
  StoredColumns first_columns, glossy_columns;

  const std::uint32_t* records = nullptr;  // of the block
  std::uint32_t size = 0;                  // at most kMaxReusedPaths
  std::uint32_t sample = 0;                // of the task
  // Roulette on second vertices: a uniform number of the block, and from what brightness
  // on they are kept (kernels/reuse/block-inl.h).
  float u = 0, certainly_kept = 0;

  // Receivers: records with a first vertex, by kind of its material, each kind padded to
  // whole vectors by its last.
  std::uint32_t* receivers = nullptr;
  std::uint32_t num_receivers = 0;
  // Second vertices that carry light, a row of pairs each, and then more rows of glossy
  // ones, which share the rays of the first.
  SuffixRow rows[2 * kMaxReusedPaths];
  std::uint32_t num_suffixes = 0, num_rows = 0;
  // Pair of row s and receiver r: s * num_receivers + r.
  PairColumns pairs;
  float* sums[3] = {};  // what each receiver gets
};

}  // namespace lanelight
