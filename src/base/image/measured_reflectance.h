// Measured reflectance: files of the RGL material database.
#pragma once

#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

namespace lanelight {

/// Slices of `height` rows of `width` numbers, which a bilinear function over the unit
/// square goes through; the first number is at (0, 0).
struct MeasuredTensor {
  int width = 0, height = 0;
  std::vector<float> values;
};

/// A reflectance in the adaptive parameterisation of Dupuy and Jakob 2018 ("An Adaptive
/// Parameterization for Efficient Material Acquisition and Rendering"). Directions are
/// points of the unit square: (sqrt(2 theta / pi), (phi / pi + 1) / 2). The direction
/// that is known (`theta`, `phi`: radians, increasing) is linear between slices, which
/// are in the order [phi][theta]. Of a microfacet normal h and the direction i that is
/// known,
///   f cos = ndf(h) reflectance(s) / (4 sigma(i)),
/// where s is the point that the density `vndf` takes to h: by its rows first, then along
/// them.
struct MeasuredReflectance {
  std::string path;  // of the file
  std::vector<double> phi, theta;
  MeasuredTensor ndf, sigma;   // of normals; projected area: one slice
  MeasuredTensor vndf;         // of visible normals
  MeasuredTensor luminance;    // that is proportional to reflectance(s), nearly
  MeasuredTensor reflectance;  // linear sRGB: three slices for each of the others

  /// The azimuth counts from that of the known direction.
  bool isotropic() const { return phi.size() <= 2; }
  /// Parts of the circle that look alike: 1; 2, if half a turn changes nothing; 4, if
  /// mirroring along both axes does not. `phi` covers one.
  int parts() const;
};

/// Reads and checks a file. InputError names it by `path`.
std::shared_ptr<const MeasuredReflectance> ReadMeasuredReflectance(
    std::istream& file, const std::string& path);
/// The same; opens the file itself.
std::shared_ptr<const MeasuredReflectance> ReadMeasuredReflectance(
    const std::string& path);

/// Spectra of `reflectance`: a slice for each wavelength.
struct MeasuredSpectra {
  std::vector<double> nm;  // increasing
  MeasuredTensor reflectance;
};
/// Reads the file again: spectra are many times as large as colours, and only spectral
/// renders need them. InputError if it cannot be read, or has other directions now.
MeasuredSpectra ReadMeasuredSpectra(const MeasuredReflectance& measured);

}  // namespace lanelight
