#include "src/prepare/guide_restore.h"

#include <cmath>
#include <vector>

#include "src/prepare/guide_cell.h"

namespace lanelight {
namespace {

// Kernels follow as many levels as there can be, and no node but these.
const char* TreeFault(const Guide& guide) {
  std::vector<int> depth(guide.nodes.size(), 0);
  for (std::size_t i = 0; i < guide.nodes.size(); ++i) {
    const Guide::Node& node = guide.nodes[i];
    const std::uint32_t axis = node.next & 7;
    const std::size_t next = node.next >> 3;
    if (axis == Guide::Node::kLeaf) {
      if (next >= guide.cells()) return "a leaf names a cell that is not there";
      continue;
    }
    if (axis > 5) return "a node divides an axis that is not there";
    // Children behind their parent: no path comes back.
    if (next <= i || next + 1 >= guide.nodes.size()) {
      return "a node names children that are not there";
    }
    if (!std::isfinite(node.at)) return "a node divides at no number";
    if (depth[i] == kGuideDepth) return "the tree has too many levels";
    depth[next] = depth[next + 1] = depth[i] + 1;
  }
  return nullptr;
}

// Of rows, or of the squares of one: increasing, up to 1.
bool AreBounds(const float* bounds) {
  float before = 0;
  for (int i = 0; i < kGuideGrid; ++i) {
    if (!(bounds[i] > before && bounds[i] <= 1)) return false;
    before = bounds[i];
  }
  return before == 1;
}

}  // namespace

std::string CompleteGuide(Guide& guide) {
  const std::size_t cells = guide.cells();
  if (guide.nodes.empty() || cells == 0) return "it is empty";
  if (guide.cumulative.size() != cells * kGuideBounds) {
    return "its cells have not all their bounds";
  }
  if (const char* fault = TreeFault(guide)) return fault;
  guide.density.assign(cells * kGuideSquares, 0.0f);
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const float fraction = guide.fraction[cell];
    if (!(fraction >= 0 && fraction < 1)) return "a fraction is not in [0, 1)";
    for (std::size_t row = 0; row <= kGuideGrid; ++row) {
      if (!AreBounds(&guide.cumulative[cell * kGuideBounds + row * kGuideGrid])) {
        return "a cell's bounds do not rise to 1";
      }
    }
    SetGuideDensities(guide, static_cast<std::uint32_t>(cell));
  }
  return "";
}

}  // namespace lanelight
