#include "src/scene/accel/splits.h"

#include <algorithm>
#include <array>
#include <vector>

#include "src/base/core/parallel.h"
#include "src/scene/accel/partition.h"

namespace lanelight {
namespace {

// Bins per axis for many items, and for few, where sweeping bins costs more than it
// gains.
constexpr int kBins = 32, kFewBins = 12;
constexpr std::uint32_t kFewItems = 64;

struct Bin {
  WideBox box;
  std::uint32_t count = 0;
};

// Maps an item to its bin: (center2 - lo) * scale, monotonic in the centre.
struct Binning {
  Vec3f lo, scale;
  int bins;

  Binning(const AccelBox& centers, std::uint32_t count)
      : lo(centers.lo), bins(count < kFewItems ? kFewBins : kBins) {
    const Vec3f extent = centers.hi - centers.lo;
    for (int a = 0; a < 3; ++a) {
      const float s = static_cast<float>(bins) / extent[a];
      scale[a] = extent[a] > 0 && std::isfinite(s) ? s : 0;
    }
  }
  int Of(Vec3f center2, int axis) const {
    return std::clamp(static_cast<int>((center2[axis] - lo[axis]) * scale[axis]), 0,
                      bins - 1);
  }
};

int LongestAxis(Vec3f extent) {
  int axis = extent.y > extent.x ? 1 : 0;
  if (extent.z > extent[axis]) axis = 2;
  return axis;
}

// Least sum of half area times blocks over the splits between bins of one axis.
template <std::size_t kCount>
void Sweep(const std::array<Bin, kCount>& bins, int axis, std::uint32_t leaf_size,
           ObjectSplit& best) {
  std::array<float, kCount> right_cost;
  WideBox box;
  std::uint32_t count = 0;
  for (std::size_t b = kCount - 1; b > 0; --b) {
    box.Extend(bins[b].box);
    count += bins[b].count;
    right_cost[b] = count == 0 ? INFINITY : box.HalfArea() * Blocks(count, leaf_size);
  }
  box = WideBox();
  count = 0;
  for (std::size_t b = 1; b < kCount; ++b) {
    box.Extend(bins[b - 1].box);
    count += bins[b - 1].count;
    if (count == 0) continue;
    const float cost = box.HalfArea() * Blocks(count, leaf_size) + right_cost[b];
    if (cost < best.cost) best = {axis, static_cast<int>(b), cost};
  }
}

template <std::size_t kCount>
float OverlapOf(const std::array<Bin, kCount>& bins, int middle) {
  WideBox left, right;
  for (int b = 0; b < static_cast<int>(kCount); ++b) {
    (b < middle ? left : right).Extend(bins[static_cast<std::size_t>(b)].box);
  }
  left.Clip(right.lo, right.hi);
  return left.IsEmpty() ? 0.0f : left.HalfArea();
}

template <int kCount, int kAxes>
using AxisBins = std::array<std::array<Bin, kCount>, kAxes>;

template <int kCount, int kAxes>
void Fill(const BuildItem* items, std::uint32_t count, const Binning& binning, int axis,
          AxisBins<kCount, kAxes>& bins) {
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3f c = items[i].Center2();
    const Float4 lo = LowOf(items[i]), hi = HighOf(items[i]);
    for (int a = 0; a < kAxes; ++a) {
      Bin& bin = bins[a][binning.Of(c, kAxes == 1 ? axis : a)];
      bin.box.Extend(lo, hi);
      ++bin.count;
    }
  }
}

// Bins with several threads. Boxes and counts do not depend on the order.
template <int kCount, int kAxes>
void FillTogether(const BuildItem* items, std::uint32_t count, const Binning& binning,
                  int axis, AxisBins<kCount, kAxes>& bins) {
  std::vector<AxisBins<kCount, kAxes>> parts((count + kPart - 1) / kPart);
  ParallelFor(parts.size(), [&](std::size_t i) {
    const std::uint32_t begin = static_cast<std::uint32_t>(i) * kPart;
    Fill<kCount, kAxes>(items + begin, std::min(count - begin, kPart), binning, axis,
                        parts[i]);
  });
  for (const auto& part : parts) {
    for (std::size_t a = 0; a < kAxes; ++a) {
      for (std::size_t b = 0; b < kCount; ++b) {
        bins[a][b].box.Extend(part[a][b].box);
        bins[a][b].count += part[a][b].count;
      }
    }
  }
}

template <int kCount, int kAxes>
ObjectSplit Find(const BuildItem* items, std::uint32_t count, const AccelBox& centers,
                 const SplitSearch& search) {
  const Binning binning(centers, count);
  const int longest = LongestAxis(centers.hi - centers.lo);
  AxisBins<kCount, kAxes> bins;
  if (count >= 2 * kPart) {
    FillTogether<kCount, kAxes>(items, count, binning, longest, bins);
  } else {
    Fill<kCount, kAxes>(items, count, binning, longest, bins);
  }
  ObjectSplit best;
  for (int a = 0; a < kAxes; ++a) {
    const int axis = kAxes == 1 ? longest : a;
    if (binning.scale[axis] > 0) Sweep(bins[a], axis, search.leaf_size, best);
  }
  if (search.overlap && best.axis >= 0) {
    best.overlap = OverlapOf(bins[kAxes == 1 ? 0 : best.axis], best.bin);
  }
  return best;
}

template <int kAxes>
ObjectSplit Find(const BuildItem* items, std::uint32_t count, const AccelBox& centers,
                 const SplitSearch& search) {
  return count < kFewItems ? Find<kFewBins, kAxes>(items, count, centers, search)
                           : Find<kBins, kAxes>(items, count, centers, search);
}

}  // namespace

ObjectSplit FindObjectSplit(const BuildItem* items, std::uint32_t count,
                            const AccelBox& centers, const SplitSearch& search) {
  return search.one_axis ? Find<1>(items, count, centers, search)
                         : Find<3>(items, count, centers, search);
}

std::uint32_t Partition(BuildItem* items, std::uint32_t count, const AccelBox& centers,
                        const ObjectSplit& split) {
  if (split.axis < 0) return count / 2;
  const Binning binning(centers, count);
  // Of rounds down, so this is Of < split.bin.
  const float lo = binning.lo[split.axis], scale = binning.scale[split.axis];
  const auto end = static_cast<float>(split.bin);
  return PartitionItems(items, count, [&](const BuildItem& item) {
    return (item.box.lo[split.axis] + item.box.hi[split.axis] - lo) * scale < end;
  });
}

}  // namespace lanelight
