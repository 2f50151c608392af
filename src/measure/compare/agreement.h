// Decides whether two renders agree within their own variances.
#pragma once

#include <string>
#include <vector>

#include "src/base/image/image.h"
#include "src/measure/compare/tile_test.h"

namespace lanelight {

enum class AgreementVerdict {
  kAgree,        // no difference beyond noise was found
  kDiffer,       // a difference was found
  kInconclusive  // variances are missing, or too few samples
};

/// "agree", "differ", "cannot tell".
std::string Name(AgreementVerdict verdict);

/// Result of tests of equal means of the whole image and of its tiles, for each channel.
struct Agreement {
  AgreementVerdict verdict = AgreementVerdict::kInconclusive;
  std::string why;     // reason of kInconclusive
  std::string caveat;  // reason to doubt kAgree; may be empty
  double level = 0;    // probability of kDiffer for images that differ by noise alone
  double p = 0;        // of all tests together; NaN for kInconclusive
  std::size_t tests = 0, untested = 0;  // untested: too few samples
  TileLayout layout;
  std::vector<double> z;            // of the worst channel of each tile; NaN: not tested
  std::vector<std::size_t> failed;  // tiles, ascending
  bool image_failed = false;        // the mean of the whole image differs
  /// Relative difference of the whole images' means that the test finds with probability
  /// 0.5; NaN for too few samples.
  double detectable = 0;
};

/// Compares two images of one size by Welch's tests with Holm's correction. Both have the
/// channels "variance.R", ... or "variance.Y"; an exact reference has no noise and needs
/// none. Heavy tails: see tile_test.h. Path reuse (reuse=block) correlates pixels and
/// increases the variance of tiles.
Agreement TestAgreement(const Image& test, const Image& reference, bool exact_reference);

/// Indices of the colour channels (R, G and B, or Y) and of their variances. There are no
/// variances if any is missing.
struct NoisyChannels {
  std::vector<int> colors, variances;
};

NoisyChannels FindNoisyChannels(const Image& image);

/// Returns a numeric attribute of an image; `otherwise` if there is none.
double NumberAttribute(const Image& image, const char* name, double otherwise);

/// One colour channel of an image.
struct NoisyChannel {
  const Image& image;
  const NoisyChannels& channels;
  std::size_t index;      // of `colors`
  bool is_exact = false;  // ignores the variances
};

/// Means of the tiles and of the whole of both images, with variances and degrees of
/// freedom.
struct ChannelMeans {
  std::vector<stat::MeanEstimate> test, reference;
  std::vector<std::size_t> pixels;  // valid pixels of a tile
  stat::MeanEstimate whole_test, whole_reference;
};

/// Returns means without pixels whose value or variance is invalid in either image.
ChannelMeans MeansOf(const NoisyChannel& test, const NoisyChannel& reference,
                     const TileLayout& layout);

}  // namespace lanelight
