// Trained tables are restored; tables that kernels must not read are refused.
#include <catch2/catch.hpp>
#include <functional>

#include "src/render/train/training.h"
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
  p.scale = 0.75f;
  float next = 0.125f;
  const auto fill = [&next](AlignedVector<float>& values, std::size_t size) {
    values.resize(size);
    for (float& v : values) v = next += 0.5f;
  };
  fill(p.survive, p.grid.cells());
  fill(p.split, p.grid.cells());
  fill(p.inverse_pixel, 3 * kPixels);
  return tables;
}

std::string ErrorOf(const std::vector<TrainedTable>& trained, std::uint64_t pixels) {
  StrategyTables tables;
  return InputErrorOf([&] { ImportTraining(trained, pixels, tables); });
}

}  // namespace

TEST_CASE("trained tables round-trip bit-identically", "[state]") {
  const StrategyTables tables = SmallTables();
  StrategyTables back;
  ImportTraining(ExportTraining(tables), kPixels, back);
  CHECK(back.path_values.grid.size[1] == 2);
  CHECK(back.path_values.scale == 0.75f);
  CHECK(back.path_values.survive == tables.path_values.survive);
  CHECK(back.path_values.split == tables.path_values.split);
  CHECK(back.path_values.inverse_pixel == tables.path_values.inverse_pixel);
  // Nothing has been learned.
  CHECK(ErrorOf(ExportTraining(StrategyTables()), kPixels) == "");
}

TEST_CASE("a trained table of the wrong size is refused with both sizes", "[state]") {
  const std::vector<TrainedTable> good = ExportTraining(SmallTables());
  REQUIRE(good.size() == 4);
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
  bad[3].values.clear();
  CHECK_THAT(ErrorOf(bad, kPixels),
             Contains("'path_values_inverse' has 0 values; expected 18: 3 for each of "
                      "the 6 pixels of the full image"));
}

}  // namespace lanelight
