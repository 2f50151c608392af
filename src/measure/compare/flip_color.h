// Colours as FLIP sees them.
#pragma once

#include "src/base/image/color_spaces.h"

namespace lanelight {

/// The opponent space in which the eye's filters work: YCxCz of the paper without its
/// scales and its offset, which filters with a sum of 1 commute with. x: luminance, 0 to
/// 1; y: red against green; z: blue against yellow.
class OpponentColors {
 public:
  OpponentColors();
  Vec3d FromRgb(Vec3d rgb) const;
  Vec3d ToRgb(Vec3d opponent) const;

  /// L*a*b* with chroma that grows with lightness (Hunt's effect).
  Vec3d HuntLab(Vec3d rgb) const;

 private:
  // Tristimulus values relative to those of white.
  ColorMatrix relative_, inverse_;
};

/// Distance of two such colours (Abasi, Amani Tehran and Fairchild 2020).
double HyAb(Vec3d a, Vec3d b);

}  // namespace lanelight
