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
/// Its second vertex is offered to others.
constexpr bool Serves(std::uint32_t state) {
  return state >= static_cast<std::uint32_t>(ReuseState::kSecond);
}
/// And what it sends depends on where to.
constexpr bool ServesGlossily(std::uint32_t state) {
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
/// Those that make a vertex the first one: their value for a pair of directions is known,
/// and so is the density with which they find one.
inline constexpr std::uint32_t kReceivingKinds =
    KindBits(kPlainShading, kSpecularOnly | kWalks | kInMedium);
/// Those of second vertices that serve others: what is sent to all directions on a side
/// is the same, or depends on the direction. (Glass sends little but where it refracts;
/// hair is met elsewhere across its width by each path.)
inline constexpr std::uint32_t kEvenSidedKinds = KindBits(kEvenSides);
inline constexpr std::uint32_t kGlossyKinds =
    KindBits(kPlainShading, kSpecularOnly | kWalks | kInMedium | kEvenSides |
                                kRefracting | kTabulated | kFibre);
/// Of a metal that serves others, at least: a narrow lobe has nothing for most of them.
inline constexpr float kLeastGlossyAlpha = 0.1f;

/// What is kept of a first vertex, of what there is; `fibres`: some may be hair,
/// `measured`: or a table by wavelength.
inline FieldSet FirstVertexFields(bool fibres, bool measured) {
  using namespace fields;
  return (fibres ? FieldSet{Field::uv_v} : FieldSet{}) |
         (measured ? FieldSet{Field::wavelength} : FieldSet{}) | kThroughput | kPoint |
         kNormal | kTangent | kParameters |
         FieldSet{Field::pixel, Field::sample, Field::depth, Field::d_x,
                  Field::d_y,   Field::d_z,    Field::prim,  Field::material};
}

/// What is kept of a second vertex that is glossy, of what there is: of its material.
inline FieldSet GlossyVertexFields() {
  using namespace fields;
  return kNormal | kTangent | kParameters | FieldSet{Field::material};
}

// Of each sample of a task, beside the columns of its first vertex: X(type, name,
// meaning). Vectors are in the scene's space.
#define LANELIGHT_REUSE_COLUMNS(X)                                                \
  X(u32, state, "ReuseState when the path ended")                                 \
  X(f32, before_r,                                                                \
    "radiance gathered up to the second vertex, what that emits included")        \
  X(f32, before_g, "radiance gathered up to the second vertex")                   \
  X(f32, before_b, "radiance gathered up to the second vertex")                   \
  X(f32, x, "the second vertex")                                                  \
  X(f32, y, "the second vertex")                                                  \
  X(f32, z, "the second vertex")                                                  \
  X(f32, p_error, "offset along its normal that clears its rounding error")       \
  X(f32, ng_x, "geometric normal there, on the side that the path has come from") \
  X(f32, ng_y, "geometric normal there")                                          \
  X(f32, ng_z, "geometric normal there")                                          \
  X(f32, ns_x, "shading normal there, likewise")                                  \
  X(f32, ns_y, "shading normal there")                                            \
  X(f32, ns_z, "shading normal there")

struct ReuseColumns {
#define X(type, name, meaning) type* name = nullptr;
  LANELIGHT_REUSE_COLUMNS(X)
#undef X
};

// The same of second vertices that are glossy. Colours are radiance that the path itself
// gets, until kernels/reuse/own_light.cc; then they are without what the material makes
// of light from there.
#define LANELIGHT_GLOSSY_COLUMNS(X)                                                   \
  X(f32, light_x, "direction of the light sample, unit, scene")                       \
  X(f32, light_y, "direction of the light sample")                                    \
  X(f32, light_z, "direction of the light sample")                                    \
  X(f32, next_x, "direction in which the path goes on, unit, scene")                  \
  X(f32, next_y, "direction in which the path goes on")                               \
  X(f32, next_z, "direction in which the path goes on")                               \
  X(f32, lit_r, "of the light sample")                                                \
  X(f32, lit_g, "of the light sample")                                                \
  X(f32, lit_b, "of the light sample")                                                \
  X(f32, hit_r, "of that and of lights that the path hits next; then of these alone") \
  X(f32, hit_g, "of lights that the path hits next")                                  \
  X(f32, hit_b, "of lights that the path hits next")                                  \
  X(f32, far_r, "of all further ones, times the density of its own direction")        \
  X(f32, far_g, "of all further ones")                                                \
  X(f32, far_b, "of all further ones")                                                \
  X(f32, beta_r, "throughput up to the second vertex, with what led to it")           \
  X(f32, beta_g, "throughput up to the second vertex")                                \
  X(f32, beta_b, "throughput up to the second vertex")                                \
  X(f32, sent, "brightest channel of what it has for others, as its path gets it")

struct GlossyColumns {
#define X(type, name, meaning) type* name = nullptr;
  LANELIGHT_GLOSSY_COLUMNS(X)
#undef X
};

/// Columns of a path that are kept, and where.
struct KeptColumns {
  const std::uint32_t* from[kNumFields];
  std::uint32_t* to[kNumFields];
  std::uint32_t count = 0;
};

// Of each pair of a second vertex j and a first one i, densities in area measure at j.
#define LANELIGHT_PAIR_COLUMNS(X)                                              \
  X(f32, f_r, "throughput to the camera: of the prefix of i, and from j to i") \
  X(f32, f_g, "throughput to the camera")                                      \
  X(f32, f_b, "throughput to the camera")                                      \
  X(f32, pdf_area, "density with which i would have found j")                  \
  X(f32, visible, "1 or 0")

struct PairColumns {
#define X(type, name, meaning) type* name = nullptr;
  LANELIGHT_PAIR_COLUMNS(X)
#undef X
};

/// Room for a vector of any target.
inline constexpr std::uint32_t kMostLanes = 16;

struct Wave;

/// Of what a second vertex sends, that which has one set of weights. Its colour is in the
/// f of its pairs already where it is not even.
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
  KeptColumns first_columns, glossy_columns;

  const std::uint32_t* records = nullptr;  // of the block
  std::uint32_t size = 0;                  // at most kMostReusedPaths
  std::uint32_t sample = 0;                // of the task
  // Roulette on second vertices: a uniform number of the block, and from what brightness
  // on they are kept (kernels/reuse/block-inl.h).
  float u = 0, surely_kept = 0;

  // Receivers: records with a first vertex, by kind of its material, each kind padded to
  // whole vectors by its last.
  std::uint32_t* receivers = nullptr;
  std::uint32_t num_receivers = 0;
  // Second vertices that carry light, a row of pairs each, and then more rows of glossy
  // ones, which share the rays of the first.
  SuffixRow rows[2 * kMostReusedPaths];
  std::uint32_t num_suffixes = 0, num_rows = 0;
  // Pair of row s and receiver r: s * num_receivers + r.
  PairColumns pairs;
  float* sums[3] = {};  // what each receiver gets
};

}  // namespace lanelight
