// Writes the results of a run for programs and for the page: stress.json
// (docs/stress.md).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "src/measure/stress/suite.h"

namespace lanelight::stress {

/// The whole run. Numbers that are not known, or not finite, are null; a limit of the
/// promised range that there is not is null too.
nlohmann::json ToJson(const SuiteResult& result);

/// One sentence: that all is good, or what is not.
std::string Sentence(const SuiteResult& result);

/// Makes DIR. Throws InputError with the system's reason, also if nothing can be written
/// there: to be called before hours of measuring.
void MakeResultsFolder(const std::string& dir);

/// Writes DIR/stress.json and DIR/report.html, each whole or not at all; makes DIR.
/// Throws InputError with the system's reason.
void WriteResults(const SuiteResult& result, const std::string& dir);

}  // namespace lanelight::stress
