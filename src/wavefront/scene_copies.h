// A scene in the memory of each memory node, where there are several.
#pragma once

#include <memory>
#include <vector>

#include "src/compiled/scene.h"
#include "src/core/memory_nodes.h"

namespace lanelight {

/// The scene that tasks read: the nearest copy. Reading another node's memory takes about
/// twice as long, and shares the link between them with all others who do.
class SceneCopies {
 public:
  /// Copies the scene, trees and all, for each node if there are several; null: no
  /// copies. Refers to both.
  SceneCopies(const CompiledScene& scene, const MemoryNodes* nodes);

  /// The copy of the node that runs this, or the scene itself.
  const CompiledScene& Here() const {
    return copies_.empty() ? scene_ : *copies_[static_cast<std::size_t>(nodes_->Here())];
  }
  /// 0: the scene itself is read.
  int count() const { return static_cast<int>(copies_.size()); }

 private:
  const CompiledScene& scene_;
  const MemoryNodes* nodes_;
  std::vector<std::unique_ptr<const CompiledScene>> copies_;
};

}  // namespace lanelight
