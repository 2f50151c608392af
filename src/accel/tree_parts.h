// The one list of what an Accel consists of: its size, its file and its reading all go
// through it.
#pragma once

#include <cstddef>
#include <type_traits>

#include "src/accel/accel.h"

namespace lanelight {

/// Calls visit(member) for every member of an Accel, const or not, always in this order.
/// A member that is missing here does not compile.
template <typename A, typename Visit>
void VisitParts(A& accel, const Visit& visit) {
  static_assert(std::is_same_v<std::remove_const_t<A>, Accel>);
  auto& [quality, nodes, few, leaf_triangles, triangle_blocks, groups, top, spheres,
         disks, sphere_blocks, disk_blocks, curves, curve_blocks] = accel;
  auto& [few_vertices, few_triangles, few_reach] = few;
  visit(quality);
  visit(nodes);
  visit(few_vertices);
  visit(few_triangles);
  visit(few_reach);
  visit(leaf_triangles);
  visit(triangle_blocks);
  visit(groups);
  visit(top);
  visit(spheres);
  visit(disks);
  visit(sphere_blocks);
  visit(disk_blocks);
  visit(curves);
  visit(curve_blocks);
}

/// A member as its elements in memory: those of an array, or the one value.
struct TreePart {
  const void* data;
  std::size_t count, element;  // elements, bytes of one
  std::size_t bytes() const { return count * element; }
};

template <typename T>
TreePart PartOf(const T& value) {
  if constexpr (requires { value.data(); }) {
    using Element = std::remove_cvref_t<decltype(*value.data())>;
    static_assert(std::is_trivially_copyable_v<Element>);
    return {value.data(), value.size(), sizeof(Element)};
  } else {
    static_assert(std::is_trivially_copyable_v<T>);
    return {&value, 1, sizeof(T)};
  }
}

}  // namespace lanelight
