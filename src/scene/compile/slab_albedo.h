// The albedo that makes the inside of a material reflect what is asked for.
#pragma once

#include <vector>

namespace lanelight {

/// Returns the fraction of light entering a half space along the normal that leaves it
/// again. The half space has a smooth dielectric boundary of relative index `eta`, an
/// `albedo` in [0, 1], and Henyey and Greenstein's phase function of asymmetry g. Method:
/// adding and doubling (van de Hulst 1980, "Multiple Light Scattering"), with separate
/// directions for light that the boundary transmits or reflects totally (Prahl, van
/// Gemert and Welch 1993). The phase function's peak counts as unscattered (delta-M,
/// Wiscombe 1977). Absolute error below 1e-3 for |g| <= 0.9.
double SlabReflectance(double albedo, double g, double eta);

/// The inverse of SlabReflectance, for all reflectances in [0, 1], as a table.
class SlabAlbedos {
 public:
  SlabAlbedos(double g, double eta);
  double Of(double reflectance) const;

 private:
  std::vector<double> reflectances_;  // of albedos, from 1 to 0
};

}  // namespace lanelight
