// A NanoVDB grid of one type of values, for sparse_grid.cc alone: its headers are long.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iostream>  // NanoVDB uses it and does not include it
#include <limits>
#include <utility>

#include "src/core/aligned.h"
#include "src/image/sparse_grid.h"

// Of NanoVDB 32: reading (IO.h), and what a damaged file shows by (GridValidator.h).
#define NANOVDB_USE_ZIP
#define NANOVDB_USE_BLOSC
#include <nanovdb/NanoVDB.h>
#include <nanovdb/util/GridValidator.h>
#include <nanovdb/util/IO.h>

namespace lanelight {

/// Where NanoVDB puts a grid. Its own buffer does not notice that there is no memory.
class GridBytes {
 public:
  GridBytes() = default;
  static GridBytes create(std::uint64_t size, const GridBytes* = nullptr) {
    GridBytes bytes;
    bytes.bytes_.resize(size);
    return bytes;
  }
  std::uint8_t* data() { return bytes_.data(); }
  const std::uint8_t* data() const { return bytes_.data(); }
  std::uint64_t size() const { return bytes_.size(); }
  bool empty() const { return bytes_.empty(); }
  void clear() { bytes_.clear(); }

 private:
  AlignedVector<std::uint8_t> bytes_;
};
using GridBuffer = nanovdb::GridHandle<GridBytes>;

/// Voxels along a side of a block that is stored.
inline constexpr int kLeafSide = 8;

/// See SparseGrid.
template <typename BuildT>
class TypedGrid final : public SparseGrid {
 public:
  using Grid = nanovdb::NanoGrid<BuildT>;
  explicit TypedGrid(GridBuffer buffer);

  void Interpolate(const float* x, const float* y, const float* z, std::size_t count,
                   float* out) const override {
    auto access = grid().getAccessor();
    for (std::size_t i = 0; i < count; ++i) {
      out[i] = InterpolateOne(access, x[i], y[i], z[i]);
    }
  }
  float Value(int i, int j, int k) const override {
    return grid().tree().getValue({i, j, k});
  }
  float LargestIn(const int low[3], const int high[3]) const override {
    return RangeIn(low, high).second;
  }

 private:
  using Range = std::pair<float, float>;

  const Grid& grid() const { return *reinterpret_cast<const Grid*>(buffer_.data()); }
  template <typename Access>
  static float InterpolateOne(const Access& access, float x, float y, float z);
  Range RangeIn(const int low[3], const int high[3]) const;
  template <typename Access>
  static void AddBlock(const Access& access, const int first[3], const int last[3],
                       Range* range);
  void SetPlace();

  GridBuffer buffer_;
};

template <typename BuildT>
TypedGrid<BuildT>::TypedGrid(GridBuffer buffer) : buffer_(std::move(buffer)) {
  bytes_ = buffer_.size();
  SetPlace();
  const auto box = grid().indexBBox();
  const int low[3] = {box.min()[0], box.min()[1], box.min()[2]};
  const int high[3] = {box.max()[0], box.max()[1], box.max()[2]};
  const Range stored = RangeIn(low, high);
  const float background = grid().tree().background();
  smallest_ = std::min(stored.first, background);
  largest_ = std::max(stored.second, background);
}

template <typename BuildT>
void TypedGrid<BuildT>::SetPlace() {
  const auto& box = grid().worldBBox();
  box_min_ = {box.min()[0], box.min()[1], box.min()[2]};
  box_max_ = {box.max()[0], box.max()[1], box.max()[2]};
  const nanovdb::Map& map = grid().map();
  Transform::Matrix m = {};
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      m[r][c] = map.mInvMatD[3 * r + c];
      m[r][3] -= m[r][c] * map.mVecD[c];
    }
  }
  m[3][3] = 1;
  index_from_world_ = Transform(m);
}

template <typename BuildT>
template <typename Access>
float TypedGrid<BuildT>::InterpolateOne(const Access& access, float x, float y, float z) {
  constexpr float kFar = 1e9f;
  const auto near = [](float v) { return v > -kFar && v < kFar; };  // nor is it NaN
  if (!near(x) || !near(y) || !near(z)) return 0;
  const float low[3] = {std::floor(x), std::floor(y), std::floor(z)};
  const float part[3] = {x - low[0], y - low[1], z - low[2]};
  const int i = static_cast<int>(low[0]), j = static_cast<int>(low[1]);
  const int k = static_cast<int>(low[2]);
  const auto along_z = [&](int di, int dj) {
    const float near_z = access.getValue({i + di, j + dj, k});
    const float far_z = access.getValue({i + di, j + dj, k + 1});
    return near_z + part[2] * (far_z - near_z);
  };
  const auto along_y = [&](int di) {
    const float a = along_z(di, 0), b = along_z(di, 1);
    return a + part[1] * (b - a);
  };
  const float a = along_y(0), b = along_y(1);
  return a + part[0] * (b - a);
}

// Of the voxels first to last, which lie in one block that is a leaf, or has one value.
template <typename BuildT>
template <typename Access>
void TypedGrid<BuildT>::AddBlock(const Access& access, const int first[3],
                                 const int last[3], Range* range) {
  const auto add = [&](float v) {
    // Written so that NaN becomes an infinite value.
    if (!(v >= range->first)) range->first = v < range->first ? v : -INFINITY;
    if (!(v <= range->second)) range->second = v > range->second ? v : INFINITY;
  };
  if (access.probeLeaf({first[0], first[1], first[2]}) == nullptr) {
    return add(access.getValue({first[0], first[1], first[2]}));
  }
  for (int i = first[0]; i <= last[0]; ++i) {
    for (int j = first[1]; j <= last[1]; ++j) {
      for (int k = first[2]; k <= last[2]; ++k) add(access.getValue({i, j, k}));
    }
  }
}

template <typename BuildT>
auto TypedGrid<BuildT>::RangeIn(const int low[3], const int high[3]) const -> Range {
  const auto access = grid().getAccessor();
  constexpr float kMost = std::numeric_limits<float>::max();
  Range range = {kMost, -kMost};
  int first[3], last[3];
  const auto next = [&](int a) {
    last[a] = std::min(high[a], first[a] | (kLeafSide - 1));
    return first[a] <= high[a];
  };
  for (first[0] = low[0]; next(0); first[0] = last[0] + 1) {
    for (first[1] = low[1]; next(1); first[1] = last[1] + 1) {
      for (first[2] = low[2]; next(2); first[2] = last[2] + 1) {
        AddBlock(access, first, last, &range);
      }
    }
  }
  return range;
}

}  // namespace lanelight
