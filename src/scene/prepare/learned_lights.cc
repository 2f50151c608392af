#include "src/scene/prepare/learned_lights.h"

#include <algorithm>
#include <cmath>

#include "src/base/core/alias_table.h"
#include "src/scene/prepare/cell_grid.h"

namespace lanelight {
namespace {

constexpr double kDefensive = 0.1;
// Share of E[f]^2 that does not count, and least share of E[f^2] that does. Points are
// stratified, so light that is equal in all samples of a pixel adds no noise.
constexpr double kEqual = 0.9, kMinScatter = 0.1;
// Weight, in vertices, of the coarser cell in the estimate of a finer one.
constexpr double kCoarseWeight = 16;

// Sums of scatter by light.
struct Estimate {
  double vertices = 0;
  std::vector<double> scatter;

  void Add(double more_vertices, const std::vector<double>& more, double weight = 1) {
    scatter.resize(more.size());
    vertices += more_vertices * weight;
    for (std::size_t i = 0; i < more.size(); ++i) scatter[i] += more[i] * weight;
  }
  // Adds the mean of another estimate, as that of so many vertices.
  void Borrow(const Estimate& other) {
    if (other.vertices > 0) {
      Add(other.vertices, other.scatter, kCoarseWeight / other.vertices);
    }
  }
};

class Learner {
 public:
  // `power`: probability of each group by power.
  Learner(const LightRecords& records, std::vector<double> power, LearnedLights& table)
      : records_(records),
        power_(std::move(power)),
        coarse_(CoarserGrid(records.grid())),
        table_(table) {}

  void Run() {
    const CellGrid& fine = records_.grid();
    std::vector<Estimate> around_cells(coarse_.cells());
    Estimate all;
    ForCells(fine, coarse_, [&](std::uint32_t cell, std::uint32_t around) {
      if (records_.Vertices(cell) == 0) return;
      const std::vector<double> scatter = records_.Scatter(cell);
      around_cells[around].Add(records_.Vertices(cell), scatter);
      all.Add(records_.Vertices(cell), scatter);
    });
    table_.grid = fine;
    table_.row.assign(fine.cells(), 0);
    AddRow({});
    std::vector<std::int32_t> coarse_rows(coarse_.cells(), 0);
    ForCells(fine, coarse_, [&](std::uint32_t cell, std::uint32_t around) {
      if (around_cells[around].vertices == 0) return;
      Estimate estimate = around_cells[around];
      estimate.Borrow(all);
      if (records_.Vertices(cell) > 0) {
        Estimate own;
        own.Add(records_.Vertices(cell), records_.Scatter(cell));
        own.Borrow(estimate);
        table_.row[cell] = AddRow(own.scatter);
        return;
      }
      if (coarse_rows[around] == 0) coarse_rows[around] = AddRow(estimate.scatter);
      table_.row[cell] = coarse_rows[around];
    });
    SetProbabilities(table_);
  }

 private:
  // Returns the index of a new row.
  std::int32_t AddRow(const std::vector<double>& scatter) {
    double sum = 0;
    for (const double s : scatter) sum += std::sqrt(s);
    for (std::size_t i = 0; i < power_.size(); ++i) {
      const double share = sum > 0 ? std::sqrt(scatter[i]) / sum : power_[i];
      table_.weights.push_back(kDefensive * power_[i] + (1 - kDefensive) * share);
    }
    return std::int32_t(table_.weights.size() / power_.size()) - 1;
  }

  const LightRecords& records_;
  const std::vector<double> power_;
  const CellGrid coarse_;
  LearnedLights& table_;
};

std::vector<double> PowerOfGroups(const LearnedLights& table,
                                  std::span<const float> power) {
  std::vector<double> sums(table.num_groups, 0.0);
  for (std::size_t i = 0; i < power.size(); ++i) {
    sums[std::size_t(table.group[i])] += double(power[i]);
  }
  return sums;
}

}  // namespace

LightRecords::LightRecords(const CellGrid& grid, std::uint32_t num_groups)
    : grid_(grid), num_groups_(num_groups), places_(grid.cells()) {}

void LightRecords::AddVertex(std::uint32_t cell) {
  if (places_[cell] == 0) {
    vertices_.push_back(0);
    sums_.resize(sums_.size() + num_groups_);
    places_[cell] = std::uint32_t(vertices_.size());
  }
  vertices_[places_[cell] - 1] += 1;
}

void LightRecords::Add(std::uint32_t cell, std::uint32_t group, double brings,
                       double pmf) {
  // E[f] is the mean of f / pmf over all vertices; so is E[f^2] of (f / pmf)^2 pmf.
  Sums& sums = sums_[std::size_t{places_[cell] - 1} * num_groups_ + group];
  sums.light += brings;
  sums.square += brings * brings * pmf;
}

double LightRecords::Vertices(std::uint32_t cell) const {
  return places_[cell] == 0 ? 0 : vertices_[places_[cell] - 1];
}

std::vector<double> LightRecords::Scatter(std::uint32_t cell) const {
  std::vector<double> scatter;
  if (places_[cell] == 0) return scatter;
  const double n = Vertices(cell);
  for (std::uint32_t i = 0; i < num_groups_; ++i) {
    const Sums& sums = sums_[std::size_t{places_[cell] - 1} * num_groups_ + i];
    scatter.push_back(std::max(kMinScatter * sums.square,
                               sums.square - kEqual * sums.light * sums.light / n));
  }
  return scatter;
}

void Learn(const LightRecords& records, std::span<const float> power,
           LearnedLights& table) {
  Learner(records, PowerOfGroups(table, power), table).Run();
}

void SetProbabilities(LearnedLights& table) {
  table.pmf.clear(), table.alias_q.clear(), table.alias.clear();
  for (std::size_t at = 0; at < table.weights.size(); at += table.num_groups) {
    const AliasTable row =
        BuildAliasTable(std::span(table.weights).subspan(at, table.num_groups));
    table.pmf.insert(table.pmf.end(), row.probability.begin(), row.probability.end());
    table.alias_q.insert(table.alias_q.end(), row.q.begin(), row.q.end());
    table.alias.insert(table.alias.end(), row.alias.begin(), row.alias.end());
  }
}

}  // namespace lanelight
