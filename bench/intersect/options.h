// The command line of bench_intersect.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "bench/intersect/compare.h"

#include "src/scene/accel/build.h"

namespace lanelight::bench {

struct Options {
  std::string folder = "../shared/meshes", generated = "out/meshes";
  std::string target, embree_config, csv, json;
  std::vector<std::string> meshes, scenes;
  std::vector<std::string> sets = kRaySets;
  CompareOptions compare;
  int size = 384;
  bool embree = true, open = false, build = false, fast = false;
  int few = -1, leaf = 0;

  AccelOptions Accel() const;
  std::unique_ptr<Peer> MakePeer(const Mesh& mesh) const;
  bool Wants(const RaySet& set) const;
};

void AddOptions(CLI::App& app, Options& o);

/// NAME of one of the two folders, NAME4 or NAME16 (subdivided once or twice), all in a
/// closed box unless --open; cornell, ballN. Throws InputError.
Mesh FindMesh(const Options& o, const std::string& name);

/// Throws InputError if the files of one of the meshes are missing.
void CheckMeshes(const Options& o);

}  // namespace lanelight::bench
