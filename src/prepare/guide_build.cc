#include "src/prepare/guide_build.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "src/prepare/guide_cell.h"
#include "src/prepare/guide_fraction.h"
#include "src/prepare/guide_space.h"
#include "src/prepare/guide_square.h"

namespace lanelight {
namespace {

// Levels of the tree whose nodes lend to those below: of more, nothing is left.
constexpr std::size_t kLending = 64;  // times the records of a cell
constexpr double kLargestShare = 1.0 / 16;

using Squares = std::array<double, kGuideSquares>;

// What a record may count for at most: the limit t of t = share * sum of min(mass, t),
// but no less than the fourth largest, or the smallest if there are fewer.
double LargestMass(std::span<const double> masses) {
  std::array<double, 4> top{};
  double sum = 0, least = INFINITY;
  for (double m : masses) {
    if (!(m > 0)) continue;
    sum += m;
    least = std::min(least, m);
    if (m <= top[3]) continue;
    top[3] = m;
    for (std::size_t i = 3; i > 0 && top[i] > top[i - 1]; --i)
      std::swap(top[i], top[i - 1]);
  }
  if (sum == 0) return 0;
  const double floor = top[3] > 0 ? top[3] : least;
  double limit = INFINITY;
  for (int turn = 0; turn < 8; ++turn) {
    double clamped = 0;
    for (double m : masses) clamped += std::min(m, limit);
    const double next = std::max(floor, kLargestShare * clamped);
    if (next >= limit) break;
    limit = next;
  }
  return limit;
}

// Over the four squares whose centres are around the direction.
void Deposit(const GuideRecord& r, double mass, Squares& squares) {
  const double x = double(r.u) / 65536 * kGuideGrid - 0.5;
  const double y = double(r.v) / 65536 * kGuideGrid - 0.5;
  const double left = std::floor(x), low = std::floor(y), fx = x - left, fy = y - low;
  const auto square = [](double i, double j) {
    const double last = kGuideGrid - 1;  // beyond it is the horizon
    return static_cast<std::size_t>(std::clamp(j, 0.0, last) * kGuideGrid +
                                    std::clamp(i, 0.0, last));
  };
  squares[square(left, low)] += mass * (1 - fx) * (1 - fy);
  squares[square(left + 1, low)] += mass * fx * (1 - fy);
  squares[square(left, low + 1)] += mass * (1 - fx) * fy;
  squares[square(left + 1, low + 1)] += mass * fx * fy;
}

class Builder {
 public:
  Builder(std::vector<GuideRecord>& records, const GuideSettings& settings)
      : records_(records), settings_(settings), masses_(records.size()) {
    nodes_ = DivideGuideSpace(records_, settings.cell_records, settings.most_cells);
    for (std::size_t i = 0; i < records_.size(); ++i) masses_[i] = records_[i].Mass();
    for (const GuideSpaceNode& node : nodes_) {
      if (node.axis < 0) Clamp(node);
    }
    guide_.nodes.resize(nodes_.size());
  }

  Guide Build(GuideSummary* summary) {
    Known root;
    root.squares = CosineMasses();
    Visit(0, root);
    if (summary != nullptr) {
      const double n = std::max<double>(double(records_.size()), 1);
      *summary = {guide_.cells(), records_.size(), fractions_ / n, gains_ / n};
    }
    return std::move(guide_);
  }

 private:
  // What a node knows, its own and borrowed.
  struct Known {
    Squares squares;  // of sum 1
    FractionSums fraction;
    double effective = 0;  // records that count
  };

  void Clamp(const GuideSpaceNode& node) {
    const double most = LargestMass({masses_.data() + node.begin, node.count()});
    for (std::size_t i = node.begin; i < node.end; ++i) {
      masses_[i] = std::min(masses_[i], most);
    }
  }

  void Learn(const GuideSpaceNode& node, Known& known) const {
    Squares own{};
    FractionSums fraction;
    double sum = 0, squares = 0;
    for (std::size_t i = node.begin; i < node.end; ++i) {
      const double mass = masses_[i];
      if (!(mass > 0) || !(records_[i].cosine > 0)) continue;
      sum += mass, squares += mass * mass;
      Deposit(records_[i], mass, own);
      fraction.Add(records_[i]);
    }
    known.fraction = fraction.Blend(known.fraction);
    known.effective = squares > 0 ? sum * sum / squares : 0;
    if (!(known.effective > 0)) return;
    const double share = known.effective / (known.effective + settings_.borrowed);
    for (std::size_t s = 0; s < kGuideSquares; ++s) {
      known.squares[s] += share * (own[s] / sum - known.squares[s]);
    }
  }

  void Visit(std::uint32_t index, const Known& around) {
    const GuideSpaceNode& node = nodes_[index];
    Known known = around;
    if (index == 0 || node.axis < 0 ||
        node.count() <= kLending * settings_.cell_records) {
      Learn(node, known);
    }
    Guide::Node& out = guide_.nodes[index];
    if (node.axis < 0) {
      out = {0, Guide::Node::kLeaf | Append(node, known) << 3};
      return;
    }
    out = {node.at, static_cast<std::uint32_t>(node.axis) | node.first_child << 3};
    Visit(node.first_child, known);
    Visit(node.first_child + 1, known);
  }

  std::uint32_t Append(const GuideSpaceNode& node, const Known& known) {
    const auto [fraction, gain] = known.fraction.Best(known.effective);
    fractions_ += fraction * double(node.count());
    gains_ += gain * double(node.count());
    return AppendGuideCell(known.squares, settings_.even, static_cast<float>(fraction),
                           guide_);
  }

  std::vector<GuideRecord>& records_;
  const GuideSettings& settings_;
  std::vector<double> masses_;
  std::vector<GuideSpaceNode> nodes_;
  Guide guide_;
  double fractions_ = 0, gains_ = 0;
};

}  // namespace

Guide BuildGuide(std::vector<GuideRecord>& records, const GuideSettings& settings,
                 GuideSummary* summary) {
  return Builder(records, settings).Build(summary);
}

}  // namespace lanelight
