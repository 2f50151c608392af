// docs/sweep.md names what a sweep file may have.
#include <catch2/catch.hpp>

#include "src/base/core/input_file.h"
#include "src/measure/sweep/axes.h"

namespace lanelight {

TEST_CASE("sweep: all axes and settings are documented", "[sweep]") {
  const std::string page =
      ReadWholeFile(std::string(LANELIGHT_SOURCE_DIR) + "/docs/sweep.md");
  for (const std::string& axis : AxisNames()) {
    INFO(axis);
    CHECK(page.find("`" + axis + "`") != page.npos);
  }
  int settings = 0;
  for (const Setting& setting : SettingList()) {
    if (!setting.Is(kSweepKey)) continue;
    INFO(setting.name);
    ++settings;
    CHECK_FALSE(SweepAxisOf(setting.name));
    CHECK(page.find("`" + std::string(setting.name) + "`") != page.npos);
  }
  CHECK(settings >= 10);
}

}  // namespace lanelight
