// light-selection=learned: groups of lights, what cells learn, and the kernel that
// selects by it.
#include "src/scene/prepare/learned_lights.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "kernels/stages.h"
#include "src/scene/prepare/prepared_scene.h"
#include "tests/reference/scenes.h"
#include "tests/render/run/render_fixture.h"
#include "tests/support/each_target.h"
#include "tests/support/wave_fixture.h"

namespace lanelight::test {
namespace {

// Rows of small spheres, the lights of a row close to each other; two lights have no
// place.
PreparedScene RowsOfLights(int rows, int columns) {
  SceneBuilder b(4, 4);
  const Index dark = b.AddDiffuse(Grey(0));
  for (int i = 0; i < rows * columns; ++i) {
    const Index light = b.AddEmission(Grey(1 + i % 3));
    b.AddSphere({2.0 * (i / columns), 0.02 * (i % columns), 0}, 0.005, dark, light);
  }
  b.AddDistant({0, 1, 2}, Grey(0.1));
  b.AddEnvironment(Grey(0.1));
  return PrepareScene(b.Build());
}

CellGrid TwoCells() {
  CellGrid grid;
  grid.size[0] = 2 * 4;  // two coarse ones
  for (float& per_unit : grid.per_unit) per_unit = 1;
  return grid;
}

// Returns the probability of a group in the row of a cell.
double PmfIn(const LearnedLights& table, std::uint32_t cell, std::uint32_t group) {
  const auto row = std::size_t(table.row[cell]);
  return double(table.pmf[row * table.num_groups + group]);
}

}  // namespace

TEST_CASE("learned lights: few lights are groups of their own", "[strategy]") {
  const PreparedScene scene = RowsOfLights(3, 4);
  const LearnedLights table = GroupLights(*scene.compiled, scene.chances->pmf);
  CHECK_FALSE(table.is_grouped);
  REQUIRE(table.num_groups == 14);
  for (std::uint32_t i = 0; i < 14; ++i) {
    CHECK(table.group[i] == std::int32_t(i));
    CHECK(table.within[i] == 1);
  }
}

TEST_CASE("learned lights: groups have all lights, and are close together",
          "[strategy]") {
  const PreparedScene scene = RowsOfLights(31, 10);
  const LearnedLights table = GroupLights(*scene.compiled, scene.chances->pmf);
  CHECK(table.is_grouped);
  REQUIRE(table.num_groups == kMaxLightGroups);
  std::map<std::int32_t, double> within;
  for (std::size_t i = 0; i < table.group.size(); ++i) {
    within[table.group[i]] += double(table.within[i]);
    // No group has lights of two rows.
    for (std::size_t k = 0; k < i; ++k) {
      if (table.group[k] == table.group[i]) CHECK(k / 10 == i / 10);
    }
  }
  CHECK(within.size() == kMaxLightGroups);
  for (const auto& [group, sum] : within) CHECK(sum == Approx(1));
}

TEST_CASE("learned lights: what is hidden or equal everywhere is rarely selected",
          "[strategy]") {
  const PreparedScene scene = RowsOfLights(1, 1);  // and two lights without a place
  LearnedLights table = GroupLights(*scene.compiled, scene.chances->pmf);
  REQUIRE(table.num_groups == 3);
  const AlignedVector<float> power = {0.2f, 0.3f, 0.5f};
  LightRecords records(TwoCells(), 3);
  const std::uint32_t lit = 0, empty_near = 6, far = 6 * 7;
  // Each light is selected as often as by power. The first is half hidden, the second
  // hidden, the third brings the same to all.
  for (int i = 0; i < 1000; ++i) {
    records.AddVertex(lit);
    if (i % 10 < 2 && i % 20 < 10) records.Add(lit, 0, 1 / 0.2, 0.2);
    if (i % 10 >= 5) records.Add(lit, 2, 1 / 0.5, 0.5);
  }
  Learn(records, power, table);
  // E[f^2] is 1/2 and 1; of the squares of the means 1/4 and 1, nine tenths are equal in
  // all samples.
  const double first = std::sqrt(0.5 - 0.9 * 0.25), third = std::sqrt(0.1);
  CHECK(PmfIn(table, lit, 0) ==
        Approx(0.02 + 0.9 * first / (first + third)).margin(1e-3));
  CHECK(PmfIn(table, lit, 1) == Approx(0.03).margin(1e-3));
  CHECK(PmfIn(table, lit, 2) ==
        Approx(0.05 + 0.9 * third / (first + third)).margin(1e-3));
  // A cell without records has what is known around it; without any, the power decides.
  CHECK(PmfIn(table, empty_near, 0) == Approx(PmfIn(table, lit, 0)).margin(0.01));
  for (std::uint32_t group = 0; group < 3; ++group) {
    CHECK(PmfIn(table, far, group) == Approx(power[group]));
  }
  // Another direction of the normal is another cell.
  CHECK(table.row[lit + 1] == 0);
}

TEST_CASE("learned lights: the kernel selects as often as its probability says",
          "[strategy]") {
  const EachTarget target;
  for (const int columns : {2, 40}) {
    const PreparedScene scene = RowsOfLights(4, columns);
    const auto lights = std::uint32_t(scene.chances->pmf.size());
    StrategyTables tables;
    tables.lights = GroupLights(*scene.compiled, scene.chances->pmf);
    LearnedLights& table = tables.lights;
    CHECK(table.is_grouped == (columns == 40));
    table.grid = TwoCells();
    table.row.assign(table.grid.cells(), 1);
    for (std::uint32_t i = 0; i < 2 * table.num_groups; ++i) {
      table.weights.push_back(1 + i % 7);
    }
    SetProbabilities(table);

    constexpr std::uint32_t kPaths = 1 << 16;
    WaveFixture f(scene.Parts(), kPaths);
    RunParameters run;
    run.tables = &tables;
    f.wave.run = &run;
    PathColumns& p = f.wave.path;
    std::vector<std::uint32_t> rows(kPaths);
    p.light_row = rows.data();
    for (std::uint32_t i = 0; i < kPaths; ++i) {
      p.p_x[i] = p.p_y[i] = p.p_z[i] = 0.5f;
      p.ng_x[i] = p.ng_y[i] = p.d_x[i] = p.d_y[i] = 0, p.ng_z[i] = 1, p.d_z[i] = -1;
      p.u_select[i] = (float(i) + 0.5f) / float(kPaths);
    }
    f.QueueAll(QueueId::kLit, kPaths);
    f.Run(SelectLearnedLightStage, {});
    std::vector<double> counts(lights);
    for (std::uint32_t i = 0; i < kPaths; ++i) {
      REQUIRE(p.light_row[i] == 1);
      counts[p.ls_light[i]] += 1;
    }
    for (std::uint32_t i = 0; i < lights; ++i) {
      const auto group = std::uint32_t(table.group[i]);
      const double pmf =
          double(table.pmf[table.num_groups + group]) * double(table.within[i]);
      INFO(lights << " lights, light " << i);
      CHECK(std::abs(counts[i] - pmf * kPaths) < 6 + 2e-3 * counts[i]);
    }
  }
}

}  // namespace lanelight::test
