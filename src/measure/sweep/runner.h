// Renders the cells of a sweep, together with any number of other processes.
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
  /// This process renders cells with index % part.count == part.index - 1.
  Part part = {};
  bool wait = false;  // waits for other processes, and renders their cells if they die
  bool table_only = false;  // renders nothing
  bool race = false;        // strategies that are clearly worse stop (race.h)
};

struct SweepProgress {
  std::size_t done = 0, total = 0;  // cells of this process's part; failed ones count
  const SweepCell* cell = nullptr;
  Progress render;  // of the cell
};

struct SweepHooks {
  std::function<void(const SweepProgress&)> on_progress;
  std::function<void(const std::string&)> on_problem;  // a line of text
  const std::atomic<bool>* stop = nullptr;             // aborts the current cell
};

struct CellFailure {
  std::string name, message;
};

struct SweepOutcome {
  std::size_t rendered = 0;              // by this process
  std::size_t done = 0, total = 0;       // of the whole sweep, at the end
  std::size_t elsewhere = 0;             // of this part, claimed by other processes
  std::size_t without_target = 0;        // of this part, whose target this machine lacks
  std::size_t stopped = 0;               // of the whole sweep, by --race
  double cpu_seconds = 0;                // of all finished cells
  std::string answer;                    // the best strategies (AnswerText)
  std::vector<CellFailure> failures;     // of the whole sweep, by index
  std::vector<std::string> other_cells;  // directories of other sweeps' cells
  std::uint64_t invalid_samples = 0;     // of all finished cells
  std::size_t differing = 0;  // finished cells that differ from their scene files
  bool interrupted = false;
};

/// Renders missing cells, and then writes sweep.csv and report.html of all finished
/// cells. Throws InputError if the directory is not writable, or has cells of other
/// settings (see SweepFolder::Look()); failures of single cells are in the outcome.
SweepOutcome RunSweep(const Sweep& sweep, const SweepOptions& options,
                      const SweepHooks& hooks);

struct CellPrediction {
  bool done = false;      // exists already; the other members are not set
  bool measured = false;  // by a probe of the same scene and strategy
  double seconds = 0;     // wall clock on this machine; NaN if unknown
  double bytes = 0;       // of its files; NaN if unknown
  std::string message;    // why it will fail; may be empty
};

struct SweepPrediction {
  std::vector<CellPrediction> cells;         // of all cells, in order
  std::size_t probes = 0, combinations = 0;  // of scene and strategy
};

/// Renders at most `max_probes` probes of different scenes and strategies. For
/// combinations without a probe, the relative cost of a strategy is that on other scenes.
/// The first cell of a scene includes the time of loading and building. Ends early once
/// `stop` is set.
SweepPrediction Predict(const Sweep& sweep, const std::string& out, int max_probes,
                        const std::atomic<bool>& stop);

/// Returns a table of the cells, and sums.
std::string PredictionText(const Sweep& sweep, const SweepPrediction& prediction);

}  // namespace lanelight
