// What reuse=block keeps of the paths of a task until they have ended: the first vertex
// of each, where it receives light, and the second, which others may see as well. Then
// the paths of a block, one sample each of some pixels of the tile, are connected
// (kernels/reuse/).
#pragma once

#include <cstdint>

#include "src/path/fields.h"
#include "src/path/shade_kinds.h"
#include "src/strategy/strategy.h"

namespace lanelight {

/// How far a path has come (column `reuse`).
enum class ReuseState : std::uint32_t {
  kNoVertex,  // it has met mirrors and the like only
  kFirst,     // its first vertex is kept; what it meets next is its second
  kSecond,    // that one is kept too: what the path gathers from there is offered to all
  kOwn        // its second vertex serves nobody else
};

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
/// Those of second vertices that serve others.
inline constexpr std::uint32_t kEvenSidedKinds = KindBits(kEvenSides);

/// What is kept of a first vertex, of what there is.
inline FieldSet FirstVertexFields() {
  using namespace fields;
  return kThroughput | kPoint | kNormal | kTangent | kParameters |
         FieldSet{Field::pixel, Field::sample,   Field::depth,
                  Field::d_x,   Field::d_y,      Field::d_z,
                  Field::prim,  Field::material, Field::guide_cell};
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

/// The block that is being connected, and what kernels know of all of the task.
/// A record is a sample in the order of samples, then of pixels: sample * num_pixels +
/// place of its pixel in the task.
struct Block {
  ReuseColumns second;  // by record
  // First vertices, as a wave whose slots are records: kernels that read surfaces read
  // them there. Columns from a path's to it.
  Wave* first = nullptr;
  const std::uint32_t* from[kNumFields];
  std::uint32_t* to[kNumFields];
  std::uint32_t num_columns = 0;

  const std::uint32_t* records = nullptr;  // of the block
  std::uint32_t size = 0;                  // at most kMostReusedPaths
  std::uint32_t sample = 0;                // of the task
  // Roulette on second vertices: a uniform number of the block, and the mean of what
  // those of the tile send that do, in this sample.
  float u = 0, mean_sent = 0;

  // Receivers: records with a first vertex, by kind of its material, each kind padded to
  // whole vectors by its last.
  std::uint32_t* receivers = nullptr;
  std::uint32_t num_receivers = 0;
  // Second vertices that carry light.
  std::uint32_t suffixes[kMostReusedPaths];
  float weights[kMostReusedPaths];  // 1 / probability that roulette has left them
  std::uint32_t num_suffixes = 0;
  // Pair of suffix s and receiver r: s * num_receivers + r.
  PairColumns pairs;
  float* sums[3] = {};  // what each receiver gets
};

}  // namespace lanelight
