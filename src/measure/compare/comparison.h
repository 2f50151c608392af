// Compares images in all ways of `lanelight compare`, and shows the result.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "src/measure/compare/agreement.h"
#include "src/measure/compare/flip.h"
#include "src/measure/compare/linear_image.h"
#include "src/measure/compare/metrics.h"

namespace lanelight {

struct ComparisonOptions {
  bool exact_reference = false;  // ignores its variances
  bool flip = false;             // computes FLIP, which takes seconds for large images
  double pixels_per_degree = kFlipPixelsPerDegree;
};

/// An image with its name in texts.
struct NamedImage {
  std::string name;
  Image image;
};

/// FLIP of the images as a screen shows them, and at several exposures unless both images
/// are bytes.
struct FlipMaps {
  double pixels_per_degree = 0;
  Plane ldr;
  FlipSummary ldr_summary;
  Plane hdr;  // may be empty
  FlipSummary hdr_summary;
  FlipExposures exposures;

  const Plane& map() const { return hdr.empty() ? ldr : hdr; }
  const FlipSummary& summary() const { return hdr.empty() ? ldr_summary : hdr_summary; }
};

struct ImageComparison {
  std::string test, reference;  // names
  CompareResult metrics;
  Agreement agreement;
  std::vector<ErrorTile> worst;
  std::optional<FlipMaps> flip;
  std::string verdict;  // one sentence
};

/// Compares two images. Throws InputError if sizes or colour channels differ.
ImageComparison Compare(const NamedImage& test, const NamedImage& reference,
                        const ComparisonOptions& options);

/// Returns the result of the test of agreement in one sentence.
std::string AgreementText(const Agreement& agreement);

/// Writes all members but the maps (docs/compare.md).
nlohmann::json ToJson(const ImageComparison& comparison);

/// Returns an HTML page of comparisons with one reference. `comparisons` has the same
/// order as `tests`, and FLIP.
std::string ComparisonPage(const std::vector<NamedImage>& tests,
                           const NamedImage& reference,
                           const std::vector<ImageComparison>& comparisons);

/// One row of the picture. The comparison has FLIP.
struct SheetRow {
  const NamedImage& test;
  const NamedImage& reference;
  const ImageComparison& comparison;
};

/// A picture of comparisons, and the ends of its colour scales, which are common to all
/// rows.
struct ComparisonSheet {
  Image image;  // linear, for WritePng()
  double difference_scale = 0, flip_scale = 0;
};

/// Draws, from left to right: the image, the reference, their signed relative difference
/// (blue: darker, red: brighter than the reference, grey: invalid), FLIP (black to
/// white). Clamps images to [0, 1].
ComparisonSheet SheetOf(const std::vector<SheetRow>& rows);

/// Returns a legend, since the picture has no text.
std::string SheetText(const ComparisonSheet& sheet);

}  // namespace lanelight
