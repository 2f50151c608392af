#include "tests/base/image/sparse_grid_file.h"

#include <iostream>  // NanoVDB uses it and does not include it

#define NANOVDB_USE_ZIP
#define NANOVDB_USE_BLOSC
#include <nanovdb/NanoVDB.h>
#include <nanovdb/util/GridBuilder.h>
#include <nanovdb/util/IO.h>

namespace lanelight::test {
namespace {

using SparseHandle = nanovdb::GridHandle<>;

template <typename BuildT>
SparseHandle BuildSparse(const SparseFileGrid& grid) {
  nanovdb::GridBuilder<float, BuildT> builder(0.0f);
  builder.setGridClass(grid.level_set ? nanovdb::GridClass::LevelSet
                                      : nanovdb::GridClass::FogVolume);
  builder.setChecksum(grid.checksum ? nanovdb::ChecksumMode::Full
                                    : nanovdb::ChecksumMode::Disable);
  const nanovdb::CoordBBox box({grid.low[0], grid.low[1], grid.low[2]},
                               {grid.high[0], grid.high[1], grid.high[2]});
  if (grid.tiles) {
    const auto value = [&](const nanovdb::Coord& p) {
      return grid.value(p[0], p[1], p[2]);
    };
    builder(value, box);
  } else {
    auto access = builder.getAccessor();
    for (auto p = box.begin(); p; ++p) {
      const float v = grid.value((*p)[0], (*p)[1], (*p)[2]);
      if (v != 0) access.setValue(*p, v);
    }
  }
  const double* o = grid.origin;
  return builder.getHandle(grid.voxel_size, {o[0], o[1], o[2]}, grid.name);
}

SparseHandle BuildSparseOf(const SparseFileGrid& grid) {
  switch (grid.type) {
    case SparseType::kFp4:
      return BuildSparse<nanovdb::Fp4>(grid);
    case SparseType::kFp8:
      return BuildSparse<nanovdb::Fp8>(grid);
    case SparseType::kFp16:
      return BuildSparse<nanovdb::Fp16>(grid);
    case SparseType::kFpN:
      return BuildSparse<nanovdb::FpN>(grid);
    default:
      return BuildSparse<float>(grid);
  }
}

}  // namespace

void WriteSparseFile(const std::string& path, const std::vector<SparseFileGrid>& grids,
                     SparseCodec codec) {
  std::vector<SparseHandle> handles;
  for (const SparseFileGrid& grid : grids) handles.push_back(BuildSparseOf(grid));
  const auto to = codec == SparseCodec::kZip     ? nanovdb::io::Codec::ZIP
                  : codec == SparseCodec::kBlosc ? nanovdb::io::Codec::BLOSC
                                                 : nanovdb::io::Codec::NONE;
  nanovdb::io::writeGrids<nanovdb::HostBuffer, std::vector>(path, handles, to);
}

}  // namespace lanelight::test
