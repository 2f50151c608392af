// Checks all offsets in a NanoVDB grid before lookups follow them. Only sparse_grid.cc
// includes this file, because the headers of NanoVDB are long.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iostream>  // NanoVDB uses it and does not include it
#include <string>
#include <vector>

#include "src/base/core/error.h"

// NanoVDB 32.
#include <nanovdb/NanoVDB.h>

namespace lanelight {

/// Says at which byte of the grid it is damaged, and how.
template <class... Args>
[[noreturn]] void FailDamaged(std::uint64_t place, fmt::format_string<Args...> format,
                              Args&&... args) {
  const std::string text = fmt::format(format, std::forward<Args>(args)...);
  throw InputError("is damaged at its byte {}: {}", place, text);
}

/// Returns the offset of a part in its grid.
inline std::uint64_t PlaceIn(const void* grid, const void* part) {
  return static_cast<std::uint64_t>(static_cast<const std::uint8_t*>(part) -
                                    static_cast<const std::uint8_t*>(grid));
}

/// Checks everything that does not depend on the type of values; the grid has `size`
/// bytes.
inline void CheckHead(const nanovdb::GridData& grid, std::uint64_t size) {
  if (size < sizeof grid) {
    FailDamaged(0, "a grid of {} bytes is too short; its header alone takes {}", size,
                sizeof grid);
  }
  if (grid.mMagic != NANOVDB_MAGIC_NUMBER) {
    FailDamaged(PlaceIn(&grid, &grid.mMagic), "wrong magic number of a grid");
  }
  if (grid.mVersion.getMajor() != NANOVDB_MAJOR_VERSION_NUMBER) {
    FailDamaged(PlaceIn(&grid, &grid.mVersion), "version {}; supported: {}",
                grid.mVersion.getMajor(), NANOVDB_MAJOR_VERSION_NUMBER);
  }
  if (grid.mGridSize > size) {
    FailDamaged(PlaceIn(&grid, &grid.mGridSize), "a size of {} bytes, but there are {}",
                grid.mGridSize, size);
  }
}

/// True if lookups stay within the grid. Values may be any.
template <typename BuildT>
class TreeCheck {
 public:
  /// After CheckHead.
  explicit TreeCheck(const nanovdb::NanoGrid<BuildT>& grid)
      : grid_(grid), size_(grid.gridSize()) {}

  /// InputError without the grid's name.
  void Run() {
    CheckRoot();
    for (std::uint32_t i = 0; i < Root().tileCount(); ++i) {
      const auto* tile = Root().data()->tile(i);
      const std::uint64_t place = root_ + static_cast<std::uint64_t>(tile->child);
      if (tile->isChild()) VisitNode<Upper>(Place(&tile->child), place);
    }
    CheckCount<Upper>();
    CheckCount<Lower>();
    CheckCount<Leaf>();
  }
  /// Places of all nodes of a level, 0 being that of leaves, as lookups reach them.
  const std::vector<std::uint64_t>& nodes(int level) const { return nodes_[level]; }

 private:
  using RootNode = nanovdb::NanoRoot<BuildT>;
  using Upper = nanovdb::NanoUpper<BuildT>;
  using Lower = nanovdb::NanoLower<BuildT>;
  using Leaf = nanovdb::NanoLeaf<BuildT>;

  std::uint64_t Place(const void* part) const { return PlaceIn(&grid_, part); }
  const auto& Tree() const { return *grid_.tree().data(); }
  const RootNode& Root() const { return grid_.tree().root(); }

  // Something of `count` bytes, which what stands at byte `from` leads to.
  void CheckInside(std::uint64_t from, std::uint64_t place, std::uint64_t count) const {
    const bool fits = place <= size_ && count <= size_ - place;
    if (fits && place >= first_ && place % NANOVDB_DATA_ALIGNMENT == 0) return;
    FailDamaged(from,
                "points to {} bytes at byte {}; the offset must be a multiple of {} and "
                "the range between {} and {}",
                count, place, NANOVDB_DATA_ALIGNMENT, first_, size_);
  }

  void CheckRoot() {
    first_ = sizeof(nanovdb::GridData) + sizeof(Tree());
    if (size_ < first_) {
      FailDamaged(Place(&grid_.data()->mGridSize),
                  "a size of {} bytes is too small; header and tree alone take {}", size_,
                  first_);
    }
    const std::uint64_t& offset = Tree().mNodeOffset[RootNode::LEVEL];
    root_ = sizeof(nanovdb::GridData) + offset;
    CheckInside(Place(&offset), root_, sizeof(RootNode));
    CheckInside(Place(&Root().tileCount()), root_, Root().memUsage());
    CheckTiles();
    first_ = root_ + Root().memUsage();
  }

  void CheckTiles() const {
    std::vector<std::uint64_t> keys;
    for (std::uint32_t i = 0; i < Root().tileCount(); ++i) {
      const auto* tile = Root().data()->tile(i);
      if (RootNode::DataType::CoordToKey(tile->origin()) != tile->key) {
        FailDamaged(Place(&tile->key), "invalid key {}", tile->key);
      }
      keys.push_back(tile->key);
    }
    std::sort(keys.begin(), keys.end());
    if (std::adjacent_find(keys.begin(), keys.end()) == keys.end()) return;
    FailDamaged(root_, "two tiles of the root have the same key");
  }

  template <typename Node>
  void VisitNode(std::uint64_t from, std::uint64_t place) {
    CheckInside(from, place, sizeof(Node));
    const auto& data =
        *nanovdb::PtrAdd<Node>(&grid_, static_cast<std::int64_t>(place))->data();
    std::uint64_t bytes = sizeof(Node);
    if constexpr (!Node::FIXED_SIZE) {  // a leaf with as many bits for a value as it says
      if (data.mFlags >> 5 > 4) {
        FailDamaged(Place(&data.mFlags), "values of {} bits; at most 16",
                    1 << (data.mFlags >> 5));
      }
      bytes = data.memUsage();
      CheckInside(from, place, bytes);
    }
    // Nodes that many lead to would be visited without end, or nearly.
    in_nodes_ += bytes;
    if (in_nodes_ > size_ - first_) {
      FailDamaged(from, "points to a node that already has a parent");
    }
    nodes_[Node::LEVEL].push_back(place);
    if constexpr (Node::LEVEL > 0) {
      for (auto child = data.mChildMask.beginOn(); child; ++child) {
        const std::int64_t& offset = data.mTable[*child].child;
        VisitNode<typename Node::ChildNodeType>(
            Place(&offset), place + static_cast<std::uint64_t>(offset));
      }
    }
  }

  template <typename Node>
  void CheckCount() const {
    const std::uint32_t& count = Tree().mNodeCount[Node::LEVEL];
    const std::size_t found = nodes_[Node::LEVEL].size();
    if (count == found) return;
    FailDamaged(Place(&count), "{} nodes of level {}, but the tree has {}", count,
                Node::LEVEL, found);
  }

  const nanovdb::NanoGrid<BuildT>& grid_;
  std::uint64_t size_;
  std::uint64_t first_ = 0;  // where what is looked for may begin at the earliest
  std::uint64_t root_ = 0;
  std::uint64_t in_nodes_ = 0;  // bytes
  std::vector<std::uint64_t> nodes_[3];
};

}  // namespace lanelight
