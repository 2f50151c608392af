#include "src/prepare/ambient.h"

#include <algorithm>
#include <array>

#include "src/core/pi.h"
#include "src/image/octahedral.h"

namespace lanelight {
namespace {

// The nine real spherical harmonics up to degree 2 without their norms: orthogonal.
using Harmonics = std::array<double, 9>;
Harmonics Evaluate(Vec3d d) {
  return {1,
          d.x,
          d.y,
          d.z,
          d.x * d.y,
          d.y * d.z,
          d.z * d.x,
          3 * d.z * d.z - 1,
          d.x * d.x - d.y * d.y};
}
// Integrals of their squares over the sphere.
constexpr Harmonics kSquares = {4 * kPi,      4 * kPi / 3,  4 * kPi / 3,
                                4 * kPi / 3,  4 * kPi / 15, 4 * kPi / 15,
                                4 * kPi / 15, 16 * kPi / 5, 16 * kPi / 15};

// Factor by which the integral over the hemisphere of a normal, with the cosine, scales a
// harmonic of this place in the list (Ramamoorthi and Hanrahan 2001).
constexpr double CosineFactor(int i) {
  return i == 0 ? kPi : i <= 3 ? 2 * kPi / 3 : kPi / 4;
}

Quadratic ToQuadratic(const Harmonics& c) {
  Quadratic q;
  for (std::size_t i = 0; i < 9; ++i) q.c[i] = static_cast<float>(c[i]);
  q.c[0] = static_cast<float>(c[0] - c[7]);
  q.c[7] = static_cast<float>(3 * c[7]);
  return q;
}

void Store(const std::array<Harmonics, 3>& radiance, AmbientLight& out) {
  for (std::size_t channel = 0; channel < 3; ++channel) {
    Harmonics irradiance = radiance[channel];
    for (int i = 0; i < 9; ++i)
      irradiance[static_cast<std::size_t>(i)] *= CosineFactor(i);
    out.radiance[channel] = ToQuadratic(radiance[channel]);
    out.irradiance[channel] = ToQuadratic(irradiance);
  }
}

Vec3d SceneDirection(const Environment& e, double u, double v) {
  const Vec3d w = OctahedralToDirection(u, v);
  const float* m = e.scene_from_light;
  const Vec3d scene = {m[0] * w.x + m[1] * w.y + m[2] * w.z,
                       m[3] * w.x + m[4] * w.y + m[5] * w.z,
                       m[6] * w.x + m[7] * w.y + m[8] * w.z};
  return e.stretched ? Normalize(scene) : scene;
}

// Midpoint rule over texels, which have equal solid angles. Any function would do as a
// control variate; what must be exact is the irradiance of the one that was chosen.
std::array<Harmonics, 3> Project(const Environment& e) {
  std::array<Harmonics, 3> sum = {};
  const double size = e.size, solid_angle = 4 * kPi / (size * size);
  for (int y = 0; y < e.size; ++y) {
    for (int x = 0; x < e.size; ++x) {
      const Harmonics at =
          Evaluate(SceneDirection(e, (x + 0.5) / size, (y + 0.5) / size));
      const float* rgb =
          &e.rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(e.size) +
                      static_cast<std::size_t>(x))];
      for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < 9; ++i) {
          sum[c][i] += rgb[c] * at[i] * solid_angle / kSquares[i];
        }
      }
    }
  }
  return sum;
}

}  // namespace

double Quadratic::operator()(Vec3d d) const {
  return c[0] + c[1] * d.x + c[2] * d.y + c[3] * d.z + c[4] * d.x * d.y +
         c[5] * d.y * d.z + c[6] * d.z * d.x + c[7] * d.z * d.z +
         c[8] * (d.x * d.x - d.y * d.y);
}

bool SamplesEveryDirection(const EnvironmentTable& table) {
  return !table.probability.empty() &&
         std::all_of(table.probability.begin(), table.probability.end(),
                     [](float p) { return p > 0; });
}

std::vector<AmbientLight> MakeAmbientLights(const PreparedScene& scene) {
  std::vector<AmbientLight> out;
  const bool only_light_samples = scene.strategy.directions == Directions::kLight;
  const LightTable& table = scene.compiled->lights;
  for (std::uint32_t index : table.infinite) {
    const LightRecord& record = table.lights[index];
    AmbientLight& ambient = out.emplace_back();
    ambient.light = index;
    std::array<Harmonics, 3> radiance = {};
    if (record.shape == static_cast<std::uint32_t>(LightShape::kPortal)) {
      // Another sky from every point: it takes no part.
    } else if (record.environment < 0) {
      for (std::size_t c = 0; c < 3; ++c) radiance[c][0] = record.radiance[c];
    } else {
      const auto e = static_cast<std::size_t>(record.environment);
      if (!only_light_samples || SamplesEveryDirection(*scene.chances->environments[e])) {
        radiance = Project(table.environments[e]);
      }
    }
    Store(radiance, ambient);
  }
  return out;
}

}  // namespace lanelight
