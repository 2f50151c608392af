#include "bench/calibrate/coverage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace lanelight::bench {

void Coverage::Add(double true_error, const Interval& stated) {
  truth_ += true_error;
  estimate_ += stated.value;
  const bool too_low = true_error < stated.low - kRounding;
  if (!stated.HasBounds()) {
    ++refused_;
    refused_covered_ += !too_low;
    return;
  }
  ++printed_;
  below_ += too_low;
  inside_ += !too_low && true_error <= stated.high + kRounding;
  if (stated.low > 0) width_ += std::log(stated.high / stated.low) / 2;
}

void Coverage::Add(const Coverage& other) {
  printed_ += other.printed_;
  inside_ += other.inside_;
  below_ += other.below_;
  refused_ += other.refused_;
  refused_covered_ += other.refused_covered_;
}

Interval Coverage::Inside() const {
  return stat::ProportionInterval(inside_, printed_, 0.95);
}

std::string Coverage::CountsHead() {
  return fmt::format("{:>7} {:>7} {:>22} {:>5} {:>5} {:>11}", "renders", "refused",
                     "true error inside", "below", "above", "at least");
}

std::string Coverage::Counts() const {
  std::string fraction = "-", lower = "-";
  if (printed_ > 0) {
    const Interval v = Inside();
    fraction = fmt::format("{:5.1f} % [{:5.1f}, {:5.1f}]", 100 * v.value, 100 * v.low,
                           100 * v.high);
  }
  if (refused_ > 0) lower = fmt::format("{}/{}", refused_covered_, refused_);
  return fmt::format(
      "{:>7} {:>5.1f} % {:>22} {:>5} {:>5} {:>11}", renders(),
      100.0 * double(refused_) / double(std::max<std::uint64_t>(1, renders())), fraction,
      below_, printed_ - inside_ - below_, lower);
}

std::string Coverage::Cells() const {
  const std::string fraction =
      printed_ > 0 ? fmt::format("{:.1f} %", 100 * Inside().value) : "-";
  return fmt::format("{} | {} | {} | {} | {}", renders(), printed_, inside_, fraction,
                     refused_);
}

std::string Coverage::SizesHead() {
  return fmt::format("{:>7} {:>7} {:>9} {:>7}", "ratio", "width", "estimate", "ref");
}

std::string Coverage::Sizes(double own_error) const {
  if (!(estimate_ > 0)) return fmt::format("{:>7} {:>7} {:>9} {:>7}", "-", "-", 0, "-");
  const double n = double(renders());
  const std::string width =
      printed_ > 0 ? fmt::format("{:.3f}", width_ / double(printed_)) : "-";
  return fmt::format("{:>7.3f} {:>7} {:>9.3g} {:>7.2g}", truth_ / estimate_, width,
                     estimate_ / n, own_error / (truth_ / n));
}

std::string Coverage::Sentence(const std::string& error) const {
  std::string text = "no interval was printed";
  if (printed_ > 0) {
    const Interval v = Inside();
    text = fmt::format("{:.2f} % [{:.2f}, {:.2f}] of {} printed intervals held",
                       100 * v.value, 100 * v.low, 100 * v.high, printed_);
  }
  return fmt::format(
      "{}: {}; {} of {} renders stated no upper end, and {} of their lower "
      "ends held",
      error, text, refused_, renders(), refused_covered_);
}

void Totals::Add(const std::string& name, const ErrorCoverage& coverage) {
  auto row = std::find_if(rows_.begin(), rows_.end(),
                          [&](const auto& r) { return r.first == name; });
  if (row == rows_.end()) row = rows_.insert(rows_.end(), {name, {}});
  row->second.Add(coverage);
}

void Totals::Print(const std::string& title) const {
  fmt::print("\n{:<48} {:<7}{}\n", title, "", Coverage::CountsHead());
  for (const auto& [name, coverage] : rows_) PrintCounts(name, coverage);
}

void Totals::PrintTable(const std::string& title) const {
  fmt::print("\n| {} | renders | printed | held | share | refused |\n", title);
  fmt::print("|---|---|---|---|---|---|\n");
  for (const auto& [name, coverage] : rows_) {
    fmt::print("| `{}` | {} |\n", name, coverage.relmse.Cells());
  }
}

void PrintCounts(const std::string& name, const ErrorCoverage& coverage) {
  fmt::print("{:<48} {:<7}{}\n", name, "relmse", coverage.relmse.Counts());
  fmt::print("{:<48} {:<7}{}\n", name, "rmse", coverage.rmse.Counts());
  std::fflush(stdout);
}

}  // namespace lanelight::bench
