// Decides whether two renders agree within their own variances.
#pragma once

#include <string>
#include <vector>

#include "src/base/image/image.h"
#include "src/measure/compare/tile_test.h"

namespace lanelight {

enum class AgreementVerdict {
  kAgree,      // no difference beyond noise was found
  kDiffer,     // one was
  kCannotTell  // the images do not say how noisy they are, or rest on too few samples
};

/// "agree", "differ", "cannot tell".
std::string Name(AgreementVerdict verdict);

/// Tests of equal means of the whole image and of its tiles, each channel by itself.
struct Agreement {
  AgreementVerdict verdict = AgreementVerdict::kCannotTell;
  std::string why;    // kCannotTell: what is missing
  std::string doubt;  // what makes an agreement say less than it seems to; may be empty
  double level = 0;   // probability that images that differ by noise alone "differ"
  double p = 0;       // of all tests together; NaN where the verdict is kCannotTell
  std::size_t tests = 0, untested = 0;  // the latter rest on too few samples
  TileLayout layout;
  std::vector<double> z;            // of each tile, of its worst channel; NaN: not tested
  std::vector<std::size_t> failed;  // tiles, ascending
  bool image_failed = false;        // the mean of the whole image differs
  /// Relative difference of the whole images' means that would be found in one case of
  /// two; NaN where these rest on too few samples.
  double detectable = 0;
};

/// Welch's tests, corrected by Holm's procedure, of two images of one size with the
/// channels "variance.R", ... or "variance.Y". What is done about heavy tails is in
/// tile_test.h; degrees of freedom are those of the fewest samples that have a variance.
/// `exact_reference`: the reference has no noise, whatever its channels say. Tiles of
/// renders whose pixels have paths in common (reuse=block) count as that much noisier.
Agreement TestAgreement(const Image& test, const Image& reference, bool exact_reference);

}  // namespace lanelight
