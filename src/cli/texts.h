// Texts of commands: summaries, tables, errors and notes.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "src/cli/exit_codes.h"
#include "src/measure/compare/comparison.h"
#include "src/measure/stress/suite.h"
#include "src/measure/study/study.h"
#include "src/render/estimate/estimate.h"
#include "src/render/job/merge.h"
#include "src/render/job/profile_report.h"
#include "src/render/job/report.h"
#include "src/scene/description/note.h"

namespace lanelight {

/// Options of a summary.
struct SummaryChoice {
  bool verbose = false;    // times, machine and the cost of each stage too
  std::string checkpoint;  // the state to go on from; empty: none
};

/// Returns image, error, time, speed, and the cost of a smaller error.
std::string SummaryText(const RenderReport& report, const Job& job,
                        const SummaryChoice& choice);

/// Returns the summary of merged states.
std::string MergeSummaryText(const RenderReport& report, const MergedRender& merged,
                             bool verbose);

/// Says that and why the image differs from what the scene file asks for; empty if it
/// does not.
std::string DiffersRow(const std::vector<Note>& notes);

/// Says what paths carry, and why if the scene decides.
std::string TransportText(const Job& job);

/// Returns the root of the relative MSE, "1.71 % [1.69, 1.73]", or a lower bound and why
/// there is no upper one.
std::string PercentText(const ErrorEstimate& error);

/// Returns the error without reasons, for the progress line: "unknown", "at least 1.2 %".
std::string BriefPercentText(const ErrorEstimate& error);

/// Returns "RMSE 0.0123 [0.0120, 0.0126], relative MSE ...", or why there is no estimate.
std::string ErrorText(const ErrorEstimate& error);

/// Returns lines "scene.pbrt:3:1: note: ... (and 12 more like it)": one for all notes
/// that differ in numbers only. At most eight kinds.
std::vector<std::string> NoteLines(const std::vector<Note>& notes);

/// Returns a line for each measure, and the verdict.
std::string ComparisonText(const ImageComparison& comparison);

/// Returns the description of an image file. Throws InputError if it cannot be read.
nlohmann::json ImageInfoJson(const std::string& path);

/// Returns the text of ImageInfoJson().
std::string ImageInfoText(const nlohmann::json& info);

/// Returns the cost of each stage of a render.
std::string StageCostText(const RunResult& result);

/// Returns what was rendered, the row that takes most of the time, and the cost of a
/// sample, in one line.
std::string ProfileAnswer(const ProfileReport& report, const Job& job,
                          const RunResult& result);

/// Returns what was rendered, the most expensive stage, and bars of groups and stages: at
/// most kProfileLines lines that fit the terminal, as far as names allow. `verbose`: all
/// stages and columns, peaks, bounces and materials instead.
inline constexpr std::size_t kProfileLines = 40;
std::string ProfileText(const ProfileReport& report, const Job& job,
                        const RunResult& result, const std::string& scene, bool verbose);

/// Returns a row per case, notes under failed ones, and the summary.
std::string StressTable(const stress::SuiteResult& result);

/// Returns name, extreme, expectation and source of every case, by group.
std::string StressList(const std::vector<stress::Case>& cases);

/// Returns the exit code: a failed case outweighs an interruption; a weak case is no
/// failure.
inline ExitCode ExitCodeOf(const stress::SuiteResult& result) {
  if (result.Count(stress::Outcome::kFailed) > 0) return kExitStressFailed;
  return result.interrupted ? kExitInterrupted : kExitGood;
}

/// Returns ranking table and verdict of one scene.
std::string StudySummary(const SceneStudy& study, const StudyOptions& options);

}  // namespace lanelight
