// Separable filters and colour spaces of FLIP. Filters repeat the values at the edge.
#pragma once

#include <vector>

#include "src/base/image/color_spaces.h"
#include "src/measure/compare/linear_image.h"

namespace lanelight {

/// An odd number of weights, from -radius to radius.
using Kernel = std::vector<float>;

/// Computes out(x) = sum over k of kernel[k] in(x + k - radius) along rows.
Plane ConvolveRows(const Plane& in, int width, int height, const Kernel& kernel);
/// Does the same along columns.
Plane ConvolveColumns(const Plane& in, int width, int height, const Kernel& kernel);

/// The opponent space of the contrast sensitivity filters: YCxCz of the paper without its
/// scales and its offset, which filters with a sum of 1 commute with. x: luminance, 0 to
/// 1; y: red against green; z: blue against yellow.
class OpponentColors {
 public:
  OpponentColors();
  Vec3d FromRgb(Vec3d rgb) const;
  Vec3d ToRgb(Vec3d opponent) const;

  /// Returns L*a*b* with chroma that grows with lightness (Hunt's effect).
  Vec3d HuntLab(Vec3d rgb) const;

 private:
  // Tristimulus values relative to those of white.
  ColorMatrix relative_, inverse_;
};

/// Returns the distance of two such colours (Abasi, Amani Tehran and Fairchild 2020).
double HyAb(Vec3d a, Vec3d b);

}  // namespace lanelight
