// Everything that is said of two images: `lanelight compare`.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "src/measure/compare/agreement.h"
#include "src/measure/compare/error_tiles.h"
#include "src/measure/compare/flip.h"
#include "src/measure/compare/metrics.h"

namespace lanelight {

struct ComparisonOptions {
  bool exact_reference = false;  // its variances do not count
  bool flip = false;             // computed: some seconds for large images
  double pixels_per_degree = kFlipPixelsPerDegree;
};

/// An image that is compared, by the name that texts call it.
struct NamedImage {
  std::string name;
  Image image;
};

/// FLIP, as a screen shows the images; and at all exposures, unless both are bytes, which
/// have no more than one.
struct FlipMaps {
  double pixels_per_degree = 0;
  Plane ldr;
  FlipSummary ldr_summary;
  Plane hdr;  // empty: none
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

/// Throws InputError if the sizes or the colour channels differ.
ImageComparison Compare(const NamedImage& test, const NamedImage& reference,
                        const ComparisonOptions& options);

/// What the test of agreement has found, in one sentence; none for equal images.
std::string AgreementText(const Agreement& agreement);

/// All but the maps: the members of ToJson(CompareResult), and those of docs/compare.md.
nlohmann::json ToJson(const ImageComparison& comparison);

}  // namespace lanelight
