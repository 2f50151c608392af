// A made-up study for the tests of the report: everything that the schema allows, with
// images from formulas.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "src/measure/report/page.h"

namespace lanelight {

struct SyntheticStudy {
  nlohmann::json study;
  std::vector<ReportImage> images;
};

/// Makes five scenes, deterministically: one complete (eight strategies, one refused, one
/// failed, hostile names); one with a single repetition and null for every optional
/// member; one that could not be studied; one whose only strategy failed; one of many
/// strategies.
SyntheticStudy MakeSyntheticStudy();

/// The name that would end its script block if it could.
inline constexpr const char* kHostileName = "</script><b>\"bold\" & 'sly'</b><!--";

}  // namespace lanelight
