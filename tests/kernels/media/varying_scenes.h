// Scenes with one medium that varies, and scenes with none, that must look the same.
#pragma once

#include "src/base/image/sparse_grid.h"
#include "tests/base/image/sparse_grid_file.h"
#include "tests/base/image/temporary_folder.h"
#include "tests/kernels/media/scenes.h"

namespace lanelight::test {

/// A slab of 0.8 across the view, filled by the medium, before an environment.
inline SceneDescription Slab(const Medium& medium, Rgb environment = {}) {
  SceneBuilder b(4, 4);
  b.Orthographic({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 1);
  b.AddBox({-3, -3, -0.4}, {3, 3, 0.4}, AddInterface(b));
  Bound(b, AddMedium(b, medium), kNone);
  b.AddEnvironment(environment);
  return b.Build();
}

/// Voxels of a constant over a box around the slab.
inline Medium ConstantGrid(Rgb sigma_a, Rgb sigma_s) {
  Medium medium = MakeMedium(sigma_a, sigma_s);
  medium.kind = MediumKind::kUniformGrid;
  medium.grid_size[0] = medium.grid_size[1] = medium.grid_size[2] = 4;
  medium.grid.assign(64, 1.0f);
  medium.box_min = {-8, -8, -8};
  medium.box_max = {8, 8, 8};
  return medium;
}

/// Of the file's only grid, or grids.
inline Medium SparseMedium(const std::string& path, Rgb sigma_a, Rgb sigma_s) {
  Medium medium = MakeMedium(sigma_a, sigma_s);
  medium.kind = MediumKind::kNanoVdb;
  medium.sparse_density = ReadSparseGrid(path, "density");
  medium.sparse_temperature = ReadSparseGrid(path, "temperature");
  medium.box_min = medium.sparse_density->box_min();
  medium.box_max = medium.sparse_density->box_max();
  return medium;
}

inline Medium ConstantSparse(const std::string& path, Rgb sigma_a, Rgb sigma_s,
                             float temperature = 0) {
  SparseFileGrid grid, heat;
  for (SparseFileGrid* g : {&grid, &heat}) {
    for (int a = 0; a < 3; ++a) g->low[a] = -9, g->high[a] = 9;
    g->value = [](int, int, int) { return 1.0f; };
  }
  heat.name = "temperature";
  heat.value = [temperature](int, int, int) { return temperature; };
  if (temperature > 0) {
    WriteSparseFile(path, {grid, heat});
  } else {
    WriteSparseFile(path, {grid});
  }
  return SparseMedium(path, sigma_a, sigma_s);
}

/// A medium in a ball over a floor, below a lamp and a sky.
inline SceneDescription BallOf(const Medium& medium, int size = 8) {
  SceneBuilder b(size, size);
  b.Depth(4).Perspective({0, -5, 1.5}, {0, 0, 0.8}, {0, 0, 1}, 30);
  b.AddPlane({0, 0, -0.2}, {0, 0, 1}, b.AddDiffuse({0.6, 0.5, 0.4}));
  b.AddSphere({0, 0, 0.9}, 0.9, AddInterface(b));
  Bound(b, AddMedium(b, medium), kNone);
  b.AddQuad({-1, -1, 3}, {0, 2, 0}, {2, 0, 0}, b.AddDiffuse(Grey(0)),
            b.AddEmission({5, 5, 4}));
  b.AddEnvironment({0.3, 0.3, 0.3});
  return b.Build();
}

inline Medium CloudLump() {
  Medium cloud = MakeMedium({4, 5, 6}, {4, 3, 2}, 0.4);
  cloud.kind = MediumKind::kCloud;
  cloud.density = 4, cloud.wispiness = 0.7, cloud.frequency = 2;
  cloud.box_min = {-1, 0.45, -1};  // nearly all of it above what is solid
  cloud.box_max = {1, 1.3, 1};
  cloud.world_from_medium = Transform::Translate({0, 0, 0.2}) *
                            Transform::Rotate(90, {1, 0, 0}) *
                            Transform::Scale({0.8, 1.1, 0.8});
  return cloud;
}

/// Densities and temperatures on grids of different extents and fineness.
inline Medium SparseLump(const TemporaryFolder& folder) {
  SparseFileGrid lump, heat;
  for (int a = 0; a < 3; ++a) lump.low[a] = -6, lump.high[a] = 9;
  lump.value = [](int i, int j, int k) {
    return (i * 3 + j * 5 + k * 7 + 200) % 4 == 0 ? 0.5f * ((i + j + k + 30) % 5) : 0.0f;
  };
  lump.voxel_size = 0.1;
  lump.type = SparseType::kFp8;
  heat.name = "temperature";
  for (int a = 0; a < 3; ++a) heat.low[a] = -2, heat.high[a] = 3;
  heat.value = [](int i, int j, int k) { return 10.0f + i + 2 * j + k; };
  heat.voxel_size = 0.25;
  WriteSparseFile(folder.File("lump.nvdb"), {lump, heat});
  Medium medium = SparseMedium(folder.File("lump.nvdb"), {2, 3, 4}, {3, 2, 2});
  medium.box_min = Min(medium.box_min, medium.sparse_temperature->box_min());
  medium.box_max = Max(medium.box_max, medium.sparse_temperature->box_max());
  medium.emission = {0.05, 0.05, 0.05};
  medium.temperature_offset = 2, medium.temperature_scale = 250;
  medium.g = -0.3;
  medium.world_from_medium =
      Transform::Translate({0, 0, 0.9}) * Transform::Rotate(30, {1, 1, 0});
  return medium;
}

}  // namespace lanelight::test
