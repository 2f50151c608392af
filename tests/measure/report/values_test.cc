// Numbers and intervals of reports, where they are known and where they are not.
#include "src/base/stat/values.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

namespace lanelight {

TEST_CASE("unknown values are null in reports and a dash in texts", "[report]") {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  CHECK(NumberJson(0.25) == 0.25);
  CHECK(NumberJson(kNan).is_null());
  CHECK(NumberJson(-kInfinite).is_null());
  CHECK(IntervalJson(std::nullopt).is_null());
  CHECK(IntervalJson(Interval{2, 1, kInfinite}).dump() ==
        R"({"high":null,"low":1.0,"value":2.0})");
  CHECK(EstimateText({2, 1.5, 2.25}) == "2 [1.5, 2.25]");
  // One end alone is no interval.
  CHECK(EstimateText({2.3456, 1, kInfinite}) == "2.35");
  CHECK(EstimateText(WithoutBounds(kInfinite)) == "inf");
  CHECK(EstimateText(WithoutBounds(kNan)) == "-");
}

}  // namespace lanelight
