// Estimated errors and notes on a scene, in words.

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <map>

#include "src/cli/texts.h"

namespace lanelight {
namespace {

constexpr const char* kBlack = "unknown: every sample is black";
constexpr const char* kUnknown =
    "unknown: needs 2 samples per pixel (4 with antithetic sampling)";

// Three digits, and no more zeros than these.
std::string Percent(double relative_mse) {
  const double percent = 100 * std::sqrt(relative_mse);
  return percent < 99.95 && percent >= 0.0001 ? fmt::format("{:#.3g}", percent)
                                              : fmt::format("{:.3g}", percent);
}

std::string PercentOf(double relative_mse) { return Percent(relative_mse) + " %"; }

std::string IntervalText(const Interval& v) {
  if (!v.HasBounds())
    return fmt::format("at least {:.4g} (estimate {:.4g})", v.low, v.value);
  return fmt::format("{:.4g} [{:.4g}, {:.4g}]", v.value, v.low, v.high);
}

std::string WithReason(std::string text, const ErrorEstimate& e) {
  if (!e.why.empty()) text += "; no upper limit: " + e.why;
  return text;
}

constexpr std::size_t kMaxKinds = 8;

// The message without what differs from one shape to the next: its numbers, also those in
// names ("mesh_0012").
std::string KindOf(const std::string& message) {
  std::string kind;
  for (const char c : message) {
    if (std::isdigit(static_cast<unsigned char>(c)) == 0) kind += c;
  }
  return kind;
}

struct NoteKind {
  const Note* first;
  std::size_t count = 1;
};

}  // namespace

std::string PercentText(const ErrorEstimate& e) {
  if (!e.available) return e.why.empty() ? kUnknown : "unknown: " + e.why;
  if (e.why == kNoLight) return kBlack;
  const Interval& v = e.relmse;
  if (v.HasBounds()) {
    return fmt::format("{} [{}, {}]", PercentOf(v.value), Percent(v.low),
                       Percent(v.high));
  }
  return WithReason(
      fmt::format("at least {} (estimate {})", PercentOf(v.low), PercentOf(v.value)), e);
}

std::string BriefPercentText(const ErrorEstimate& e) {
  if (!e.available || e.why == kNoLight) return "unknown";
  return e.relmse.HasBounds() ? PercentText(e) : "at least " + PercentOf(e.relmse.low);
}

std::string ErrorText(const ErrorEstimate& e) {
  if (!e.available) return e.why.empty() ? kUnknown : "unknown: " + e.why;
  if (e.why == kNoLight) return kBlack;
  return WithReason(fmt::format("RMSE {}, relative MSE {} (95 % confidence)",
                                IntervalText(e.rmse), IntervalText(e.relmse)),
                    e);
}

std::vector<std::string> NoteLines(const std::vector<Note>& notes) {
  std::vector<NoteKind> kinds;  // in the order of their first notes
  std::map<std::string, std::size_t> places;
  for (const Note& note : notes) {
    const auto [place, is_new] = places.emplace(KindOf(note.message), kinds.size());
    if (is_new) {
      kinds.push_back({&note});
    } else {
      ++kinds[place->second].count;
    }
  }
  // Warnings first, so that no number of notes hides them.
  std::vector<NoteKind> ordered;
  for (const bool warning : {true, false}) {
    std::copy_if(kinds.begin(), kinds.end(), std::back_inserter(ordered),
                 [&](const NoteKind& kind) { return kind.first->warning == warning; });
  }
  std::vector<std::string> lines;
  std::size_t more = 0;
  for (const NoteKind& kind : ordered) {
    if (lines.size() == kMaxKinds) {
      more += kind.count;
      continue;
    }
    std::string line =
        fmt::format("{}: {}: {}", kind.first->where.ToString(),
                    kind.first->warning ? "warning" : "note", kind.first->message);
    if (kind.count > 1) line += fmt::format(" (and {} more like it)", kind.count - 1);
    lines.push_back(line);
  }
  if (more > 0)
    lines.push_back(fmt::format("and {} more notes (all are in --json)", more));
  return lines;
}

}  // namespace lanelight
