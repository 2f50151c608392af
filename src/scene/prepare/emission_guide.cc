#include "src/scene/prepare/emission_guide.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "src/base/core/alias_table.h"
#include "src/base/core/check.h"

namespace lanelight {
namespace {

constexpr double kPlainShare = 0.1;
// Only so many distant lights have cells, 80 KiB each.
constexpr std::uint32_t kMaxSuns = 64;
constexpr double kOwnWeight = 4;  // of a cell when it is blurred; that of neighbours is 1
constexpr std::uint32_t kSunCells = EmissionGuide::kSunSide * EmissionGuide::kSunSide;
constexpr std::uint32_t kSkyCells = EmissionGuide::kSkySide * EmissionGuide::kSkySide;
constexpr std::uint32_t kSkySquares = EmissionGuide::kSkyBins * EmissionGuide::kSkyBins;

// The lights of kNear share what they have learned, and so do those of kSky.
enum class Group { kNear, kDistant, kSky };

Group GroupOf(const LightRecord& light) {
  const auto shape = static_cast<LightShape>(light.shape);
  if (shape == LightShape::kDistant) return Group::kDistant;
  const bool sky =
      shape == LightShape::kInfiniteConstant || shape == LightShape::kInfiniteImage;
  return sky ? Group::kSky : Group::kNear;
}

// A square of cells.
struct Square {
  std::size_t first, side;

  std::span<const double> Of(const std::vector<double>& cells) const {
    return std::span(cells).subspan(first, side * side);
  }
};

std::vector<Square> SquaresOf(const EmissionGuide& guide) {
  std::vector<Square> squares;
  for (const std::int32_t first : guide.distant) {
    if (first >= 0) squares.push_back({std::size_t(first), EmissionGuide::kSunSide});
  }
  for (std::uint32_t i = 0; guide.sky >= 0 && i < kSkySquares; ++i) {
    squares.push_back({std::size_t(guide.sky) + i * kSkyCells, EmissionGuide::kSkySide});
  }
  return squares;
}

double Sum(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

// Returns a square blurred by one cell: the neighbours of what has been found are likely.
std::vector<double> Blurred(std::span<const double> cells, std::size_t side) {
  std::vector<double> out(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::size_t x = i % side, y = i / side;
    double sum = (kOwnWeight - 1) * cells[i];
    for (std::size_t v = y - (y > 0); v <= y + (y + 1 < side); ++v) {
      for (std::size_t u = x - (x > 0); u <= x + (x + 1 < side); ++u) {
        sum += cells[v * side + u];
      }
    }
    out[i] = sum;
  }
  return out;
}

// Divides what each group of lights has (near, sky) by power. Distant lights have `own`.
std::vector<double> Divided(const LightTable& table, const LightEmission& emission,
                            double near, double sky, const std::vector<double>& own) {
  double near_pmf = 0, sky_pmf = 0;
  for (std::size_t i = 0; i < table.lights.size(); ++i) {
    const Group group = GroupOf(table.lights[i]);
    if (group == Group::kNear) near_pmf += double(emission.pmf[i]);
    if (group == Group::kSky) sky_pmf += double(emission.pmf[i]);
  }
  std::vector<double> out(table.lights.size(), 0.0);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const auto pmf = double(emission.pmf[i]);
    if (!(pmf > 0)) continue;
    const Group group = GroupOf(table.lights[i]);
    out[i] = group == Group::kDistant ? own[i]
             : group == Group::kNear  ? near * pmf / near_pmf
                                      : sky * pmf / sky_pmf;
  }
  return out;
}

// Returns what each light has brought. Lights that have no cells of their own share it.
std::vector<double> BroughtByLights(const LightTable& table, const EmissionGuide& guide,
                                    const LightEmission& emission,
                                    const std::vector<double>& light) {
  double near = 0;
  std::vector<double> own(table.lights.size(), 0.0);
  for (std::size_t i = 0; i < own.size(); ++i) {
    own[i] = light[guide.num_cells + i];
    if (GroupOf(table.lights[i]) == Group::kNear) near += own[i];
    if (guide.distant[i] < 0) continue;
    own[i] =
        Sum(Square{std::size_t(guide.distant[i]), EmissionGuide::kSunSide}.Of(light));
  }
  double sky = 0;
  if (guide.sky >= 0) {
    sky = Sum(std::span(light).subspan(std::size_t(guide.sky), kSkySquares * kSkyCells));
  }
  return Divided(table, emission, near, sky, own);
}

}  // namespace

EmissionGuide MakeEmissionGuide(const LightTable& table) {
  EmissionGuide guide;
  guide.distant.assign(table.lights.size(), -1);
  for (std::size_t i = 0; i < table.lights.size(); ++i) {
    if (GroupOf(table.lights[i]) != Group::kDistant) continue;
    if (guide.num_cells == kMaxSuns * kSunCells) break;
    guide.distant[i] = std::int32_t(guide.num_cells);
    guide.num_cells += kSunCells;
  }
  if (std::ranges::any_of(table.lights, [](const LightRecord& light) {
        return GroupOf(light) == Group::kSky;
      })) {
    guide.sky = std::int32_t(guide.num_cells);
    guide.num_cells += kSkySquares * kSkyCells;
  }
  return guide;
}

EmissionWeights PlainEmissionWeights(const LightTable& table, const EmissionGuide& guide,
                                     const LightEmission& emission) {
  std::vector<double> lights =
      Divided(table, emission, 1, 1, std::vector<double>(table.lights.size(), 1.0));
  const double groups = Sum(lights);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    lights[i] = (lights[i] / groups + double(emission.pmf[i])) / 2;
  }
  return {std::vector<double>(guide.num_cells, 1.0), std::move(lights)};
}

EmissionWeights LearnedEmissionWeights(const LightTable& table,
                                       const EmissionGuide& guide,
                                       const LightEmission& emission,
                                       const std::vector<double>& light) {
  EmissionWeights weights = PlainEmissionWeights(table, guide, emission);
  for (const Square& square : SquaresOf(guide)) {
    if (!(Sum(square.Of(light)) > 0)) continue;
    std::ranges::copy(Blurred(square.Of(light), square.side),
                      weights.cells.begin() + std::ptrdiff_t(square.first));
  }
  const std::vector<double> brought = BroughtByLights(table, guide, emission, light);
  const double total = Sum(brought);
  for (std::size_t i = 0; total > 0 && i < brought.size(); ++i) {
    double& weight = weights.lights[i];
    weight = kPlainShare * weight + (1 - kPlainShare) * brought[i] / total;
  }
  return weights;
}

bool AreUsable(const EmissionWeights& weights, const EmissionGuide& guide) {
  const auto usable = [](std::span<const double> values) {
    const double sum = Sum(values);
    return sum > 0 && std::isfinite(sum) &&
           std::ranges::all_of(values, [](double v) { return v >= 0; });
  };
  return usable(weights.lights) &&
         std::ranges::all_of(SquaresOf(guide), [&](const Square& square) {
           return usable(square.Of(weights.cells));
         });
}

void Learn(EmissionWeights weights, EmissionGuide& guide) {
  LL_CHECK_EQ(weights.cells.size(), std::size_t{guide.num_cells});
  LL_CHECK_EQ(weights.lights.size(), guide.distant.size());
  AliasTable lights = BuildAliasTable(weights.lights);
  guide.lights = {std::move(lights.probability), std::move(lights.q),
                  std::move(lights.alias)};
  guide.pmf.resize(guide.num_cells);
  guide.alias_q.resize(guide.num_cells);
  guide.alias.resize(guide.num_cells);
  for (const Square& square : SquaresOf(guide)) {
    const AliasTable cells = BuildAliasTable(square.Of(weights.cells));
    std::ranges::copy(cells.probability,
                      guide.pmf.begin() + std::ptrdiff_t(square.first));
    std::ranges::copy(cells.q, guide.alias_q.begin() + std::ptrdiff_t(square.first));
    std::ranges::copy(cells.alias, guide.alias.begin() + std::ptrdiff_t(square.first));
  }
  guide.cell_weights = std::move(weights.cells);
  guide.light_weights = std::move(weights.lights);
}

}  // namespace lanelight
