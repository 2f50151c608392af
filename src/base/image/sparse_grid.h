// Reads sparse grids from NanoVDB files.
#pragma once

#include <iosfwd>
#include <memory>
#include <string>

#include "src/base/core/sparse_grid.h"

namespace lanelight {

class GridBytes;

/// Checks a NanoVDB grid in memory, so that no lookup leaves its bytes. Values may be
/// float, Fp4, Fp8, Fp16 or FpN. InputError, without the name of the grid, for other
/// types, level sets, values that are not finite, and damage.
std::shared_ptr<const SparseGrid> MakeSparseGrid(GridBytes bytes);

/// Reads the first grid of that name in a NanoVDB file (.nvdb), uncompressed or
/// compressed by zip or blosc; null if the file has none. InputError names the file by
/// its path.
std::shared_ptr<const SparseGrid> ReadSparseGrid(std::istream& file,
                                                 const std::string& path,
                                                 const std::string& name);
/// The same; opens the file itself.
std::shared_ptr<const SparseGrid> ReadSparseGrid(const std::string& path,
                                                 const std::string& name);

}  // namespace lanelight
