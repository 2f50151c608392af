// The state of a render as a file: HDF5, compressed, with checksums; docs/state.md says
// what is in it. A file that is torn, cut or has a bit flipped is refused before anything
// of it is used.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "src/base/core/aligned.h"
#include "src/base/core/column.h"
#include "src/base/image/pixel_rect.h"

namespace lanelight {

/// Schema of state files; files with another number are refused.
inline constexpr std::uint64_t kStateSchema = 1;

/// Content of a state file.
struct StateContent {
  std::string identity;  // of the run, JSON
  std::string report;    // what it has done so far, JSON
  PixelRect window;      // of the film
  /// The tiles whose pixels the file holds: inside the window, not empty, not
  /// overlapping, in any order.
  std::vector<PixelRect> tiles;
  /// One row per pixel of the window, row by row; the file holds those of the tiles.
  std::vector<StateColumn> pixels;
  std::vector<StateColumn> tables;  // whole
  bool compress = true;  // takes ten times as long as to write them as they are
};

/// Compresses the content in the calling thread, writes it to a temporary file and
/// renames it to `path`, flushed to disk. `path` is the old or the new state at any time.
/// Needs memory of the file's size. Throws InputError with path and reason on failure
/// (full disk, no permission, missing directory); the old file then stays. Inconsistent
/// content (missing rows, overlapping tiles, repeated names) fails a check. The same
/// content gives the same bytes.
void WriteState(const StateContent& content, const std::string& path);

/// A copy of a content, to be written while the render goes on: all its columns, in
/// memory that is freed with it.
class StateCopy {
 public:
  /// Copies with all threads. Afterwards the columns may change.
  explicit StateCopy(const StateContent& content);
  void Write(const std::string& path) const { WriteState(content_, path); }

 private:
  StateContent content_;
  std::vector<UntouchedVector<char>> memory_;  // of its columns
};

/// A state on the disk, open. Renaming or removing `path` afterwards changes nothing.
class StateFile {
 public:
  /// Reads the whole file once and throws InputError unless it is a whole state of this
  /// schema, exactly as it was written.
  explicit StateFile(const std::string& path);
  ~StateFile();
  StateFile(StateFile&&) noexcept;
  StateFile& operator=(StateFile&&) noexcept;

  const std::string& path() const;
  const std::string& identity() const;
  const std::string& report() const;
  PixelRect window() const;
  const std::vector<PixelRect>& tiles() const;

  /// Puts the pixels of the file's tiles into the columns of a film of the pixels
  /// `window`, which must contain the tiles, and leaves all other pixels alone. Memory of
  /// a few chunks per thread. Throws InputError if the file has no column of such a name,
  /// type and shape, before anything is read; its further columns are passed over.
  void ReadPixels(const std::vector<MutableStateColumn>& into, PixelRect window) const;
  bool HasPixels(const std::string& name) const;

  bool HasTable(const std::string& name) const;
  /// Throws InputError if there is no such table.
  std::size_t TableRows(const std::string& name) const;
  /// Fills the column. Throws InputError if the file has no table of its name, type,
  /// shape and rows.
  void ReadTable(const MutableStateColumn& into) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lanelight
