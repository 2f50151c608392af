// The finished renders of a study on disk, so that a study can be continued. One state
// file (src/base/state/state_file.h) for each strategy and sample count of a scene,
// written anew after each of its repetitions.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/base/image/pixel_rect.h"
#include "src/measure/study/measurement.h"
#include "src/measure/study/moments.h"
#include "src/render/run/run.h"

namespace lanelight {

/// The repetitions of one strategy at one sample count.
struct Cells {
  std::vector<Measurement> repetitions;
  std::vector<StageProfile> stages;  // sums over the repetitions
  Moments moments;
  std::vector<Rgb> first;  // image of the first repetition
};

class CellStore {
 public:
  /// `folder` is made if needed. `window`: the pixels of all images; files of others are
  /// errors.
  CellStore(std::string folder, const PixelRect& window);

  /// What there is of a strategy (complete text form) at a sample count; empty if
  /// nothing. Throws InputError for a file that is not what this program writes.
  Cells Load(const std::string& strategy, std::uint64_t spp) const;
  void Save(const std::string& strategy, std::uint64_t spp, const Cells& cells) const;

  const std::string& folder() const { return folder_; }

 private:
  std::string Path(const std::string& strategy, std::uint64_t spp) const;

  std::string folder_;
  PixelRect window_;
};

}  // namespace lanelight
