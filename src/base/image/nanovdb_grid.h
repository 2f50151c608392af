// A NanoVDB grid of one type of values, for sparse_grid.cc alone: its headers are long.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iostream>  // NanoVDB uses it and does not include it
#include <limits>
#include <utility>

#include "src/base/image/nanovdb_file.h"
#include "src/base/image/sparse_grid.h"

// NanoVDB 32.
#include <nanovdb/NanoVDB.h>

namespace lanelight {

/// See SparseGrid.
template <typename BuildT>
class TypedGrid final : public SparseGrid {
 public:
  using Grid = nanovdb::NanoGrid<BuildT>;
  /// Takes bytes that TreeCheck has accepted.
  explicit TypedGrid(GridBytes bytes) : data_(std::move(bytes)) {
    bytes_ = data_.size();
    SetPlace();
    constexpr int kMin = std::numeric_limits<int>::min();
    constexpr int kMax = std::numeric_limits<int>::max();
    const Range all = RangeIn({{kMin, kMin, kMin}, {kMax, kMax, kMax}});
    smallest_ = all.first, largest_ = all.second;
  }

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
    return RangeIn({{low[0], low[1], low[2]}, {high[0], high[1], high[2]}}).second;
  }

 private:
  using Range = std::pair<float, float>;
  struct Box {
    int low[3], high[3];  // both included
  };

  const Grid& grid() const { return *reinterpret_cast<const Grid*>(data_.data()); }

  template <typename Access>
  static float InterpolateOne(const Access& access, float x, float y, float z) {
    const auto near = [](float v) {
      return std::abs(v) < kFarthestVoxel;
    };  // nor is it NaN
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

  static void Add(float value, Range* range) {
    // Written so that NaN becomes an infinite value.
    if (!(value >= range->first)) range->first = value < range->first ? value : -INFINITY;
    if (!(value <= range->second))
      range->second = value > range->second ? value : INFINITY;
  }

  // Sums the part of a node in the box. The position is that of the node's place in its
  // parent: the position stored in the node may be wrong.
  template <typename Node>
  static void AddNode(const Node& node, const nanovdb::Coord& origin, const Box& box,
                      Range* range) {
    constexpr std::int64_t kBits = Node::ChildNodeType::TOTAL, kDim = Node::DIM;
    int first[3], last[3];  // entries of the node
    for (int a = 0; a < 3; ++a) {
      const std::int64_t low = std::int64_t{box.low[a]} - origin[a];
      const std::int64_t high = std::int64_t{box.high[a]} - origin[a];
      first[a] = static_cast<int>(std::clamp<std::int64_t>(low, 0, kDim) >> kBits);
      last[a] = static_cast<int>(std::clamp<std::int64_t>(high, -1, kDim - 1) >> kBits);
    }
    for (int i = first[0]; i <= last[0]; ++i) {
      for (int j = first[1]; j <= last[1]; ++j) {
        std::uint32_t n = ((i << Node::LOG2DIM) + j) << Node::LOG2DIM | first[2];
        for (int k = first[2]; k <= last[2]; ++k, ++n) {
          if constexpr (Node::LEVEL > 0) {
            if (node.data()->isChild(n)) {
              const auto at = origin + (nanovdb::Coord(i, j, k) << kBits);
              AddNode(*node.data()->getChild(n), at, box, range);
            } else {
              Add(node.data()->mTable[n].value, range);
            }
          } else {
            Add(node.data()->getValue(n), range);
          }
        }
      }
    }
  }

  Range RangeIn(const Box& box) const {
    constexpr float kMax = std::numeric_limits<float>::max();
    constexpr int kBits = nanovdb::NanoUpper<BuildT>::TOTAL;
    Range range = {kMax, -kMax};
    const auto& root = grid().tree().root();
    std::uint64_t uncovered = 1;  // places that tiles of the root may have
    for (int a = 0; a < 3; ++a) {
      uncovered *=
          static_cast<std::uint64_t>((box.high[a] >> kBits) - (box.low[a] >> kBits) + 1);
    }
    for (std::uint32_t i = 0; i < root.tileCount(); ++i) {
      const auto* tile = root.data()->tile(i);
      const nanovdb::Coord origin = tile->origin();
      bool meets = true;
      for (int a = 0; a < 3; ++a) {
        const int at = origin[a] >> kBits;
        meets = meets && at >= box.low[a] >> kBits && at <= box.high[a] >> kBits;
      }
      if (!meets) continue;
      --uncovered;
      if (tile->isChild()) {
        AddNode(*root.data()->getChild(tile), origin, box, &range);
      } else {
        Add(tile->value, &range);
      }
    }
    if (uncovered > 0) Add(root.background(), &range);
    return range;
  }

  void SetPlace() {
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

  GridBytes data_;
};

}  // namespace lanelight
