// Makes LearnedLights (tables.h) of what light samples have brought to cells.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/scene/compiled/scene.h"
#include "src/scene/prepare/tables.h"

namespace lanelight {

/// Most groups of lights, each of which has an entry in each row of the table. If the
/// scene has more lights, those of a group are close to each other.
inline constexpr std::uint32_t kMaxLightGroups = 64;

/// Returns the groups of the scene's lights, which have learned nothing yet. `power`: of
/// selecting each light by power.
LearnedLights GroupLights(const CompiledScene& scene, std::span<const float> power);

/// Sums over the light samples at the vertices of a cell, by group of lights.
class LightRecords {
 public:
  LightRecords(const CellGrid& grid, std::uint32_t num_groups);

  /// Counts a vertex, whether its light sample brings light or not.
  void AddVertex(std::uint32_t cell);
  /// Adds what an unoccluded sample brings, in any unit of the image's brightness,
  /// divided by the probability with which its light was selected; `pmf` is that of its
  /// group. The vertex has been counted.
  void Add(std::uint32_t cell, std::uint32_t group, double brings, double pmf);

  const CellGrid& grid() const { return grid_; }
  std::uint32_t num_groups() const { return num_groups_; }
  /// Returns a cell's vertices.
  double Vertices(std::uint32_t cell) const;
  /// Returns an estimate, times Vertices, of the variance of a sample of each group by
  /// itself: of E[f^2] less most of E[f]^2, which is equal in all samples. Empty without
  /// vertices.
  std::vector<double> Scatter(std::uint32_t cell) const;

 private:
  struct Sums {
    double light = 0, square = 0;
  };
  CellGrid grid_;
  std::uint32_t num_groups_;
  std::vector<std::uint32_t> places_;  // by cell: of its vertices, from 1; 0: none
  std::vector<double> vertices_;
  std::vector<Sums> sums_;  // by place and group
};

/// Lets the table learn. A group's probability is in proportion to the standard deviation
/// of what it brings; a tenth of the probability is by power, so that light which no
/// record has met is found. Cells with few records borrow from the coarser cell around
/// them, and those without any have its row. Row 0 is by power.
void Learn(const LightRecords& records, std::span<const float> power,
           LearnedLights& table);

/// Makes the table's probabilities of its weights: finite, not negative, and some above 0
/// in each row.
void SetProbabilities(LearnedLights& table);

}  // namespace lanelight
