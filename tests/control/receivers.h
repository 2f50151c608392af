// Batches of receivers of light, for tests of closed-form irradiance.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "tests/support/area_lights_probe.h"
#include "tests/support/test_target.h"

namespace lanelight {

struct Receivers {
  std::vector<float> p[3], n[3];
  std::vector<float> above[3], below[3], takes_part;

  void Add(Vec3d at, Vec3d normal) {
    for (int i = 0; i < 3; ++i) {
      p[i].push_back(static_cast<float>(at[i]));
      n[i].push_back(static_cast<float>(normal[i]));
    }
  }
  std::size_t size() const { return p[0].size(); }
  static Vec3d At(const std::vector<float> (&a)[3], std::size_t i) {
    return {a[0][i], a[1][i], a[2][i]};
  }

  void Probe(const CompiledScene& scene) {
    const std::size_t padded = size() + 16;
    IrradianceBatch batch;
    batch.scene = &scene;
    batch.n = static_cast<std::uint32_t>(size());
    for (int i = 0; i < 3; ++i) {
      p[i].resize(padded, 3.0f);
      n[i].resize(padded, i == 2 ? 1.0f : 0.0f);
      above[i].assign(padded, 0);
      below[i].assign(padded, 0);
      batch.p[i] = p[i].data(), batch.normal[i] = n[i].data();
      batch.above[i] = above[i].data(), batch.below[i] = below[i].data();
    }
    takes_part.assign(padded, 0);
    batch.takes_part = takes_part.data();
    ProbeAreaLights(TestTarget(), batch);
    for (int i = 0; i < 3; ++i) {
      p[i].resize(batch.n);
      n[i].resize(batch.n);
    }
  }
};

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double U(double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(engine_);
  }
  Vec3d Direction() {
    std::normal_distribution<double> g;
    return Normalize(Vec3d{g(engine_), g(engine_), g(engine_)});
  }
  // Normals that face, graze and are cut by a light of this size in this direction.
  Vec3d Normal(Vec3d toward, double size_over_distance) {
    switch (std::uniform_int_distribution<int>(0, 2)(engine_)) {
      case 0:
        return Direction();
      case 1: {  // the horizon cuts the light or comes close to it
        const Vec3d across = Normalize(Cross(toward, Direction()));
        return Normalize(across + U(-1.2, 1.2) * size_over_distance * toward);
      }
      default:
        return Normalize(toward + 0.3 * Direction());
    }
  }

 private:
  std::mt19937 engine_;
};

}  // namespace lanelight
