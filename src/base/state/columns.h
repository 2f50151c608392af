// Writes columns as datasets of a state file, and reads them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "src/base/core/column.h"
#include "src/base/state/hdf5.h"
#include "src/base/state/tiles.h"

namespace lanelight {

/// Writes the rows of a column that `tiles` names, or all if it is null. Compressed, that
/// takes memory of a few chunks.
void WriteColumn(hid_t group, const StateColumn& column, const TileRows* tiles,
                 bool compress);

/// Returns whether `group` ("pixels", "tables", or "", the file) has a column of this
/// name.
bool HasColumn(hid_t file, const std::string& group, const std::string& name);
/// Its rows; throws hdf5::Failure if there is none.
std::size_t ColumnRows(hid_t file, const std::string& group, const std::string& name);

/// Fills the columns: the rows that `tiles` names, or all if it is null. Throws
/// hdf5::Failure before anything is read if a column is not there with its type, shape
/// and number of rows.
void ReadColumns(hid_t file, const std::string& group,
                 const std::vector<MutableStateColumn>& into, const TileRows* tiles);

}  // namespace lanelight
