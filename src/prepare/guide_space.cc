#include "src/prepare/guide_space.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "src/core/check.h"

namespace lanelight {
namespace {

// Records that decide where to divide a node: more of them tell little more.
constexpr std::size_t kMostLookedAt = 1024;
// Standard deviation of a component of the normals from which they are divided: two walls
// of which one has a sixth of the records, at a right angle.
constexpr double kNormalSpread = 0.35;

float ValueOf(const GuideRecord& r, int axis) {
  return axis < 3 ? r.from[axis] : r.normal[axis - 3];
}

struct Cut {
  int axis = -1;
  float at = 0;
};

class Divider {
 public:
  explicit Divider(std::span<GuideRecord> records) : records_(records) {}

  Cut Choose() {
    Cut cut = ByNormal();
    return cut.axis >= 0 ? cut : ByPosition();
  }

  // How many records are below the cut, once they lie first.
  std::size_t Apply(const Cut& cut) {
    const auto middle = std::partition(
        records_.begin(), records_.end(),
        [&](const GuideRecord& r) { return ValueOf(r, cut.axis) < cut.at; });
    return static_cast<std::size_t>(middle - records_.begin());
  }

 private:
  // Values of an axis, of records spread evenly over the node.
  void Look(int axis) {
    const std::size_t n = std::min(records_.size(), kMostLookedAt);
    values_.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      values_[i] = ValueOf(records_[i * records_.size() / n], axis);
    }
  }
  float Quantile(double share) {
    const auto at = static_cast<std::ptrdiff_t>(share * double(values_.size() - 1));
    std::nth_element(values_.begin(), values_.begin() + at, values_.end());
    return values_[static_cast<std::size_t>(at)];
  }

  Cut ByNormal() {
    Cut cut;
    double widest = kNormalSpread;
    for (int axis = 3; axis < 6; ++axis) {
      Look(axis);
      double sum = 0, squares = 0;
      for (float v : values_) sum += double{v}, squares += double{v} * double{v};
      const double n = double(values_.size()), mean = sum / n;
      const double spread = std::sqrt(std::max(0.0, squares / n - mean * mean));
      if (!(spread > widest)) continue;
      widest = spread;
      cut.axis = axis;
      cut.at = (Quantile(0.02) + Quantile(0.98)) / 2;
    }
    return cut;
  }

  Cut ByPosition() {
    Cut cut;
    double widest = 0;
    for (int axis = 0; axis < 3; ++axis) {
      Look(axis);
      const double spread = double{Quantile(0.95)} - double{Quantile(0.05)};
      if (!(spread > widest)) continue;
      widest = spread;
      cut.axis = axis;
      cut.at = Quantile(0.5);
    }
    return cut;
  }

  std::span<GuideRecord> records_;
  std::vector<float> values_;
};

}  // namespace

std::vector<GuideSpaceNode> DivideGuideSpace(std::vector<GuideRecord>& records,
                                             std::size_t most, std::size_t most_cells) {
  LL_CHECK(most > 0 && most_cells > 0);
  std::vector<GuideSpaceNode> nodes(1);
  nodes[0].end = records.size();
  std::size_t cells = 1;
  for (std::size_t i = 0; i < nodes.size() && cells < most_cells; ++i) {
    GuideSpaceNode node = nodes[i];
    if (node.count() <= most || node.depth == kGuideDepth) continue;
    Divider divider({records.data() + node.begin, node.count()});
    const Cut cut = divider.Choose();
    if (cut.axis < 0) continue;  // all in one place
    const std::size_t middle = node.begin + divider.Apply(cut);
    if (middle == node.begin || middle == node.end) continue;
    nodes[i].axis = cut.axis;
    nodes[i].at = cut.at;
    nodes[i].first_child = static_cast<std::uint32_t>(nodes.size());
    nodes.push_back({node.begin, middle, node.depth + 1});
    nodes.push_back({middle, node.end, node.depth + 1});
    ++cells;
  }
  return nodes;
}

}  // namespace lanelight
