#include "src/wavefront/scene_copies.h"

#include "src/accel/tree_parts.h"

namespace lanelight {
namespace {

// Copies of a scene share its arrays of trees: these have arrays of their own.
template <typename T>
void OwnMemory(SharedArray<T>& array) {
  array = AlignedVector<T>(array.begin(), array.end());
}
template <typename T>
void OwnMemory(T&) {}

std::unique_ptr<const CompiledScene> Copy(const CompiledScene& scene) {
  auto copy = std::make_unique<CompiledScene>(scene);
  VisitParts(copy->accel, [](auto& part) { OwnMemory(part); });
  return copy;
}

}  // namespace

SceneCopies::SceneCopies(const CompiledScene& scene, const MemoryNodes* nodes)
    : scene_(scene), nodes_(nodes) {
  if (nodes == nullptr || nodes->size() == 1) return;
  copies_.resize(static_cast<std::size_t>(nodes->size()));
  nodes->OnEach([&](int node) { copies_[static_cast<std::size_t>(node)] = Copy(scene); });
}

}  // namespace lanelight
