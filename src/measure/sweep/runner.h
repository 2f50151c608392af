// Fills the directory of a sweep, together with any number of other processes.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "src/measure/sweep/sweep_file.h"
#include "src/render/job/parts.h"
#include "src/render/run/run.h"

namespace lanelight {

struct SweepOptions {
  std::string out;
  /// This process renders the cells whose index leaves part.index - 1 when divided by
  /// part.count.
  Part part = {};
  bool wait = false;  // for cells that other processes render, and do them if those die
  bool table_only = false;  // render nothing
};

struct SweepProgress {
  std::size_t done = 0, total = 0;  // cells of this process's part; failed ones count
  const SweepCell* cell = nullptr;
  Progress render;  // of the cell
};

struct SweepHooks {
  std::function<void(const SweepProgress&)> on_progress;
  std::function<void(const std::string&)> on_problem;  // a line of text
  const std::atomic<bool>* stop = nullptr;             // ends after giving up the cell
};

struct CellFailure {
  std::string name, message;
};

struct SweepOutcome {
  std::size_t rendered = 0;              // by this process
  std::size_t done = 0, total = 0;       // of the whole sweep, at the end
  std::size_t elsewhere = 0;             // of this part: other processes have them
  std::size_t without_target = 0;        // of this part: this machine lacks their target
  std::vector<CellFailure> failures;     // of the whole sweep, by index
  std::vector<std::string> other_cells;  // in the directory, and not of this sweep
  std::uint64_t invalid_samples = 0;     // of all cells that are done
  std::size_t differing = 0;             // the same: not what their files ask for
  bool interrupted = false;
};

/// Renders what is missing, and then writes sweep.csv and report.html of what there is.
/// Throws InputError if the directory cannot be written, or holds cells rendered
/// otherwise (see SweepFolder::Look); failures of single cells are in the outcome.
SweepOutcome RunSweep(const Sweep& sweep, const SweepOptions& options,
                      const SweepHooks& hooks);

}  // namespace lanelight
