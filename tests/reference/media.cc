#include "tests/reference/media.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/reference/frame.h"

namespace lanelight::reference {

namespace {

// One number of the grid; zero outside.
double Voxel(const Medium& m, int x, int y, int z, int channels, int channel) {
  const int index[3] = {x, y, z};
  for (int a = 0; a < 3; ++a) {
    if (index[a] < 0 || index[a] >= m.grid_size[a]) return 0;
  }
  const int voxel = (z * m.grid_size[1] + y) * m.grid_size[0] + x;
  return m.grid[static_cast<std::size_t>(voxel * channels + channel)];
}

double Interpolated(const Medium& m, Vec3d at, int channels, int channel) {
  const double x = at.x - 0.5, y = at.y - 0.5, z = at.z - 0.5;
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  const int k = static_cast<int>(std::floor(z));
  double sum = 0;
  for (int dz = 0; dz < 2; ++dz) {
    for (int dy = 0; dy < 2; ++dy) {
      for (int dx = 0; dx < 2; ++dx) {
        const double share = (1 - std::abs(x - i - dx)) * (1 - std::abs(y - j - dy)) *
                             (1 - std::abs(z - k - dz));
        sum += share * Voxel(m, i + dx, j + dy, k + dz, channels, channel);
      }
    }
  }
  return sum;
}

double LargestExtinction(const Medium& m, int channel) {
  if (m.kind == MediumKind::kHomogeneous) return Channel(m.sigma_a + m.sigma_s, channel);
  double largest = 0;
  if (m.kind == MediumKind::kUniformGrid) {
    for (const float v : m.grid) largest = std::max<double>(largest, v);
    return largest * Channel(m.sigma_a + m.sigma_s, channel);
  }
  for (std::size_t v = 0; v < m.grid.size(); v += 6) {
    const auto c = static_cast<std::size_t>(channel);
    largest = std::max(largest, double{m.grid[v + c]} + m.grid[v + 3 + c]);
  }
  return largest;
}

}  // namespace

Coefficients MediumAt(const Medium& m, Vec3d p) {
  if (m.kind == MediumKind::kHomogeneous) return {m.sigma_a, m.sigma_s};
  const Vec3d local = m.world_from_medium.Inverse().Point(p) - m.box_min;
  const Vec3d size = m.box_max - m.box_min;
  const Vec3d share = {local.x / size.x, local.y / size.y, local.z / size.z};
  const Vec3d at = {share.x * m.grid_size[0], share.y * m.grid_size[1],
                    share.z * m.grid_size[2]};
  if (share.x < 0 || share.x > 1 || share.y < 0 || share.y > 1 || share.z < 0 ||
      share.z > 1) {
    return {};
  }
  if (m.kind == MediumKind::kUniformGrid) {
    const double density = Interpolated(m, at, 1, 0);
    return {m.sigma_a * density, m.sigma_s * density};
  }
  double v[6];
  for (int c = 0; c < 6; ++c) v[c] = Interpolated(m, at, 6, c);
  return {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
}

Collision NextCollision(const SceneDescription& scene, Index medium, const Ray& ray,
                        double t_max, int channel, Random& random) {
  Collision collision;
  if (medium == kNone) return collision;
  const Medium& m = scene.media.at(static_cast<std::size_t>(medium));
  const double largest = LargestExtinction(m, channel);
  if (largest <= 0) return collision;
  for (double t = 0;;) {
    t -= std::log(random.Uniform()) / largest;
    if (t >= std::min(t_max, 1e4)) return collision;
    const Coefficients at = MediumAt(m, ray.o + ray.d * t);
    const double sigma_t = Channel(at.sigma_a + at.sigma_s, channel);
    if (random.Uniform() * largest < sigma_t) return {t, at};
  }
}

Rgb MediumTransmittance(const SceneDescription& scene, Index medium, const Ray& ray,
                        double length, Random& random) {
  if (medium == kNone) return {1, 1, 1};
  const Medium& m = scene.media.at(static_cast<std::size_t>(medium));
  if (m.kind == MediumKind::kHomogeneous) {
    const auto of = [&](double s) { return s > 0 ? std::exp(-s * length) : 1.0; };
    const Rgb sigma = m.sigma_a + m.sigma_s;
    return {of(sigma.x), of(sigma.y), of(sigma.z)};
  }
  const auto passes = [&](int channel) {
    return NextCollision(scene, medium, ray, length, channel, random).t == kInfinity;
  };
  return {passes(0) ? 1.0 : 0.0, passes(1) ? 1.0 : 0.0, passes(2) ? 1.0 : 0.0};
}

double PhaseFunction(double g, double cosine) {
  const double base = 1 + g * g - 2 * g * cosine;
  return (1 - g * g) / (4 * std::numbers::pi * base * std::sqrt(base));
}

Vec3d SamplePhaseFunction(double g, Vec3d forward, Random& random) {
  const double u = random.Uniform(), phi = 2 * std::numbers::pi * random.Uniform();
  double cosine = 1 - 2 * u;
  if (std::abs(g) > 1e-3) {
    const double s = (1 - g * g) / (1 - g + 2 * g * u);
    cosine = (1 + g * g - s * s) / (2 * g);
  }
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  const Frame frame = MakeFrame(forward, {0, 0, 0});
  return Normalize(frame.ToWorld({sine * std::cos(phi), sine * std::sin(phi), cosine}));
}

Index MediumBehind(const Primitive& primitive, Vec3d normal, Vec3d d, Index here) {
  if (!primitive.media.IsTransition()) return here;
  return Dot(normal, d) > 0 ? primitive.media.outside : primitive.media.inside;
}

}  // namespace lanelight::reference
