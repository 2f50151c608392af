#include "src/base/image/sparse_grid.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <exception>
#include <fstream>
#include <utility>

#include "src/base/core/error.h"
#include "src/base/core/error_text.h"
#include "src/base/core/input_file.h"
#include "src/base/image/nanovdb_check.h"
#include "src/base/image/nanovdb_file.h"
#include "src/base/image/nanovdb_grid.h"
#include "src/base/image/nanovdb_sums.h"

namespace lanelight {
namespace {

// Media are computed in index space.
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
      throw InputError(
          fmt::format("has a box that reaches to voxel {}; at most {} is "
                      "supported",
                      at[a], kFarthestVoxel));
    }
  }
}

void CheckValues(const SparseGrid& grid) {
  for (const float v : {grid.smallest(), grid.largest()}) {
    if (!std::isfinite(v)) throw InputError("has values that are not finite");
    if (std::abs(v) <= kLargestVoxel) continue;
    throw InputError(
        fmt::format("has the value {}; at most {} is supported", v, kLargestVoxel));
  }
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
      throw InputError(fmt::format(
          "has values of type {}; supported: float, Fp4, Fp8, Fp16, FpN",
          known ? nanovdb::toStr(type) : std::to_string(static_cast<unsigned>(type))));
    }
  }
}

}  // namespace

std::shared_ptr<const SparseGrid> MakeSparseGrid(GridBytes bytes) {
  const auto& head = *reinterpret_cast<const nanovdb::GridData*>(bytes.data());
  CheckHead(head, bytes.size());
  if (head.mGridClass == nanovdb::GridClass::LevelSet) {
    throw InputError(
        "is a level set, distances to a surface; a medium needs a fog volume");
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
    throw InputError(
        fmt::format("cannot read NanoVDB file \"{}\": {}", path, WithoutPrefix(error)));
  }
  if (!stored) return nullptr;
  try {
    return MakeSparseGrid(std::move(stored->bytes));
  } catch (const InputError& error) {
    throw InputError(fmt::format("grid \"{}\" from byte {} of NanoVDB file \"{}\" {}",
                                 name, stored->place, path, WithoutPrefix(error)));
  }
}

std::shared_ptr<const SparseGrid> ReadSparseGrid(const std::string& path,
                                                 const std::string& name) {
  try {
    OpenInputFile(path);  // a stream would wait for a FIFO
  } catch (const Unreadable& problem) {
    throw InputError(
        fmt::format("cannot read NanoVDB file \"{}\": {}", path, problem.reason()));
  }
  std::ifstream file(path, std::ios::binary);
  return ReadSparseGrid(file, path, name);
}

}  // namespace lanelight
