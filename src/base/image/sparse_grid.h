// Reads sparse grids from NanoVDB files.
#pragma once

#include <iosfwd>
#include <memory>
#include <string>

#include "src/base/core/sparse_grid.h"

namespace lanelight {

class GridBytes;

/// A NanoVDB grid as it lies in memory. Values may be float, Fp4, Fp8, Fp16 or FpN; other
/// types, level sets, values that are not finite, damage: InputError, without what it is
/// about. Nothing that the grid says of itself is believed: no lookup leaves its bytes.
std::shared_ptr<const SparseGrid> MakeSparseGrid(GridBytes bytes);

/// The first grid of that name in a NanoVDB file (.nvdb), whole or compressed by zip or
/// blosc; null if the file has none. InputError, without a place in the scene, names the
/// file by its path and says what of it is wrong.
std::shared_ptr<const SparseGrid> ReadSparseGrid(std::istream& file,
                                                 const std::string& path,
                                                 const std::string& name);
/// The same; opens the file itself.
std::shared_ptr<const SparseGrid> ReadSparseGrid(const std::string& path,
                                                 const std::string& name);

}  // namespace lanelight
