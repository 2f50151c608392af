// The directory of a sweep: sweep.toml, claims, and a directory of every cell with
// image.exr and report.json, or error.json.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "src/measure/sweep/sweep_file.h"
#include "src/render/job/saving.h"

namespace lanelight {

enum class CellState { kMissing, kFailed, kDone };
/// "missing", "failed", "done".
const char* Name(CellState state);

/// What there is of a cell.
struct CellRecord {
  CellState state = CellState::kMissing;
  nlohmann::json report;  // of kDone
  std::string message;    // of kFailed
};

class SweepFolder {
 public:
  /// `sweep` must outlive the object.
  SweepFolder(std::string path, const Sweep& sweep);

  /// Makes the directory and puts a copy of the sweep file into it. Throws InputError,
  /// also for a scene that would be written over.
  void Make() const;
  /// What a sweep writes, besides the copy.
  OutputPaths Outputs() const;
  /// Throws InputError if nothing can be written into the directory (any longer).
  void CheckWritable() const;

  /// A finished cell of other settings, or of a scene that has changed since, is an
  /// InputError that says what differs; so is a file that this program did not write.
  CellRecord Look(const SweepCell& cell);

  /// Makes the directory of a cell that this process has claimed, and removes what a
  /// killed process may have left half written there.
  void MakeCell(const SweepCell& cell) const;
  /// Writes report.json, which makes the cell a finished one; `report` is the render's.
  void Finish(const SweepCell& cell, nlohmann::json report) const;
  void Fail(const SweepCell& cell, const std::string& message) const;
  /// Of a render that was ended early.
  void RemoveImages(const SweepCell& cell) const;

  std::string File(const SweepCell& cell, const std::string& name) const;
  std::string File(const std::string& name) const { return path_ + "/" + name; }
  const std::string& path() const { return path_; }
  /// Names of directories of cells that the sweep has not.
  std::vector<std::string> OtherCells() const;

 private:
  void CheckReport(const SweepCell& cell, const nlohmann::json& report);
  const std::string& SceneHash(const SweepCell& cell);

  std::string path_;
  const Sweep& sweep_;
  std::map<std::string, std::string> scene_hashes_;  // by path
};

}  // namespace lanelight
