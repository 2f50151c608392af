// Trained tables are restored; tables that kernels must not read are refused.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <functional>

#include "src/render/train/training.h"
#include "src/scene/prepare/emission_guide.h"
#include "src/scene/prepare/learned_lights.h"
#include "tests/support/input_error.h"

namespace lanelight {
namespace {

using Catch::Contains;

constexpr std::uint64_t kPixels = 6;

// Tables of a grid of two cells with all values different.
StrategyTables SmallTables() {
  StrategyTables tables;
  PathValues& p = tables.path_values;
  p.grid.size[1] = 2;
  float next = 0.125f;
  const auto fill = [&next](AlignedVector<float>& values, std::size_t size) {
    values.resize(size);
    for (float& v : values) v = next += 0.5f;
  };
  fill(p.survive, p.grid.cells());
  fill(p.inverse_pixel, 3 * kPixels);
  return tables;
}

std::string ErrorOf(const std::vector<TrainedTable>& trained, std::uint64_t pixels) {
  StrategyTables tables;
  return InputErrorOf([&] { ImportTraining(trained, pixels, tables); });
}

// Returns the tables with another first value in one, and one value more if `longer`.
std::vector<TrainedTable> WithFault(std::vector<TrainedTable> trained,
                                    const std::string& name, double value, bool longer) {
  for (TrainedTable& table : trained) {
    if (table.name != name) continue;
    table.values[0] = value;
    if (longer) table.values.push_back(1);
  }
  return trained;
}

// A guide of one sun and one lamp.
EmissionGuide SmallGuide() {
  LightTable table;
  for (const LightShape shape : {LightShape::kDistant, LightShape::kRectangle}) {
    LightRecord light;
    std::memset(&light, 0, sizeof(light));
    light.shape = std::uint32_t(shape);
    table.lights.push_back(light);
  }
  return MakeEmissionGuide(table);
}

}  // namespace

TEST_CASE("the guide of light subpaths round-trips bit-identically", "[state]") {
  StrategyTables tables = SmallTables(), back;
  tables.emission = back.emission = SmallGuide();
  EmissionWeights weights = {std::vector<double>(tables.emission.num_cells, 0.1),
                             {0.3, 0.7}};
  weights.cells[17] = 1.0 / 3;
  Learn(weights, tables.emission);
  const std::vector<TrainedTable> trained = ExportTraining(tables);
  ImportTraining(trained, kPixels, back);
  CHECK(back.emission.pmf == tables.emission.pmf);
  CHECK(back.emission.alias_q == tables.emission.alias_q);
  CHECK(back.emission.alias == tables.emission.alias);
  CHECK(back.emission.lights.pmf == tables.emission.lights.pmf);

  const auto error_of = [&](const std::string& name, double value, bool longer) {
    const std::vector<TrainedTable> bad = WithFault(trained, name, value, longer);
    StrategyTables other;
    other.emission = SmallGuide();
    return InputErrorOf([&] { ImportTraining(bad, kPixels, other); });
  };
  CHECK_THAT(error_of("emission_cells", 1, true), Contains("expected 4096"));
  CHECK_THAT(error_of("emission_lights", 1, true), Contains("expected 2"));
  CHECK_THAT(error_of("emission_lights", -1, false), Contains("at least 0"));
  CHECK_THAT(error_of("emission_cells", NAN, false), Contains("at least 0"));
  CHECK(error_of("emission_cells", 0, false) == "");
  // Nothing is above 0.
  for (std::size_t i : {trained.size() - 2, trained.size() - 1}) {
    std::vector<TrainedTable> bad = trained;
    std::ranges::fill(bad[i].values, 0.0);
    StrategyTables other;
    other.emission = SmallGuide();
    CHECK_THROWS_AS(ImportTraining(bad, kPixels, other), InputError);
  }
}

TEST_CASE("learned selection of lights round-trips bit-identically", "[state]") {
  StrategyTables tables = SmallTables(), back;
  LearnedLights& lights = tables.lights;
  lights.num_groups = back.lights.num_groups = 3;
  lights.grid.size[2] = 2;
  lights.grid.low[1] = -0.3f;
  lights.row.assign(lights.grid.cells(), 1);
  lights.row[4] = 0;
  lights.weights = {0.2, 0.5, 0.3, 1.0 / 3, 0.6, 0};
  SetProbabilities(lights);
  const std::vector<TrainedTable> trained = ExportTraining(tables);
  ImportTraining(trained, kPixels, back);
  CHECK(back.lights.grid.low[1] == lights.grid.low[1]);
  CHECK(back.lights.row == lights.row);
  CHECK(back.lights.pmf == lights.pmf);
  CHECK(back.lights.alias_q == lights.alias_q);
  CHECK(back.lights.alias == lights.alias);

  const auto error_of = [&](const std::string& name, double value, bool longer) {
    const std::vector<TrainedTable> bad = WithFault(trained, name, value, longer);
    StrategyTables other;
    other.lights.num_groups = 3;
    return InputErrorOf([&] { ImportTraining(bad, kPixels, other); });
  };
  CHECK_THAT(error_of("learned_light_grid", 0, true), Contains("expected 9"));
  CHECK_THAT(error_of("learned_light_rows", 0, true), Contains("expected 12"));
  CHECK_THAT(error_of("learned_light_weights", 1, true), Contains("expected 6"));
  for (const double row : {-1.0, 2.0, 1e300, double(NAN)}) {
    CHECK_THAT(error_of("learned_light_rows", row, false), Contains("indices of rows"));
  }
  for (const double weight : {-1.0, double(INFINITY), double(NAN)}) {
    CHECK_THAT(error_of("learned_light_weights", weight, false), Contains("finite"));
  }
}

TEST_CASE("trained tables round-trip bit-identically", "[state]") {
  const StrategyTables tables = SmallTables();
  StrategyTables back;
  ImportTraining(ExportTraining(tables), kPixels, back);
  CHECK(back.path_values.grid.size[1] == 2);
  CHECK(back.path_values.survive == tables.path_values.survive);
  CHECK(back.path_values.inverse_pixel == tables.path_values.inverse_pixel);
  // Nothing has been learned.
  CHECK(ErrorOf(ExportTraining(StrategyTables()), kPixels) == "");
}

TEST_CASE("a trained table of the wrong size is refused with both sizes", "[state]") {
  const std::vector<TrainedTable> good = ExportTraining(SmallTables());
  REQUIRE(good.size() == 3);
  using Values = std::vector<double>;
  const std::function<void(Values&)> faults[] = {
      [](Values& v) { v.pop_back(); }, [](Values& v) { v.push_back(1); },
      [](Values& v) { v.resize(3); }, [](Values& v) { v.resize(1000, 1); }};
  for (std::size_t i = 0; i < good.size(); ++i) {
    for (const auto& fault : faults) {
      std::vector<TrainedTable> bad = good;
      fault(bad[i].values);
      const std::size_t size = good[i].values.size();
      CHECK_THAT(ErrorOf(bad, kPixels),
                 Contains("table '" + good[i].name + "' has " +
                          std::to_string(bad[i].values.size()) + " values; expected " +
                          std::to_string(size) + ":"));
    }
  }
  CHECK(ErrorOf(good, kPixels) == "");
  // Tables of another image.
  CHECK_THAT(ErrorOf(good, 7),
             Contains("'path_values_inverse' has 18 values; expected 21:"));
}

TEST_CASE("an empty per-pixel table next to cells is refused", "[state]") {
  std::vector<TrainedTable> bad = ExportTraining(SmallTables());
  bad[2].values.clear();
  CHECK_THAT(ErrorOf(bad, kPixels),
             Contains("'path_values_inverse' has 0 values; expected 18: 3 for each of "
                      "the 6 pixels of the full image"));
}

}  // namespace lanelight
