#include "src/image/sparse_grid.h"

#include <cmath>
#include <exception>
#include <utility>

#include "src/core/error.h"
#include "src/core/error_text.h"
#include "src/image/nanovdb_grid.h"

namespace lanelight {
namespace {

void CheckValues(const SparseGrid& grid, bool is_level_set) {
  if (is_level_set) {
    throw InputError(
        "is a level set, distances to a surface; a medium needs a fog volume");
  }
  if (!std::isfinite(grid.smallest()) || !std::isfinite(grid.largest())) {
    throw InputError("has values that are not finite");
  }
  if (!grid.index_from_world().IsInvertible()) {
    throw InputError("has a transform that cannot be inverted");
  }
  const Vec3d size = grid.box_max() - grid.box_min();
  if (!(size.x > 0 && size.y > 0 && size.z > 0)) throw InputError("has no active voxel");
}

template <typename BuildT>
std::shared_ptr<const SparseGrid> MakeTyped(GridBuffer buffer) {
  const auto* raw = reinterpret_cast<const nanovdb::NanoGrid<BuildT>*>(buffer.data());
  const std::string damage = nanovdb::GridValidator<BuildT>::check(*raw, true);
  if (!damage.empty()) throw InputError("is damaged: " + damage);
  return std::make_shared<TypedGrid<BuildT>>(std::move(buffer));
}

std::shared_ptr<const SparseGrid> MakeGrid(GridBuffer buffer) {
  const nanovdb::GridType type = buffer.gridMetaData()->gridType();
  switch (type) {
    case nanovdb::GridType::Float:
      return MakeTyped<float>(std::move(buffer));
    case nanovdb::GridType::Fp4:
      return MakeTyped<nanovdb::Fp4>(std::move(buffer));
    case nanovdb::GridType::Fp8:
      return MakeTyped<nanovdb::Fp8>(std::move(buffer));
    case nanovdb::GridType::Fp16:
      return MakeTyped<nanovdb::Fp16>(std::move(buffer));
    case nanovdb::GridType::FpN:
      return MakeTyped<nanovdb::FpN>(std::move(buffer));
    default:
      throw InputError(
          fmt::format("has values of type {}; supported: float, Fp4, Fp8, "
                      "Fp16, FpN",
                      nanovdb::toStr(type)));
  }
}

}  // namespace

std::shared_ptr<const SparseGrid> ReadSparseGrid(const std::string& path,
                                                 const std::string& name) {
  GridBuffer buffer;
  try {
    buffer = nanovdb::io::readGrid<GridBytes>(path, name, 0);
  } catch (const std::exception& error) {
    throw InputError(
        fmt::format("cannot read NanoVDB file \"{}\": {}", path, error.what()));
  }
  if (buffer.empty()) return nullptr;
  try {
    const bool is_level_set = buffer.gridMetaData()->isLevelSet();
    auto grid = MakeGrid(std::move(buffer));
    CheckValues(*grid, is_level_set);
    return grid;
  } catch (const InputError& error) {
    throw InputError(fmt::format("grid \"{}\" of NanoVDB file \"{}\" {}", name, path,
                                 WithoutPrefix(error)));
  }
}

}  // namespace lanelight
