// The reports of studies, comparisons, sweeps and stress cases: one HTML file each, with
// styles, scripts, numbers and images in it; and the page of `lanelight live`.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace lanelight {

/// An image that the page can show: linear values, `channels` interleaved, row 0 at the
/// top. Size: width * height * channels.
struct ReportImage {
  std::string name;                         // what `study` calls it; unique
  int width = 0, height = 0, channels = 3;  // channels: 1 or 3
  std::vector<float> values;
};

/// The complete page. `study` is laid out as docs/study.md says; its texts may be
/// anything (invalid UTF-8 is replaced). An image that it names and `images` lacks is
/// shown as missing. The page needs no network and no other file, its content security
/// policy forbids both, and equal arguments give equal bytes. Images take 2 bytes per
/// value, and a third more by base64.
std::string ReportPage(const nlohmann::json& study,
                       const std::vector<ReportImage>& images);

/// The founding paper's figures on the first scene of a study, with what its equations
/// say and what was found; arguments as of ReportPage().
std::string PaperReportPage(const nlohmann::json& study,
                            const std::vector<ReportImage>& images);

/// The page of `lanelight compare`, of the numbers that docs/compare.md names, and of
/// maps by the names that it has for them; otherwise like ReportPage().
std::string ComparisonReportPage(const nlohmann::json& comparisons,
                                 const std::vector<ReportImage>& images);

/// The page of a sweep, laid out as docs/sweep.md says, with images by the names of its
/// cells; otherwise like ReportPage().
std::string SweepReportPage(const nlohmann::json& sweep,
                            const std::vector<ReportImage>& images);

/// The page of `lanelight bench`, of the JSON that docs/bench.md names; otherwise like
/// ReportPage().
std::string BenchReportPage(const nlohmann::json& bench);

/// The page of a run of stress cases, laid out as docs/stress.md says; otherwise like
/// ReportPage().
std::string StressReportPage(const nlohmann::json& stress);

/// The page of `lanelight live`, which opens a socket to where it came from, and nowhere
/// else; it has no data.
std::string LivePage();

/// IEEE 754 binary16, rounded to nearest even: infinities and finite values beyond
/// +-65504 saturate there, NaN stays one.
std::uint16_t ToHalfBits(float value);

}  // namespace lanelight
