#include "src/train/guide_tables.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "src/core/error.h"
#include "src/prepare/guide_restore.h"
#include "src/train/trained_tables.h"

namespace lanelight {
namespace {

std::uint32_t Whole(double value, const char* table) {
  if (!(value >= 0 && value <= std::numeric_limits<std::uint32_t>::max()) ||
      value != std::floor(value)) {
    throw InputError(
        fmt::format("the state's table '{}' has a value of {}: whole numbers below 2^32 "
                    "are right",
                    table, value));
  }
  return static_cast<std::uint32_t>(value);
}

void PutFloats(const std::vector<double>& values, AlignedVector<float>& out) {
  out.resize(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) out[i] = static_cast<float>(values[i]);
}

}  // namespace

std::vector<TrainedTable> TakeGuide(const Guide& guide) {
  if (guide.nodes.empty()) return {};
  std::vector<double> at, next;
  for (const Guide::Node& node : guide.nodes) {
    at.push_back(double(node.at));
    next.push_back(node.next);
  }
  return {
      {"guide_at", "by node: where it divides its axis", std::move(at)},
      {"guide_next", "by node: axis | (first child, or cell) << 3; axis 7: a leaf",
       std::move(next)},
      {"guide_cumulative",
       "by cell: mass of the rows of the square up to each; then by row, of its squares",
       {guide.cumulative.begin(), guide.cumulative.end()}},
      {"guide_fraction",
       "by cell: with which probability it proposes",
       {guide.fraction.begin(), guide.fraction.end()}}};
}

void PutGuide(const std::vector<TrainedTable>& trained, Guide& out) {
  Guide guide;
  const std::vector<double>& at = TableOf(trained, "guide_at");
  const std::vector<double>& next = TableOf(trained, "guide_next");
  if (at.size() != next.size()) {
    throw InputError("the state's table 'guide_next' does not fit 'guide_at'");
  }
  for (std::size_t i = 0; i < at.size(); ++i) {
    guide.nodes.push_back({static_cast<float>(at[i]), Whole(next[i], "guide_next")});
  }
  PutFloats(TableOf(trained, "guide_cumulative"), guide.cumulative);
  PutFloats(TableOf(trained, "guide_fraction"), guide.fraction);
  const std::string fault = CompleteGuide(guide);
  if (!fault.empty()) {
    throw InputError(fmt::format("the guide in the state's tables is broken: {}", fault));
  }
  out = std::move(guide);
}

}  // namespace lanelight
