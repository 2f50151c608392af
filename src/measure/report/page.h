// HTML reports of studies, comparisons, sweeps and stress cases, each in one file with
// styles, scripts, numbers and images; and the page of `lanelight live`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace lanelight {

/// An image that the page can show: linear values, `channels` interleaved, row 0 at the
/// top. Size: width * height * channels.
struct ReportImage {
  std::string name;                         // unique
  int width = 0, height = 0, channels = 3;  // channels: 1 or 3
  std::vector<float> values;
};

/// Returns the page of a study in the layout of docs/study.md. Replaces invalid UTF-8 in
/// texts. The page shows images that `images` lacks as missing. Its content security
/// policy forbids network access and other files. Equal arguments give equal bytes.
/// Images take 2 bytes per value, and a third more by base64.
std::string ReportPage(const nlohmann::json& study,
                       const std::vector<ReportImage>& images);

/// Returns the founding paper's figures on the first scene of a study, with predicted and
/// measured values; arguments as of ReportPage().
std::string PaperReportPage(const nlohmann::json& study,
                            const std::vector<ReportImage>& images);

/// Returns the page of `lanelight compare` (docs/compare.md), like ReportPage().
std::string ComparisonReportPage(const nlohmann::json& comparisons,
                                 const std::vector<ReportImage>& images);

/// Returns the page of a sweep (docs/sweep.md), with images named like cells, like
/// ReportPage().
std::string SweepReportPage(const nlohmann::json& sweep,
                            const std::vector<ReportImage>& images);

/// Returns the page of `lanelight bench` (docs/bench.md), like ReportPage().
std::string BenchReportPage(const nlohmann::json& bench);

/// Returns the page of a run of stress cases (docs/stress.md), like ReportPage().
std::string StressReportPage(const nlohmann::json& stress);

/// Returns the page of `lanelight live`, which has no data and opens a socket only to its
/// server.
std::string LivePage();

/// Rounds to IEEE 754 binary16 (nearest even). Values beyond +-65504 and infinities
/// saturate; NaN stays NaN.
std::uint16_t ToHalfBits(float value);

/// Maximum number of image values in a report: about 90 MB of text. More are too slow in
/// a browser.
inline constexpr std::size_t kReportValues = 32'000'000;

/// Averages blocks of pixels in all images to leave at most `most` values. Returns the
/// side of a block; 1 for unchanged images.
int ShrinkImages(std::vector<ReportImage>& images, std::size_t most);

}  // namespace lanelight
