// EffectiveCoatBase as tables, for colours that are known when a path is shaded.
#pragma once

#include <vector>

#include "src/base/image/spectrum_integral.h"

namespace lanelight {

/// Makes tables of kCoatFitNodes nodes per channel: EffectiveCoatBase(rgb) - rgb, three
/// floats for each node of a grid over [0, 1]^3, red fastest. Interpolated between the
/// four corners of a tetrahedron around the diagonal (kernels/texture/coated_base-inl.h),
/// it leaves greys as they are; off the nodes it is 0.005 off in the mean square, at most
/// 0.06, where the correction itself is 0.023 and 0.14. The spectra of the nodes are
/// found once, with the first table.
class CoatFits {
 public:
  /// For a coat of that internal reflectance, with `bounces` off the base; both in range
  /// for EffectiveCoatBase (src/scene/compile/coat_color.h).
  std::vector<float> Table(double internal, int bounces);

 private:
  std::vector<Spectrum> bases_;
};

}  // namespace lanelight
