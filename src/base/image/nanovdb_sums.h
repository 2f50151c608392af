// The checksums of a NanoVDB grid, where it has some. For sparse_grid.cc alone: the
// headers of NanoVDB are long.
#pragma once

#include <zlib.h>

#include "src/base/image/nanovdb_check.h"

// For how checksums are stored.
#include <nanovdb/util/GridChecksum.h>

namespace lanelight {

/// Adds a CRC-32 of each node of a level, in the order that NanoVDB takes them in.
template <typename BuildT, typename Node>
void AddSums(const nanovdb::NanoGrid<BuildT>& grid, std::vector<std::uint64_t> places,
             std::vector<std::uint_fast32_t>* sums) {
  // As they lie, where they have all one size; else as lookups reach them.
  if (grid.isBreadthFirst() && nanovdb::NanoLeaf<BuildT>::FIXED_SIZE) {
    std::sort(places.begin(), places.end());
  }
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(&grid);
  for (const std::uint64_t place : places) {
    sums->push_back(crc32_z(0, bytes + place, sizeof(Node)));
  }
}

/// Two sums: of everything behind them to the end of the root, and of the sums of all
/// nodes. InputError if one differs. Only for what `tree` has found no fault with.
template <typename BuildT>
void CheckSums(const nanovdb::NanoGrid<BuildT>& grid, const TreeCheck<BuildT>& tree) {
  const nanovdb::GridChecksum stored(grid.checksum());
  const auto check = [&](int n, std::uint64_t found) {
    if (found == stored.crc32(n)) return;
    FailDamaged(
        PlaceIn(&grid, &grid.data()->mChecksum),
        fmt::format("the checksum of {} is {:#x}, not {:#x}",
                    n == 0 ? "head and root" : "all nodes", found, stored.crc32(n)));
  };
  if (stored.isEmpty()) return;
  const auto* begin = reinterpret_cast<const std::uint8_t*>(&grid.data()->mVersion);
  const auto& root = grid.tree().root();
  const std::uint64_t end = sizeof(grid) + sizeof(grid.tree()) + root.memUsage();
  check(0, crc32_z(0, begin, end - PlaceIn(&grid, begin)));
  if (!stored.isFull() || root.isEmpty()) return;
  std::vector<std::uint_fast32_t> sums;
  AddSums<BuildT, nanovdb::NanoUpper<BuildT>>(grid, tree.nodes(2), &sums);
  AddSums<BuildT, nanovdb::NanoLower<BuildT>>(grid, tree.nodes(1), &sums);
  AddSums<BuildT, nanovdb::NanoLeaf<BuildT>>(grid, tree.nodes(0), &sums);
  check(1, crc32_z(0, reinterpret_cast<const std::uint8_t*>(sums.data()),
                   sums.size() * sizeof(sums[0])));
}

}  // namespace lanelight
