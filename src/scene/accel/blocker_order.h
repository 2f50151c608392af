// The order in which shadow rays visit the children of a wide node.
#pragma once

#include "src/scene/geometry/accel.h"

namespace lanelight {

/// What is known of a child of a wide node, by its slot. All 0 for an unused slot.
struct ChildOdds {
  float entered = 0;  // probability that a line through the node enters it
  float blocks = 0;   // that what is in it blocks a line that enters it
  float cost = 0;     // of following such a line through it
};

/// The probability that triangles of so much `area` in a box block a line that enters it.
/// A line crosses surfaces in a convex body 2 area / (surface of the body) times on
/// average (Cauchy and Crofton: Santalo 1976, chapter 14), taken to be independent.
float BlockingOdds(float area, float half_area_of_box);

/// Sets `shadow_octants` and `shadow_first` of a node. The first hit may end a shadow
/// ray, so the cost of an order is the sum over children of the cost of following rays
/// that nothing before has blocked (after Nah and Manocha 2014, "SATO: Surface Area
/// Traversal Order for Shadow Ray Tracing"). The best first slot is used if it saves
/// enough over the order along rays.
void SetBlockerOrder(const ChildOdds (&odds)[kBvhWidth], WideNode& node);

}  // namespace lanelight
