// Shapes, and a folder in which their tree may be.
#pragma once

#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "src/accel/tree_source.h"
#include "tests/image/temporary_folder.h"
#include "tests/support/brute_force.h"

namespace lanelight {

inline Geometry SomeShapes(float edge) {
  brute::Random random(65);
  return MakeScene(brute::Soup(random, 3000, 1, edge)).geometry;
}

struct TreeSources {
  TemporaryFolder folder;
  Geometry shapes = SomeShapes(0.1f);
  TreeSource source = {{.path = folder.File("deep/down")}, nullptr};

  FoundTree Find() const { return FindTree(shapes, {}, source); }
  std::string Path() const {
    return source.folder.path + "/" + KeyOf(shapes, {}).Hex() + ".tree";
  }
  /// Names of what is in the folder.
  std::vector<std::string> Files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(source.folder.path)) {
      names.push_back(entry.path().filename());
    }
    return names;
  }
};

inline bool SameNodes(const Accel& a, const Accel& b) {
  return a.nodes.size() == b.nodes.size() &&
         std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size() * sizeof(WideNode)) ==
             0;
}

}  // namespace lanelight
