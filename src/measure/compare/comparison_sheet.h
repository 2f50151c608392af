// Comparisons as one picture, without a browser.
#pragma once

#include <string>
#include <vector>

#include "src/measure/compare/comparison.h"

namespace lanelight {

/// What of a comparison is in the picture. The comparison has its FLIP.
struct SheetRow {
  const NamedImage& test;
  const NamedImage& reference;
  const ImageComparison& comparison;
};

/// A picture with a row for each, and the end of the scale of its differences, which all
/// rows have in common.
struct ComparisonSheet {
  Image image;  // linear, for WritePng()
  double difference_scale = 0, flip_scale = 0;
};

/// From left to right: the image, the reference, their signed relative difference (blue:
/// darker, red: brighter than the reference, grey where a value is invalid), FLIP (black
/// to white). Images are clamped to what a screen shows.
ComparisonSheet SheetOf(const std::vector<SheetRow>& rows);

/// What is where in it, since a picture of ours has no letters.
std::string SheetText(const ComparisonSheet& sheet);

}  // namespace lanelight
