#include "src/base/image/sparse_grid.h"

#include <zlib.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <exception>
#include <fstream>
#include <utility>

#include "src/base/core/error.h"
#include "src/base/core/input_file.h"
#include "src/base/image/nanovdb_check.h"
#include "src/base/image/nanovdb_file.h"
#include "src/base/image/nanovdb_grid.h"

// Defines how checksums are stored.
#include <nanovdb/util/GridChecksum.h>

namespace lanelight {
namespace {

// Media kernels work in index space.
void CheckPlace(const SparseGrid& grid) {
  if (!grid.index_from_world().IsInvertible()) {
    throw InputError("has a transform that cannot be inverted");
  }
  const Vec3d low = grid.box_min(), high = grid.box_max(), size = high - low;
  if (!(size.x > 0 && size.y > 0 && size.z > 0)) throw InputError("has no active voxel");
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3d at = grid.index_from_world().Point({corner & 1 ? high.x : low.x,
                                                    corner & 2 ? high.y : low.y,
                                                    corner & 4 ? high.z : low.z});
    for (int a = 0; a < 3; ++a) {
      if (std::abs(at[a]) <= kFarthestVoxel) continue;  // nor is it NaN
      throw InputError("has a bounding box up to voxel {}; at most {} is supported",
                       at[a], kFarthestVoxel);
    }
  }
}

void CheckValues(const SparseGrid& grid) {
  for (const float v : {grid.smallest(), grid.largest()}) {
    if (!std::isfinite(v)) throw InputError("has values that are not finite");
    if (std::abs(v) <= kLargestVoxel) continue;
    throw InputError("has the value {}; at most {} is supported", v, kLargestVoxel);
  }
}

// Adds a CRC-32 of each node of a level, in the order that NanoVDB takes them in.
template <typename BuildT, typename Node>
void AddSums(const nanovdb::NanoGrid<BuildT>& grid, std::vector<std::uint64_t> places,
             std::vector<std::uint_fast32_t>* sums) {
  // In file order if all have the same size, else in the order of lookups.
  if (grid.isBreadthFirst() && nanovdb::NanoLeaf<BuildT>::FIXED_SIZE) {
    std::sort(places.begin(), places.end());
  }
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(&grid);
  for (const std::uint64_t place : places) {
    sums->push_back(crc32_z(0, bytes + place, sizeof(Node)));
  }
}

// Checks both checksums: of the bytes up to the end of the root, and of the sums of all
// nodes. InputError if one differs. `tree` must have passed its check.
template <typename BuildT>
void CheckSums(const nanovdb::NanoGrid<BuildT>& grid, const TreeCheck<BuildT>& tree) {
  const nanovdb::GridChecksum stored(grid.checksum());
  const auto check = [&](int n, std::uint64_t found) {
    if (found == stored.crc32(n)) return;
    FailDamaged(PlaceIn(&grid, &grid.data()->mChecksum),
                "the checksum of {} is {:#x}, not {:#x}",
                n == 0 ? "head and root" : "all nodes", found, stored.crc32(n));
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

template <typename BuildT>
std::shared_ptr<const SparseGrid> MakeTyped(GridBytes bytes) {
  const auto& grid = *reinterpret_cast<const nanovdb::NanoGrid<BuildT>*>(bytes.data());
  TreeCheck<BuildT> tree(grid);
  tree.Run();
  CheckSums(grid, tree);
  return std::make_shared<TypedGrid<BuildT>>(std::move(bytes));
}

std::shared_ptr<const SparseGrid> MakeOfType(nanovdb::GridType type, GridBytes bytes) {
  switch (type) {
    case nanovdb::GridType::Float:
      return MakeTyped<float>(std::move(bytes));
    case nanovdb::GridType::Fp4:
      return MakeTyped<nanovdb::Fp4>(std::move(bytes));
    case nanovdb::GridType::Fp8:
      return MakeTyped<nanovdb::Fp8>(std::move(bytes));
    case nanovdb::GridType::Fp16:
      return MakeTyped<nanovdb::Fp16>(std::move(bytes));
    case nanovdb::GridType::FpN:
      return MakeTyped<nanovdb::FpN>(std::move(bytes));
    default: {
      const bool known = type < nanovdb::GridType::End;
      throw InputError(
          "has values of type {}; supported: float, Fp4, Fp8, Fp16, FpN",
          known ? nanovdb::toStr(type) : std::to_string(static_cast<unsigned>(type)));
    }
  }
}

}  // namespace

std::shared_ptr<const SparseGrid> MakeSparseGrid(GridBytes bytes) {
  const auto& head = *reinterpret_cast<const nanovdb::GridData*>(bytes.data());
  CheckHead(head, bytes.size());
  if (head.mGridClass == nanovdb::GridClass::LevelSet) {
    throw InputError(
        "is a level set (distances to a surface); a medium needs a fog volume");
  }
  auto grid = MakeOfType(head.mGridType, std::move(bytes));
  CheckValues(*grid);
  CheckPlace(*grid);
  return grid;
}

std::shared_ptr<const SparseGrid> ReadSparseGrid(std::istream& file,
                                                 const std::string& path,
                                                 const std::string& name) {
  std::optional<StoredGrid> stored;
  try {
    stored = ReadStoredGrid(file, name);
  } catch (const std::exception& error) {
    throw InputError("cannot read NanoVDB file \"{}\": {}", path, WithoutPrefix(error));
  }
  if (!stored) return nullptr;
  try {
    return MakeSparseGrid(std::move(stored->bytes));
  } catch (const InputError& error) {
    throw InputError("grid \"{}\" from byte {} of NanoVDB file \"{}\" {}", name,
                     stored->place, path, WithoutPrefix(error));
  }
}

std::shared_ptr<const SparseGrid> ReadSparseGrid(const std::string& path,
                                                 const std::string& name) {
  try {
    OpenInputFile(path);  // a stream would wait for a FIFO
  } catch (const Unreadable& problem) {
    throw InputError("cannot read NanoVDB file \"{}\": {}", path, problem.reason());
  }
  std::ifstream file(path, std::ios::binary);
  return ReadSparseGrid(file, path, name);
}

}  // namespace lanelight
