#include "src/base/image/color_spaces.h"

#include <algorithm>

#include "src/base/core/error.h"
#include "src/base/image/spectrum.h"

namespace lanelight {
namespace {

constexpr ColorSpace kSpaces[] = {
    {"srgb", {0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, kD65White},
    {"dci-p3", {0.68, 0.32}, {0.265, 0.69}, {0.15, 0.06}, kD65White},
    {"rec2020", {0.708, 0.292}, {0.17, 0.797}, {0.131, 0.046}, kD65White},
    {"aces2065-1", {0.7347, 0.2653}, {0, 1}, {0.0001, -0.077}, {0.32168, 0.33767}}};

ColorMatrix Product(const ColorMatrix& a, const ColorMatrix& b) {
  ColorMatrix out;
  for (int r = 0; r < 3; ++r) {
    out.row[r] = b.row[0] * a.row[r].x + b.row[1] * a.row[r].y + b.row[2] * a.row[r].z;
  }
  return out;
}

Chromaticity ChromaticityOf(Vec3d xyz) {
  const double sum = xyz.x + xyz.y + xyz.z;
  return {xyz.x / sum, xyz.y / sum};
}

}  // namespace

const ColorSpace& FindColorSpace(const std::string& name) {
  for (const ColorSpace& space : kSpaces) {
    if (name == space.name) return space;
  }
  throw InputError("unknown color space \"" + name +
                   "\"; supported: srgb, dci-p3, rec2020, aces2065-1");
}

ColorMatrix XyzFrom(const ColorSpace& space) {
  return XyzFromPrimaries(space.red, space.green, space.blue, space.white);
}

ColorMatrix SrgbFrom(const ColorSpace& space) {
  return Product(Inverse(XyzFromSrgb()), XyzFrom(space));
}

Chromaticity WhiteOfTemperature(double kelvin) {
  // Planck's second constant was 1.4380 when daylight was defined.
  const double t = kelvin * 1.4388 / 1.4380;
  if (t < 4000) return ChromaticityOf(XyzFromSrgb() * RgbFromBlackbody(kelvin));
  const double u = 1000 / t;
  const double x = t <= 7000 ? ((-4.6070 * u + 2.9678) * u + 0.09911) * u + 0.244063
                             : ((-2.0064 * u + 1.9018) * u + 0.24748) * u + 0.237040;
  return {x, (-3 * x + 2.870) * x - 0.275};
}

ColorMatrix Bradford(Chromaticity from, Chromaticity to) {
  constexpr ColorMatrix kCones = {
      {{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};
  const Vec3d a = kCones * from.Xyz(), b = kCones * to.Xyz();
  ColorMatrix scaled = kCones;
  scaled.row[0] = scaled.row[0] * (b.x / a.x);
  scaled.row[1] = scaled.row[1] * (b.y / a.y);
  scaled.row[2] = scaled.row[2] * (b.z / a.z);
  return Product(Inverse(kCones), scaled);
}

ColorMatrix FilmMatrix(const ColorSpace& space, double white_kelvin) {
  const bool is_srgb = space.name == std::string("srgb");
  if (is_srgb && white_kelvin <= 0) return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  ColorMatrix xyz = XyzFromSrgb();
  if (white_kelvin > 0) {
    xyz = Product(Bradford(WhiteOfTemperature(white_kelvin), space.white), xyz);
  }
  return Product(Inverse(XyzFrom(space)), xyz);
}

bool FilmResponse::IsIdentity() const {
  return !limits() && matrix.row[0] == Vec3d{1, 0, 0} &&
         matrix.row[1] == Vec3d{0, 1, 0} && matrix.row[2] == Vec3d{0, 0, 1};
}

void LimitColors(const FilmResponse& response, const ColorPlanes& planes,
                 std::size_t count) {
  static const ColorMatrix kXyzFromSrgb = XyzFromSrgb();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d xyz = kXyzFromSrgb * Vec3d{planes.r[i], planes.g[i], planes.b[i]};
    const double largest = std::max({xyz.x, xyz.y, xyz.z});
    if (!(largest > response.max_component)) continue;
    const double factor = response.max_component / largest;
    for (float* plane : {planes.r, planes.g, planes.b}) {
      plane[i] = static_cast<float>(factor * double(plane[i]));
    }
  }
}

void ConvertColors(const FilmResponse& response, const ColorPlanes& planes,
                   std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d c = response.matrix * Vec3d{planes.r[i], planes.g[i], planes.b[i]};
    planes.r[i] = static_cast<float>(c.x);
    planes.g[i] = static_cast<float>(c.y);
    planes.b[i] = static_cast<float>(c.z);
  }
}

}  // namespace lanelight
