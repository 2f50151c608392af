// Procedural textures and mappings of every target against the scalar twin.
#include "kernels/simd/each_target-inl.h"

#include "kernels/texture/texture-inl.h"

LANELIGHT_BEGIN_KERNELS

// Texture `id` at a multiple of 16 points: planes u, v, p, n in, planes of rgb out.
void EvalPlaces(const TextureTable& table, int32_t id, const float* in, float* rgb,
                std::size_t count) {
  const DF df;
  const auto load = [&](int plane, std::size_t i)
                        HWY_ATTR { return hn::LoadU(df, in + plane * count + i); };
  for (std::size_t i = 0; i < count; i += hn::Lanes(df)) {
    const PlacedPoint at = {load(0, i),
                            load(1, i),
                            {load(2, i), load(3, i), load(4, i)},
                            {load(5, i), load(6, i), load(7, i)}};
    const V3 color = EvalTextures(table, hn::Set(DI(), id), at, Splat3(-1, -1, -1));
    hn::StoreU(color.x, df, rgb + i);
    hn::StoreU(color.y, df, rgb + count + i);
    hn::StoreU(color.z, df, rgb + 2 * count + i);
  }
}

LANELIGHT_END_KERNELS

#if HWY_ONCE

#include <catch2/catch.hpp>
#include <limits>
#include <random>

#include "src/scene/compile/coat.h"
#include "src/scene/compile/texture_programs.h"
#include "tests/kernels/texture/texture_files.h"
#include "tests/reference/texture.h"
#include "tests/support/each_target.h"

namespace lanelight {

HWY_EXPORT(EvalPlaces);

namespace {

constexpr std::size_t kPoints = 1024;

// Points in a box about the origin of the scene; normals on the sphere.
std::vector<float> RandomPoints(std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uv(-3, 3), place(-5, 5);
  std::normal_distribution<double> normal;
  std::vector<float> points(8 * kPoints);
  for (std::size_t i = 0; i < kPoints; ++i) {
    for (int k = 0; k < 5; ++k)
      points[k * kPoints + i] = k < 2 ? uv(random) : place(random);
    const Vec3d n = Normalize(Vec3d{normal(random), normal(random), normal(random)});
    for (int k = 0; k < 3; ++k) points[(5 + k) * kPoints + i] = static_cast<float>(n[k]);
  }
  return points;
}

const Vec3d kCenter = {3, -2, 1};
constexpr double kScale = 0.5;

// The point in the world: scenes are moved and scaled (p_scene = (p - center) * scale).
reference::TexturePoint PointOf(const std::vector<float>& points, std::size_t i) {
  const auto at = [&](int k) { return double(points[k * kPoints + i]); };
  const Vec3d p = {at(2), at(3), at(4)};
  return {at(0), at(1), p / kScale + kCenter, {at(5), at(6), at(7)}};
}

// Values that the twin has at a point and next to it: rounding may decide on which side
// of an edge of a step the kernel looks.
std::vector<Rgb> TwinValues(const reference::Textures& twin, Index id,
                            const reference::TexturePoint& at) {
  std::vector<Rgb> values = {twin.Eval(id, at)};
  for (int k = 0; k < 10; ++k) {
    const double step = k % 2 == 0 ? 2e-5 : -2e-5;
    reference::TexturePoint near = at;
    if (k < 2) near.u += step;
    if (k / 2 == 1) near.v += step;
    if (k >= 4) near.p[k / 2 - 2] += step;
    values.push_back(twin.Eval(id, near));
  }
  return values;
}

double Distance(Rgb a, Rgb b) {
  return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
}

void ComparePlaces(const std::vector<Texture>& textures, double margin) {
  const TextureTable table =
      CompileTextures(textures, Transform::Translate(kCenter) *
                                    Transform::Scale(Vec3d{1, 1, 1} / kScale));
  const reference::Textures twin(textures);
  const std::vector<float> points = RandomPoints(7);
  std::vector<float> rgb(3 * kPoints);
  for (const std::string& target : AvailableTargets()) {
    ForceTarget(target);
    for (std::size_t id = 0; id < textures.size(); ++id) {
      LANELIGHT_ON(TestTarget(), EvalPlaces)
      (table, static_cast<int>(id), points.data(), rgb.data(), kPoints);
      double worst = 0;
      for (std::size_t i = 0; i < kPoints; ++i) {
        const Rgb got = {rgb[i], rgb[kPoints + i], rgb[2 * kPoints + i]};
        double nearest = std::numeric_limits<double>::infinity();
        for (const Rgb& value : TwinValues(twin, id, PointOf(points, i))) {
          nearest = std::min(nearest, Distance(got, value));
        }
        worst = std::max(worst, nearest);
      }
      INFO(target << ": " << textures[id].name);
      CHECK(worst < margin);
    }
  }
  ForceTarget("");
}

Texture Named(const std::string& name, TextureKind kind) {
  Texture t;
  t.name = name;
  t.kind = kind;
  t.tex1.constant = {0.9, 0.2, 0.4};
  t.tex2.constant = {0.1, 0.5, 0.3};
  t.texture_from_world = Transform::Rotate(33, {1, 2, -1}) *
                         Transform::Scale({0.7, 1.1, 0.9}) *
                         Transform::Translate({0.3, 0.2, -0.4});
  return t;
}

}  // namespace

TEST_CASE("procedural textures agree with the reference", "[texture]") {
  std::vector<Texture> textures = {
      Named("fbm", TextureKind::kFbm),       Named("wrinkled", TextureKind::kWrinkled),
      Named("windy", TextureKind::kWindy),   Named("marble", TextureKind::kMarble),
      Named("rough fbm", TextureKind::kFbm), Named("no octaves", TextureKind::kWrinkled),
      Named("veins", TextureKind::kMarble)};
  textures[4].octaves = 5;
  textures[4].roughness = 0.9;
  textures[5].octaves = 0;
  textures[6].noise_scale = 3;
  textures[6].variation = 2;
  textures[6].octaves = 3;
  ComparePlaces(textures, 5e-4);
}

TEST_CASE("steps and mixtures by position agree with the reference", "[texture]") {
  std::vector<Texture> textures = {
      Named("dots", TextureKind::kDots), Named("bilerp", TextureKind::kBilinear),
      Named("directionmix", TextureKind::kDirectionMix),
      Named("solid checkerboard", TextureKind::kCheckerboard),
      Named("of others", TextureKind::kDirectionMix)};
  textures[0].mapping.su = 4;
  textures[0].mapping.dv = 0.3;
  for (int i = 0; i < 4; ++i)
    textures[1].corners[i].constant = {0.1 * i, 1.0 / (1 + i), 1};
  textures[2].direction = textures[4].direction = Normalize(Vec3d{1, -2, 0.5});
  textures[3].dimension = 3;
  textures[4].tex1 = {{}, 3};
  textures[4].tex2 = {{}, 1};
  ComparePlaces(textures, 5e-5);
}

TEST_CASE("every mapping agrees with the reference", "[texture]") {
  std::vector<Texture> textures;
  for (const MappingKind kind : {MappingKind::kUv, MappingKind::kSpherical,
                                 MappingKind::kCylindrical, MappingKind::kPlanar}) {
    for (const TextureKind texture :
         {TextureKind::kCheckerboard, TextureKind::kDots, TextureKind::kBilinear}) {
      Texture t = Named("mapping " + std::to_string(static_cast<int>(kind)), texture);
      for (int i = 0; i < 4; ++i) t.corners[i].constant = {0.3 * i, 1.0 / (1 + i), 0.5};
      t.mapping.kind = kind;
      t.mapping.su = 3;
      t.mapping.du = 0.25;
      t.mapping.dv = -0.5;
      t.mapping.v1 = {0.5, 1, 0};
      t.mapping.v2 = {0, 0.25, -2};
      textures.push_back(t);
    }
  }
  ComparePlaces(textures, 3e-4);
}

TEST_CASE("colours below a coat are corrected as constants are", "[texture][coat]") {
  // bilerp of random corners, as the colour below a coat; and greys, which stay.
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(0, 1);
  constexpr double kInternal = 0.57;
  constexpr int kBounces = 5, kCorners = 160;
  std::vector<Texture> textures;
  for (int i = 0; i < kCorners; ++i) {
    Texture color = Named("colour", TextureKind::kBilinear);
    const Rgb value = {uniform(random), uniform(random), uniform(random)};
    for (ColorValue& corner : color.corners) {
      corner.constant = i < kCorners / 2 ? value : Rgb{value.x, value.x, value.x};
    }
    Texture below = Named("below", TextureKind::kCoatedBase);
    below.tex1.texture = static_cast<Index>(textures.size());
    below.amount.constant = kInternal;
    below.octaves = kBounces;
    textures.push_back(color);
    textures.push_back(below);
  }
  const TextureTable table = CompileTextures(textures);
  CHECK(table.fits.size() == 3 * 9 * 9 * 9);  // one for all
  const std::vector<float> points = RandomPoints(3);
  std::vector<float> rgb(3 * kPoints);
  const EachTarget target;
  double left = 0, correction = 0, worst = 0;
  for (int i = 0; i < kCorners; ++i) {
    LANELIGHT_ON(TestTarget(), EvalPlaces)
    (table, 2 * i + 1, points.data(), rgb.data(), 16);
    const Rgb got = {rgb[0], rgb[16], rgb[32]};
    const Rgb color = textures[2 * i].corners[0].constant;
    if (i >= kCorners / 2) {
      CHECK(Distance(got, color) < 1e-5);
      continue;
    }
    const Rgb wanted = EffectiveCoatBase(color, kInternal, kBounces);
    left += Dot(got - wanted, got - wanted);
    correction += Dot(color - wanted, color - wanted);
    worst = std::max(worst, Distance(got, wanted));
  }
  INFO(left << " of " << correction);
  CHECK(left < 0.15 * correction);
  CHECK(worst < 0.06);
}

TEST_CASE("the table of colours below a coat is interpolated linearly",
          "[texture][coat]") {
  // A correction that is linear in the colour comes out exactly, in every tetrahedron.
  Texture color = Named("colour", TextureKind::kBilinear);
  color.corners[1].constant = {0.9, 0.3, 0.1};
  color.corners[2].constant = {0.2, 0.8, 0.6};
  color.corners[3].constant = {0.4, 0.1, 1};
  Texture below = Named("below", TextureKind::kCoatedBase);
  below.tex1.texture = 0;
  below.amount.constant = 0.5;
  below.octaves = 1;
  const std::vector<Texture> textures = {color, below};
  TextureTable table = CompileTextures(textures);
  const auto change = [](Rgb c) {
    return Rgb{0.2 - 0.1 * c.x + 0.05 * c.y, 0.1 + 0.1 * c.z,
               0.1 + 0.2 * c.x - 0.1 * c.z};
  };
  for (std::size_t i = 0; i < table.fits.size() / 3; ++i) {
    const Rgb node = {(i % 9) / 8.0, (i / 9 % 9) / 8.0, (i / 81) / 8.0};
    for (int c = 0; c < 3; ++c) {
      table.fits[3 * i + c] = static_cast<float>(change(node)[c]);
    }
  }
  std::vector<float> points = RandomPoints(3), rgb(3 * kPoints);
  for (std::size_t i = 0; i < 2 * kPoints; ++i) points[i] -= std::floor(points[i]);
  const EachTarget target;
  LANELIGHT_ON(TestTarget(), EvalPlaces)(table, 1, points.data(), rgb.data(), kPoints);
  double worst = 0;
  for (std::size_t i = 0; i < kPoints; ++i) {
    const Rgb was = reference::Textures(textures).Eval(0, PointOf(points, i));
    const Rgb got = {rgb[i], rgb[kPoints + i], rgb[2 * kPoints + i]};
    worst = std::max(worst, Distance(got, was + change(was)));
  }
  CHECK(worst < 1e-6);
}

}  // namespace lanelight

#endif  // HWY_ONCE
