// The directory of a sweep: sweep.toml, claims, and a directory of every cell with
// image.exr and report.json, or error.json.
#pragma once

#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>

#include "src/measure/sweep/sweep_file.h"
#include "src/render/job/saving.h"

namespace lanelight {

/// kStopped: missing, since its race is decided without it (sweep --race).
enum class CellState { kMissing, kFailed, kDone, kStopped };
/// "missing", "failed", "done", "stopped".
const char* Name(CellState state);

/// The files of a cell.
struct CellRecord {
  CellState state = CellState::kMissing;
  nlohmann::json report;  // of kDone
  std::string message;    // of kFailed
};

class SweepFolder {
 public:
  /// `sweep` must outlive the object.
  SweepFolder(std::string path, const Sweep& sweep);

  /// Makes the directory with a copy of the sweep file. Throws InputError, also for a
  /// scene that would be overwritten.
  void Make() const;
  /// Returns the paths that a sweep writes, other than the copy.
  OutputPaths Outputs() const;
  /// Throws InputError if the directory is not writable.
  void CheckWritable() const;

  /// Reads a cell. Throws InputError that states the difference for a finished cell of
  /// other settings or of a changed scene, and for other files. Safe from several
  /// threads.
  CellRecord ReadCell(const SweepCell& cell);

  /// Makes the directory of a claimed cell, and removes temporary files of killed
  /// processes.
  void MakeCell(const SweepCell& cell) const;
  /// Writes report.json, which marks the cell as finished; `report`: of the render.
  void Finish(const SweepCell& cell, nlohmann::json report) const;
  void Fail(const SweepCell& cell, const std::string& message) const;
  /// Removes images of a render that was ended early.
  void RemoveImages(const SweepCell& cell) const;

  std::string File(const SweepCell& cell, const std::string& name) const;
  std::string File(const std::string& name) const { return path_ + "/" + name; }
  const std::string& path() const { return path_; }
  /// Returns names of directories that are not cells of the sweep.
  std::vector<std::string> OtherCells() const;

 private:
  void CheckReport(const SweepCell& cell, const nlohmann::json& report);
  std::string SceneHash(const SweepCell& cell);

  std::string path_;
  const Sweep& sweep_;
  std::mutex mutex_;
  std::map<std::string, std::string> scene_hashes_;  // by path; guarded by mutex_
};

}  // namespace lanelight
