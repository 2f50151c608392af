#include "src/measure/sweep/runner.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>
#include <set>
#include <thread>

#include "src/base/core/file_lock.h"
#include "src/measure/sweep/cell_render.h"
#include "src/measure/sweep/race.h"
#include "src/measure/sweep/results.h"
#include "src/measure/sweep/sweep_folder.h"
#include "src/render/job/memory.h"

namespace lanelight {
namespace {

// State of a cell as far as this process knows.
enum class CellStatus { kMissing, kDone, kFailed, kElsewhere, kNoTarget, kStopped };

class Runner {
 public:
  Runner(const Sweep& sweep, const SweepOptions& options, const SweepHooks& hooks,
         SweepFolder& folder)
      : sweep_(sweep),
        options_(options),
        hooks_(hooks),
        folder_(folder),
        claims_(folder.File("claims")),
        renderer_(sweep, folder.Outputs()) {
    if (options.race) race_.emplace(sweep);
  }

  // Returns the cells that were finished before; the others are null.
  CellResults Run(SweepOutcome& outcome) {
    if (!claims_.supports_locks() && options_.part.count == 1) {
      throw InputError(
          "the file system of '{}' does not support locks, which several processes need; "
          "give each process its own part with --part I/N",
          claims_.path());
    }
    FindPart();
    if (race_) SortByRound();
    FirstOfAll();
    Help();
    if (options_.wait) WaitForOthers();
    outcome.rendered = rendered_;
    outcome.elsewhere = Count(CellStatus::kElsewhere);
    outcome.without_target = Count(CellStatus::kNoTarget);
    outcome.interrupted = interrupted_;
    return std::move(results_);
  }

 private:
  using Group =
      std::vector<std::size_t>;  // indices into part_: cells of one compiled scene

  void FindPart() {
    std::map<std::string, std::size_t> group_of;
    ReadMissing(sweep_, folder_, results_);
    for (const SweepCell& cell : sweep_.cells) {
      nlohmann::json& known = results_[cell.index].json;
      const bool done = known["status"] == Name(CellState::kDone);
      const bool failed = known["status"] == Name(CellState::kFailed);
      if (!done) known = nullptr;  // it is read again at the end
      const auto [index, count] = options_.part;
      if (cell.index % std::size_t(count) != std::size_t(index - 1)) continue;
      const auto [entry, is_new] =
          group_of.try_emplace(renderer_.SceneKey(cell), groups_.size());
      if (is_new) groups_.emplace_back();
      groups_[entry->second].push_back(part_.size());
      part_.push_back(&cell);
      known_.push_back(done                             ? CellStatus::kDone
                       : !CellRenderer::HasTarget(cell) ? CellStatus::kNoTarget
                                                        : CellStatus::kMissing);
      failed_before_.push_back(failed);
    }
  }

  // All strategies race with the first seeds before any has the next one.
  void SortByRound() {
    for (Group& group : groups_) {
      std::ranges::sort(group, {}, [this](std::size_t i) {
        return std::pair(race_->Round(part_[i]->index), i);
      });
    }
  }

  // Returns whether the cell's strategy has lost its race, by all finished cells.
  bool HasLost(const SweepCell& cell) {
    for (const std::size_t rival : race_->Rivals(cell.index)) {
      if (!race_->HasEntered(rival)) EnterIfDone(*race_, folder_, sweep_.cells[rival]);
    }
    return race_->IsStopped(cell.index);
  }

  // Renders scenes that no process has claimed, so that no scene is compiled twice as
  // long as there are some.
  void FirstOfAll() {
    for (const Group& group : groups_) {
      if (std::ranges::all_of(
              group, [&](std::size_t i) { return known_[i] != CellStatus::kMissing; })) {
        continue;
      }
      const auto claim = claims_.TryLock("scene of " + part_[group.front()]->name);
      if (!claim) continue;
      for (const std::size_t i : group) {
        if (IsStopped() || interrupted_) return;
        TryCell(i);
      }
    }
  }

  // Renders cells of scenes claimed by other processes, from their ends, starting at a
  // place that depends on the process, to avoid conflicts.
  void Help() {
    std::vector<std::size_t> rest;
    for (const Group& group : groups_) {
      std::vector<std::size_t> missing;
      for (const std::size_t i : group) {
        if (known_[i] == CellStatus::kMissing) missing.push_back(i);
      }
      if (!race_) std::ranges::reverse(missing);
      if (!missing.empty() && !race_) {
        const auto place = std::size_t(getpid()) * 7 % missing.size();
        std::rotate(missing.begin(), missing.begin() + long(place), missing.end());
      }
      rest.insert(rest.end(), missing.begin(), missing.end());
    }
    for (const std::size_t i : rest) {
      if (IsStopped() || interrupted_) break;
      TryCell(i);
    }
    interrupted_ |= IsStopped();
  }

  void WaitForOthers() {
    constexpr auto kPause = std::chrono::milliseconds(200);
    while (!interrupted_ && Count(CellStatus::kElsewhere) > 0) {
      for (std::size_t i = 0; i < part_.size() && !IsStopped(); ++i) {
        if (known_[i] == CellStatus::kElsewhere) TryCell(i);
      }
      interrupted_ |= IsStopped();
      std::this_thread::sleep_for(kPause);
    }
  }

  void TryCell(std::size_t i) {
    if (known_[i] != CellStatus::kMissing && known_[i] != CellStatus::kElsewhere) return;
    if (race_ && HasLost(*part_[i])) {
      known_[i] = CellStatus::kStopped;
      return;
    }
    const auto claim = claims_.TryLock(part_[i]->name);
    if (!claim) {
      known_[i] = CellStatus::kElsewhere;
      return;
    }
    if (StillMissing(i)) RenderCell(i);
  }

  // Another process may have rendered the cell since this one looked.
  bool StillMissing(std::size_t i) {
    const CellState state = folder_.ReadCell(*part_[i]).state;
    if (state == CellState::kDone) known_[i] = CellStatus::kDone;
    if (state == CellState::kFailed && !failed_before_[i])
      known_[i] = CellStatus::kFailed;
    return known_[i] == CellStatus::kMissing || known_[i] == CellStatus::kElsewhere;
  }

  void RenderCell(std::size_t i) {
    const SweepCell& cell = *part_[i];
    // Throws: without a writable directory, no further result can be kept.
    folder_.CheckWritable();
    folder_.MakeCell(cell);
    Report(cell, {});
    RenderHooks hooks;
    hooks.on_progress = [&](const Progress& p) { Report(cell, p); };
    hooks.stop = hooks_.stop;
    try {
      const Rendering rendering =
          renderer_.Render(cell, folder_.path() + "/cells/" + cell.name, hooks);
      if (rendering.report.result.stopped_early) {
        folder_.RemoveImages(cell);
        known_[i] = CellStatus::kMissing;
        interrupted_ = true;
        return;
      }
      if (!rendering.problems.empty()) {
        folder_.CheckWritable();
        std::string text;
        for (const std::string& problem : rendering.problems) text += problem + "; ";
        return Fail(i, text.substr(0, text.size() - 2));
      }
      folder_.Finish(cell, CellReport(rendering));
      known_[i] = CellStatus::kDone;
      ++rendered_;
    } catch (const WouldOverwrite&) {
      throw;
    } catch (const std::bad_alloc&) {
      Fail(i, "error: " + OutOfMemoryText());
    } catch (const std::exception& error) {
      folder_.CheckWritable();
      Fail(i, error.what());
    }
  }

  void Fail(std::size_t i, const std::string& message) {
    const SweepCell& cell = *part_[i];
    known_[i] = CellStatus::kFailed;
    folder_.Fail(cell, message);
    // All cells of a broken scene have the same message.
    if (!said_.insert(message).second || !hooks_.on_problem) return;
    hooks_.on_problem(cell.name + ": " + message);
  }

  void Report(const SweepCell& cell, const Progress& progress) {
    if (!hooks_.on_progress) return;
    const std::size_t done = Count(CellStatus::kDone) + Count(CellStatus::kFailed) +
                             Count(CellStatus::kStopped);
    hooks_.on_progress({done, part_.size(), &cell, progress});
  }

  bool IsStopped() const { return hooks_.stop != nullptr && *hooks_.stop; }
  std::size_t Count(CellStatus what) const {
    return std::size_t(std::ranges::count(known_, what));
  }

  const Sweep& sweep_;
  const SweepOptions& options_;
  const SweepHooks& hooks_;
  SweepFolder& folder_;
  const LockFile claims_;  // of cells and scenes, by their names
  CellRenderer renderer_;
  std::optional<Race> race_;
  std::vector<const SweepCell*> part_;  // cells of this process
  std::vector<CellStatus> known_;       // of each
  std::vector<bool> failed_before_;     // failed before this process started; retried
  std::vector<Group> groups_;
  CellResults results_;
  std::set<std::string> said_;  // reported failures
  std::size_t rendered_ = 0;
  bool interrupted_ = false;
};

}  // namespace

SweepOutcome RunSweep(const Sweep& sweep, const SweepOptions& options,
                      const SweepHooks& hooks) {
  SweepFolder folder(options.out, sweep);
  folder.Make();
  SweepOutcome outcome;
  CellResults results;
  if (!options.table_only) results = Runner(sweep, options, hooks, folder).Run(outcome);
  // Processes write results one after the other, so that the last one includes all cells.
  const LockFile claims(folder.File("claims"));
  const auto claim = claims.Wait("the table", [](double) { return true; });
  WriteResults(sweep, folder, options.race, std::move(results), outcome);
  return outcome;
}

}  // namespace lanelight
