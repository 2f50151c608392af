// The albedo that makes the inside of a material reflect what is asked for.
#pragma once

#include <vector>

namespace lanelight {

/// Part of the light that went along the normal into a half space that comes out of it
/// again: a smooth dielectric boundary of relative index `eta` around a medium that
/// scatters with `albedo` in [0, 1] by Henyey and Greenstein's phase function of
/// asymmetry g. By adding and doubling (van de Hulst 1980, "Multiple Light Scattering"),
/// with directions of their own for light that the boundary lets out or reflects totally
/// (as Prahl, van Gemert and Welch 1993), and the phase function's peak taken for
/// unscattered (delta-M, Wiscombe 1977). Absolute error below 1e-3 for |g| <= 0.9.
double SlabReflectance(double albedo, double g, double eta);

/// Its inverse, for all reflectances in [0, 1]: a table, computed once.
class SlabAlbedos {
 public:
  SlabAlbedos(double g, double eta);
  double Of(double reflectance) const;

 private:
  std::vector<double> reflectances_;  // of albedos, from 1 to 0
};

}  // namespace lanelight
