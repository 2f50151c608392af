// What images say of their colours and of the noise in them, as means of tiles.
#pragma once

#include <string>
#include <vector>

#include "src/base/image/image.h"
#include "src/measure/compare/tile_test.h"

namespace lanelight {

/// Indices of the colour channels (R, G and B, or Y), and of their variances: as many, or
/// none where one is missing.
struct NoisyChannels {
  std::vector<int> colors, variances;
};

NoisyChannels FindNoisyChannels(const Image& image);

/// A colour of an image.
struct NoisyChannel {
  const Image& image;
  const NoisyChannels& channels;
  std::size_t index;      // of `colors`
  bool is_exact = false;  // whatever the variances are
};

/// Of both images, by tile and of the whole: means, variances of these, and their degrees
/// of freedom.
struct ChannelMeans {
  std::vector<stat::MeanEstimate> test, reference;
  std::vector<std::size_t> pixels;  // of a tile, that count
  stat::MeanEstimate whole_test, whole_reference;
};

/// Pixels with an invalid value or variance in either image do not count.
ChannelMeans MeansOf(const NoisyChannel& test, const NoisyChannel& reference,
                     const TileLayout& layout);

}  // namespace lanelight
