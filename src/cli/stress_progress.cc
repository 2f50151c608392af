#include "src/cli/stress_progress.h"

#include <fmt/format.h>

#include <cmath>

#include "src/cli/console.h"

namespace lanelight {
namespace {

std::string Describe(const stress::SuiteProgress& p) {
  return fmt::format("{} of {}  {}", p.done + 1, p.total, p.now->name);
}

// " unit of length 1e-15 (AVX2)"
std::string Where(const stress::SuiteProgress& p) {
  const std::string target = " (" + p.target + ")";
  if (!std::isfinite(p.parameter)) return target;
  return fmt::format(" {} {:g}{}", p.now->axis.name, p.parameter, target);
}

}  // namespace

void StressProgressPrinter::Update(const stress::SuiteProgress& p) {
  if (style_ == ProgressStyle::kNone) return;
  if (style_ == ProgressStyle::kLines) {
    if (p.now->name != last_case_) PrintError("stress: " + Describe(p));
    last_case_ = p.now->name;
    return;
  }
  const double fraction = double(p.done) / double(p.total);
  RedrawLine(ProgressPrinter::Bar(fraction, kBarCells) + " " + Describe(p) + Where(p));
}

void StressProgressPrinter::Finish() {
  if (style_ == ProgressStyle::kBar) RedrawLine("");
}

}  // namespace lanelight
