#include "tests/reference/media.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/base/core/sparse_grid.h"
#include "src/base/image/spectrum.h"
#include "tests/reference/frame.h"
#include "tests/reference/pattern.h"

namespace lanelight::reference {

namespace {

// One number of samples at the voxels; zero outside.
double Voxel(const int size[3], const std::vector<float>& values, Vec3d i, int channels,
             int channel) {
  for (int a = 0; a < 3; ++a) {
    if (i[a] < 0 || i[a] >= size[a]) return 0;
  }
  const double voxel = (i.z * size[1] + i.y) * size[0] + i.x;
  return values[static_cast<std::size_t>(voxel * channels + channel)];
}

// The mean of the eight lattice points around `at`, weighted linearly.
template <typename Value>
double Blend(Vec3d at, const Value& value) {
  const Vec3d low = {std::floor(at.x), std::floor(at.y), std::floor(at.z)};
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3d i =
        low + Vec3d{double(corner & 1), double(corner >> 1 & 1), double(corner >> 2)};
    sum += (1 - std::abs(at.x - i.x)) * (1 - std::abs(at.y - i.y)) *
           (1 - std::abs(at.z - i.z)) * value(i);
  }
  return sum;
}

// `fraction` of the box. A single number is a grid of one voxel.
double Interpolated(const Medium& m, const std::vector<float>& values, Vec3d fraction,
                    int channels, int channel) {
  constexpr int kSingle[3] = {1, 1, 1};
  const int* const size = values.size() == 1 ? kSingle : m.grid_size;
  const Vec3d at = {fraction.x * size[0] - 0.5, fraction.y * size[1] - 0.5,
                    fraction.z * size[2] - 0.5};
  return Blend(at, [&](Vec3d i) { return Voxel(size, values, i, channels, channel); });
}

// Returns the position of a point of the medium's space in its box.
Vec3d FractionOfBox(const Medium& m, Vec3d p) {
  const Vec3d local = p - m.box_min, size = m.box_max - m.box_min;
  return {local.x / size.x, local.y / size.y, local.z / size.z};
}

// At a point of the medium's space.
double SparseAt(const SparseGrid& grid, Vec3d p) {
  return Blend(grid.index_from_world().Point(p),
               [&](Vec3d i) { return double{grid.Value(int(i.x), int(i.y), int(i.z))}; });
}

double CloudAt(const Medium& m, Vec3d p) {
  Vec3d moved = m.frequency * p;
  for (int octave = 0; octave < 2; ++octave) {
    const Vec3d q = 10 * std::pow(1.99, octave) * moved;
    const double here = Noise(q), step = 0.01;
    const Vec3d slope = {Noise(q + Vec3d{step, 0, 0}) - here,
                         Noise(q + Vec3d{0, step, 0}) - here,
                         Noise(q + Vec3d{0, 0, step}) - here};
    moved += slope * (0.05 * m.wispiness / std::pow(2, octave) / step);
  }
  const double lumps = (1 - p.y) * 4.5 * m.density * Fbm(moved, 5, 0.5) / 2;
  const double solid = p.y < 0.5 ? 1 - 2 * p.y : 0;
  return std::min(1.0, std::clamp(lumps, 0.0, 1.0) + solid);
}

// At a point of the world, inside the box.
Rgb EmissionAt(const Medium& m, Vec3d world) {
  Rgb emission = m.emission;
  if (m.kind == MediumKind::kHomogeneous || emission == Rgb{}) return emission;
  const Vec3d p = m.world_from_medium.Inverse().Point(world),
              fraction = FractionOfBox(m, p);
  const auto read = [&](const std::vector<float>& values, int channels, int channel) {
    return Interpolated(m, values, fraction, channels, channel);
  };
  if (!m.emission_grid.empty()) {
    const auto& e = m.emission_grid;
    emission = m.kind == MediumKind::kRgbGrid
                   ? emission * Rgb{read(e, 3, 0), read(e, 3, 1), read(e, 3, 2)}
                   : emission * read(e, 1, 0);
  }
  if (m.temperature.empty() && m.sparse_temperature == nullptr) return emission;
  const double t = m.temperature.empty() ? SparseAt(*m.sparse_temperature, p)
                                         : read(m.temperature, 1, 0);
  const double kelvin = (t - m.temperature_offset) * m.temperature_scale;
  return kelvin > 100 ? emission * RgbOfBlackbody(kelvin) : Rgb{};
}

double LargestDensity(const Medium& m) {
  if (m.kind == MediumKind::kNanoVdb) return m.sparse_density->largest();
  if (m.kind == MediumKind::kCloud) return 1;
  return *std::max_element(m.grid.begin(), m.grid.end());
}

double LargestExtinction(const Medium& m, int channel) {
  if (m.kind == MediumKind::kHomogeneous) return Channel(m.sigma_a + m.sigma_s, channel);
  if (m.kind != MediumKind::kRgbGrid) {
    return LargestDensity(m) * Channel(m.sigma_a + m.sigma_s, channel);
  }
  double largest = 0;
  for (std::size_t v = 0; v < m.grid.size(); v += 6) {
    const auto c = static_cast<std::size_t>(channel);
    largest = std::max(largest, double{m.grid[v + c]} + m.grid[v + 3 + c]);
  }
  return largest;
}

}  // namespace

Coefficients MediumAt(const Medium& m, Vec3d p) {
  if (m.kind == MediumKind::kHomogeneous) return {m.sigma_a, m.sigma_s, {}};
  const Vec3d own = m.world_from_medium.Inverse().Point(p),
              fraction = FractionOfBox(m, own);
  if (fraction.x < 0 || fraction.x > 1 || fraction.y < 0 || fraction.y > 1 ||
      fraction.z < 0 || fraction.z > 1) {
    return {};
  }
  if (m.kind == MediumKind::kRgbGrid) {
    double v[6];
    for (int c = 0; c < 6; ++c) v[c] = Interpolated(m, m.grid, fraction, 6, c);
    return {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, {}};
  }
  const double density = m.kind == MediumKind::kCloud ? CloudAt(m, own)
                         : m.kind == MediumKind::kNanoVdb
                             ? SparseAt(*m.sparse_density, own)
                             : Interpolated(m, m.grid, fraction, 1, 0);
  return {m.sigma_a * density, m.sigma_s * density, {}};
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
    Coefficients at = MediumAt(m, ray.o + ray.d * t);
    const double sigma_t = Channel(at.sigma_a + at.sigma_s, channel);
    if (random.Uniform() * largest >= sigma_t) continue;
    at.emission = EmissionAt(m, ray.o + ray.d * t);
    return {t, at};
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
  const TangentFrame frame = MakeFrame(forward, {0, 0, 0});
  return Normalize(frame.ToWorld({sine * std::cos(phi), sine * std::sin(phi), cosine}));
}

Index MediumBehind(const Primitive& primitive, Vec3d normal, Vec3d d, Index here) {
  if (!primitive.media.IsTransition()) return here;
  return Dot(normal, d) > 0 ? primitive.media.outside : primitive.media.inside;
}

}  // namespace lanelight::reference
