// Summarises a run in a sentence.
#include <fmt/format.h>

#include "src/base/core/text_layout.h"
#include "src/measure/stress/stress_json.h"

namespace lanelight::stress {
namespace {

std::string Cases(int count) {
  return fmt::format("{} case{}", count, count == 1 ? "" : "s");
}

std::vector<std::string> NamesOf(const SuiteResult& result, Outcome outcome) {
  std::vector<std::string> names;
  for (const CaseResult& one : result.cases) {
    if (one.outcome == outcome) names.push_back(one.about.name);
  }
  return names;
}

}  // namespace

std::string Sentence(const SuiteResult& result) {
  const std::string on = " on " + ListText(result.options.targets, 8);
  const std::vector<std::string> failed = NamesOf(result, Outcome::kFailed);
  const int total = static_cast<int>(result.cases.size());
  const int judged = total - result.Count(Outcome::kUnfinished);
  if (total == 0) return "No case was measured.";
  std::string text;
  if (failed.empty()) {
    text = (judged == 1 ? "The one case is" : fmt::format("All {} are", Cases(judged))) +
           " good" + on;
  } else {
    text = fmt::format("{} of {} fail{}{}: {}", failed.size(), Cases(judged),
                       failed.size() == 1 ? "s" : "", on, ListText(failed, 3));
  }
  const int weak = result.Count(Outcome::kWeak);
  if (weak > 0) {
    text += fmt::format("; {} {} {} points too noisy to detect an error of 10 %", weak,
                        failed.empty() ? "of them" : "more", weak == 1 ? "has" : "have");
  }
  if (judged < total) {
    text += fmt::format("; {} {} not measured completely", Cases(total - judged),
                        total - judged == 1 ? "was" : "were");
  }
  return text + ".";
}

}  // namespace lanelight::stress
