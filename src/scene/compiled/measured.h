// Measured reflectance as the kernels read it (src/base/image/measured_reflectance.h).
#pragma once

#include <cstdint>

#include "src/base/core/aligned.h"

namespace lanelight {

/// Slices of a bilinear function, in MeasuredTable::values.
struct MeasuredGrid {
  std::int32_t at;  // of the first number
  std::int32_t width, height;
};
static_assert(sizeof(MeasuredGrid) == 12);

/// A bilinear density, each slice of which is normalised over its cells, and its
/// integrals: along each row up to each number, and over all before each row.
struct MeasuredWarp {
  MeasuredGrid grid;
  std::int32_t along, before;
};
static_assert(sizeof(MeasuredWarp) == 20);

/// A material of kind Measured: 32 words.
struct MeasuredRecord {
  std::int32_t phis, thetas;      // of known directions
  std::int32_t phi_at, theta_at;  // their angles, radians
  std::uint32_t turns;            // 1: azimuths of normals do not count from theirs
  std::int32_t parts;             // MeasuredReflectance::parts
  MeasuredGrid ndf, sigma;
  MeasuredWarp vndf, luminance;
  MeasuredGrid reflectance;  // three slices each; with kSpectral as many as wavelengths
  std::int32_t wavelengths;  // with kSpectral: of the file
  std::int32_t bins;  // with kSpectral: where bins lie among these, a number for each bin
  std::int32_t pad[5];
};
static_assert(sizeof(MeasuredRecord) == 128);

struct MeasuredTable {
  AlignedVector<MeasuredRecord> records;
  AlignedVector<float> values;
  AlignedVector<std::int32_t> of_material;  // record of each material; empty without any
  bool any_turns = false;                   // a record has
};

}  // namespace lanelight
