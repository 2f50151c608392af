// Makes PathValues of what training passes have recorded.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "src/base/core/aligned.h"
#include "src/base/core/vec.h"
#include "src/scene/prepare/tables.h"

namespace lanelight {

/// Sums over the recorded vertices of a cell: of the estimates of the brightness that a
/// unit of throughput gathers from there on.
struct CellSums {
  double count = 0, value = 0;

  void Add(const CellSums& o) { count += o.count, value += o.value; }
};

/// Sums of the cells of a grid that have records; most cells are empty space without any.
class CellRecords {
 public:
  using Sums = std::vector<std::pair<std::uint32_t, CellSums>>;  // and their cells

  explicit CellRecords(std::uint32_t cells) : places_(cells) {}

  void Add(std::uint32_t cell, double estimate) {
    std::uint32_t& place = places_[cell];
    if (place == 0) {
      sums_.push_back({cell, {}});
      place = static_cast<std::uint32_t>(sums_.size());
    }
    sums_[place - 1].second.Add({1, estimate});
  }
  std::size_t cells() const { return places_.size(); }
  Sums Sorted() const;

 private:
  std::vector<std::uint32_t> places_;  // in sums_, from 1; 0: none
  Sums sums_;
};

/// Sets values.survive from records of values.grid. Cells with few records borrow from
/// the coarser cell around them; what is worth less than a tenth of the mean counts as
/// that much: a short training pass may have missed its light.
void SetCellValues(const CellRecords& records, PathValues& values);

/// Colours of the pixels of an image from a few samples: means over tiles of 8x8 pixels,
/// blurred over their neighbours. A sample counts at most kClamp times the mean of the
/// image.
class PilotImage {
 public:
  static constexpr double kClamp = 20;

  /// samples[i]: of pixel pixels[i / (samples.size() / pixels.size())], y * width + x.
  PilotImage(std::uint32_t width, std::uint32_t height,
             std::span<const std::uint32_t> pixels, std::span<const Vec3f> samples);

  bool black() const { return !(mean_[0] + mean_[1] + mean_[2] > 0); }
  float Channel(int c) const;
  /// 1 / (I_c^2 + epsilon): what a squared error of channel c weighs. epsilon is that of
  /// the relative error (src/render/estimate/estimate.h), less in a dark image.
  double ErrorWeight(std::uint32_t pixel, int c) const;
  double Brightness(std::uint32_t pixel) const;
  /// Returns, per pixel and channel, mean_c / mean / sqrt(3 (I_c^2 + epsilon)). The sum
  /// of the squares of beta_c times it, times the variance of a brightness, is the
  /// relative variance caused, if its colour is like the image's. This epsilon is
  /// negligible in all but the darkest pixels.
  AlignedVector<float> Inverse() const;

 private:
  static constexpr std::uint32_t kTile = 8;
  struct Sum {
    double color[3] = {}, count = 0;
    void Add(const Sum& other, double weight);
  };
  const Sum& Tile(std::uint32_t pixel) const {
    return tiles_[std::size_t{pixel / width_ / kTile} * columns_ +
                  pixel % width_ / kTile];
  }
  void Blur(const std::vector<Sum>& sums);
  double Mean() const { return (mean_[0] + mean_[1] + mean_[2]) / 3; }

  std::uint32_t width_, height_, columns_, rows_;
  double mean_[3] = {}, epsilon_ = 0;
  std::vector<Sum> tiles_;  // means, of count 1
};

}  // namespace lanelight
