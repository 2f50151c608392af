#include "src/scene/accel/splits.h"

#include <algorithm>
#include <array>

#include "src/scene/accel/shape_items.h"
#include "src/scene/accel/triangle_cut.h"

namespace lanelight {
namespace {

constexpr int kSlabs = 16;

struct Slab {
  WideBox box;
  std::uint32_t enter = 0, exit = 0;  // items that begin and end here
};

// Slabs of equal width between the ends of a box along one axis.
class Slabs {
 public:
  Slabs(const AccelBox& box, int axis) : axis_(axis), lo_(box.lo[axis]) {
    width_ = (box.hi[axis] - lo_) / kSlabs;
    scale_ = 1 / width_;
    ok_ = width_ > 0 && std::isfinite(width_) && std::isfinite(scale_);
  }
  int axis() const { return axis_; }
  bool ok() const { return ok_; }
  int Of(float x) const {
    return std::clamp(static_cast<int>((x - lo_) * scale_), 0, kSlabs - 1);
  }
  float Plane(int i) const { return lo_ + static_cast<float>(i) * width_; }

  void Add(const BuildItem& item, const TriangleRecord* triangles,
           std::array<Slab, kSlabs>& bins) const {
    const int first = Of(item.box.lo[axis_]), last = Of(item.box.hi[axis_]);
    ++bins[first].enter;
    ++bins[last].exit;
    const Float4 lo = LowOf(item), hi = HighOf(item);
    if (first == last) {
      bins[first].box.Extend(lo, hi);
      return;
    }
    const SortedTriangle triangle(triangles[item.id], axis_);
    const Float4 middle = triangle.corner(1);
    float from = item.box.lo[axis_];
    WideBox begin = triangle.Section(from);
    for (int b = first; b <= last; ++b) {
      const float to = b == last ? item.box.hi[axis_] : Plane(b + 1);
      const WideBox end = triangle.Section(to);
      WideBox part = begin;
      part.Extend(end);
      if (from <= middle[axis_] && middle[axis_] <= to) part.Extend(middle);
      part.Clip(lo, hi);
      if (!part.IsEmpty()) bins[b].box.Extend(part);
      from = to;
      begin = end;
    }
  }

 private:
  int axis_;
  float lo_, width_, scale_;
  bool ok_;
};

void SweepSlabs(const std::array<Slab, kSlabs>& bins, const Slabs& slabs,
                std::uint32_t leaf_size, std::uint32_t maximum, SpatialSplit& best) {
  std::array<WideBox, kSlabs> right;
  std::array<std::uint32_t, kSlabs> right_count;
  WideBox box;
  std::uint32_t count = 0;
  for (int b = kSlabs - 1; b > 0; --b) {
    box.Extend(bins[b].box);
    count += bins[b].exit;
    right[b] = box;
    right_count[b] = count;
  }
  box = WideBox();
  count = 0;
  for (int b = 1; b < kSlabs; ++b) {
    box.Extend(bins[b - 1].box);
    count += bins[b - 1].enter;
    if (count == 0 || right_count[b] == 0 || count + right_count[b] > maximum) continue;
    const float cost = box.HalfArea() * Blocks(count, leaf_size) +
                       right[b].HalfArea() * Blocks(right_count[b], leaf_size);
    if (cost < best.cost) {
      best = {
          slabs.axis(), slabs.Plane(b), cost, {box, right[b]}, {count, right_count[b]}};
    }
  }
}

// Cuts an item with CutTriangle and grows both parts as the whole was grown.
CutBoxes CutItem(const BuildItem& item, const SpatialSplit& split,
                 const TriangleRecord& triangle) {
  CutBoxes cut = CutTriangle(triangle, item.box, split.axis, split.x);
  AccelBox whole;
  for (const auto& p : triangle.p) whole.Extend(Vec3f{p[0], p[1], p[2]});
  const float reach = Reach(whole);
  for (AccelBox* part : {&cut.left, &cut.right}) {
    if (IsEmpty(*part)) continue;
    const AccelBox grown = Grown(*part, reach);
    *part = {Max(grown.lo, item.box.lo), Min(grown.hi, item.box.hi)};
  }
  return cut;
}

// Returns the half area of a box extended by an item.
float AreaWith(WideBox box, const BuildItem& item) {
  box.Extend(LowOf(item), HighOf(item));
  return box.HalfArea();
}

// The two sides of a plane while items are assigned to them.
class Sides {
 public:
  explicit Sides(const SpatialSplit& split) {
    for (int s = 0; s < 2; ++s) {
      box_[s] = split.box[s];
      count_[s] = static_cast<float>(split.count[s]);
    }
  }

  // Chooses the side of an item that overlaps both: 2 = split it (reference unsplitting:
  // Stich, Friedrich and Dietrich 2009, section 4.4).
  int Choose(const BuildItem& item, bool room) const {
    const float area[2] = {box_[0].HalfArea(), box_[1].HalfArea()};
    float best = room ? area[0] * count_[0] + area[1] * count_[1] : INFINITY;
    int choice = 2;
    for (int s = 0; s < 2; ++s) {
      const float cost =
          AreaWith(box_[s], item) * count_[s] + area[1 - s] * (count_[1 - s] - 1);
      if (cost < best || (choice == 2 && !room)) best = cost, choice = s;
    }
    return choice;
  }
  void Keep(const BuildItem& item, int side) {
    box_[side].Extend(LowOf(item), HighOf(item));
    count_[1 - side] -= 1;
  }

 private:
  WideBox box_[2];
  float count_[2];
};

}  // namespace

SpatialSplit FindSpatialSplit(const BuildItem* items, ItemRange range,
                              const AccelBox& box, const TriangleRecord* triangles,
                              std::uint32_t leaf_size) {
  SpatialSplit best;
  const std::uint32_t maximum = range.count() + range.room();
  for (int axis = 0; axis < 3; ++axis) {
    const Slabs slabs(box, axis);
    if (!slabs.ok()) continue;
    std::array<Slab, kSlabs> bins;
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      slabs.Add(items[i], triangles, bins);
    }
    SweepSlabs(bins, slabs, leaf_size, maximum, best);
  }
  return best;
}

std::uint32_t CutAndPartition(BuildItem* items, ItemRange& range,
                              const SpatialSplit& split,
                              const TriangleRecord* triangles) {
  Sides sides(split);
  std::uint32_t left = range.begin, right = range.end;
  while (left < right) {
    BuildItem& item = items[left];
    const auto to_right = [&] { std::swap(item, items[--right]); };
    if (item.box.hi[split.axis] <= split.x) {
      ++left;
    } else if (item.box.lo[split.axis] >= split.x) {
      to_right();
    } else {
      int side = sides.Choose(item, range.room() > 0);
      CutBoxes cut;
      if (side == 2) {
        cut = CutItem(item, split, triangles[item.id]);
        if (IsEmpty(cut.left)) side = 1;
        if (IsEmpty(cut.right)) side = 0;
      }
      if (side == 2) {
        items[range.end++] = {cut.right, item.id};
        item.box = cut.left;
      } else {
        sides.Keep(item, side);
      }
      side == 1 ? to_right() : void(++left);
    }
  }
  return left;
}

}  // namespace lanelight
