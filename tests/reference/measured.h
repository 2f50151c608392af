// Measured reflectance in double precision, from the numbers of its file, and files of
// models to test it with.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "src/base/image/measured_reflectance.h"
#include "tests/reference/optics.h"

namespace lanelight::reference {

/// A bilinear density over the unit square.
struct Density {
  int width, height;
  std::vector<double> values;  // normalised

  double At(double x, double y) const;
  struct Point {
    double x, y;
  };
  /// The shares of the whole that lie below row y, and of what is at y left of x.
  Point Shares(double x, double y) const;
  /// The point with these shares, by bisection.
  Point Find(double x_share, double y_share) const;
};

/// f cos of a direction that is known and another one.
Rgb EvaluateMeasuredCos(const MeasuredReflectance& m, Vec3d known, Vec3d other);

/// What a file is made of: a surface with GGX normals, and f cos of it at a wavelength.
struct MeasuredModel {
  Ggx normals{0.3, 0.3};
  std::function<double(double nm, Vec3d known, Vec3d other)> f_cos;
  int phis = 1;  // 1: isotropic; else from -pi over a `parts`-th of the circle
  int parts = 1;
  int thetas = 9, size = 32, normals_size = 64;
  std::vector<float> nm = {360, 450, 550, 650, 830};
};

/// The bytes of its file.
std::string MeasuredFile(const MeasuredModel& model);

/// A field of a tensor file, of float32 or, with `bytes`, uint8.
struct TensorField {
  std::string name;
  std::vector<std::uint64_t> shape;
  std::vector<float> numbers;
  std::string bytes;
};
std::string TensorFileOf(const std::vector<TensorField>& fields);
std::vector<TensorField> MeasuredFields(const MeasuredModel& model);

/// Rough metal of a colour that goes from `blue` at 450 nm to `red` at 650 nm.
MeasuredModel MetalModel(double ax, double ay, double blue = 0.5, double red = 0.9);
/// Of scenes/measured.pbrt: varnish whose colour changes with the angle, over blue paint,
/// and brushed brass, of which a quarter of the circle is stored.
MeasuredModel VarnishModel();
MeasuredModel BrassModel();
/// Lambertian, of this reflectance.
MeasuredModel ChalkModel(double reflectance);

}  // namespace lanelight::reference
