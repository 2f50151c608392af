// Material "subsurface": a dielectric in which paths walk at random, as one event.
#include <catch2/catch.hpp>
#include <algorithm>
#include <cmath>

#include "src/render/plan/plan.h"
#include "src/scene/compile/compile.h"
#include "tests/agreement/agreement.h"
#include "tests/kernels/media/scenes.h"
#include "tests/reference/optics.h"

namespace lanelight::test {
namespace {

/// The inside of a material with these coefficients.
Medium Inside(Rgb sigma_a, Rgb sigma_s, double eta, double g = 0) {
  Medium medium = MakeMedium(sigma_a, sigma_s, g);
  medium.in_material = true;
  medium.eta = eta;
  return medium;
}
Medium InsideThatReflects(ColorValue reflectance, Rgb mfp, double eta, double g = 0) {
  Medium medium = Inside({}, {1 / mfp.x, 1 / mfp.y, 1 / mfp.z}, eta, g);
  medium.by_reflectance = true;
  medium.reflectance = reflectance;
  return medium;
}

Index AddSubsurface(SceneBuilder& b, const Medium& inside, double alpha = 0) {
  const Index index = b.AddDielectric(inside.eta, alpha);
  b.scene().materials[static_cast<std::size_t>(index)].inside = AddMedium(b, inside);
  return index;
}

/// The shape added last has in it what its material has.
void Fill(SceneBuilder& b, Index outside = kNone) {
  const Shape& shape = b.scene().shapes.back();
  Bound(b, b.scene().materials[static_cast<std::size_t>(shape.material)].inside, outside);
}

/// A half space under an even sky of 1, seen along its normal.
SceneDescription Slab(const Medium& inside, int depth) {
  SceneBuilder b(4, 4);
  b.Depth(depth).Orthographic({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 0.5);
  b.AddPlane({0, 0, 0}, {0, 0, 1}, AddSubsurface(b, inside));
  Fill(b);
  b.AddEnvironment(Grey(1));
  return b.Build();
}

/// A rough ball of skin on a floor, in a lit corner.
SceneDescription Skin(double alpha, int size = 8) {
  SceneBuilder b(size, size);
  b.Depth(3).Perspective({0, -4, 1.2}, {0, 0, 0.5}, {0, 0, 1}, 34);
  const Index grey = b.AddDiffuse({0.5, 0.5, 0.6});
  b.AddPlane({0, 0, 0}, {0, 0, 1}, grey);
  b.AddSphere(
      {0, 0, 0.6}, 0.5,
      AddSubsurface(b, Inside({0.3, 1.7, 4.8}, {7.4, 8.8, 10.1}, 1.33, 0.2), alpha));
  Fill(b);
  b.AddSphere({1.5, -1.5, 2}, 0.6, b.AddDiffuse(Grey(0)), b.AddEmission({9, 9, 9}));
  b.AddEnvironment({0.3, 0.3, 0.3});
  return b.Build();
}

stat::ImageTestResult CompareWith(const SceneDescription& scene, double value,
                                  std::uint64_t spp) {
  const Film& film = scene.film;
  const auto known =
      stat::ExpectedImage(film.width, film.height, [&](int, int) { return Grey(value); });
  return stat::CompareMeans(RenderWavefront(scene, spp), known,
                            {film.width, 1e-6, 1e-3, 1e-7});
}

}  // namespace

// Head-on, with r of what goes in coming out again: F + (1 - F) r, whatever the depth.
// Walks are longer, and errors smaller, the more comes out.
TEST_CASE("subsurface: a slab has the specified reflectance", "[media][subsurface]") {
  int depth = 5;
  for (const double r : {0.1, 0.5, 0.8}) {
    for (const double eta : {1.33, 1.6}) {
      const double f = reference::FresnelDielectric(1, eta);
      const Medium inside =
          InsideThatReflects({Grey(r), kNone}, {0.1, 1, 3}, eta, eta > 1.5 ? 0.6 : 0);
      depth = 6 - depth;
      stat::CheckSame(
          CompareWith(Slab(inside, depth), f + (1 - f) * r, r < 0.5 ? 4096 : 2048), 0.08,
          fmt::format("r {}, eta {}, depth {}", r, eta, depth));
    }
  }
  const Medium milk = InsideThatReflects({Grey(0.8), kNone}, {0.1, 1, 3}, 1.33);
  const double f = reference::FresnelDielectric(1, 1.33);
  CHECK(CompareWith(Slab(milk, 5), f + (1 - f) * 0.8, 1024).same);
}

TEST_CASE("subsurface: an albedo error of 2 % is detected", "[media][subsurface]") {
  SceneDescription scene =
      Slab(InsideThatReflects({Grey(0.5), kNone}, {1, 1, 1}, 1.33), 5);
  const double f = reference::FresnelDielectric(1, 1.33);
  CHECK_FALSE(CompareWith(scene, f + (1 - f) * 0.485, 16384).same);
}

// The same medium as one of a scene's own counts each event, and goes dark.
TEST_CASE("subsurface: events inside a material do not count towards max depth",
          "[media][subsurface]") {
  const Medium milk = Inside({}, {3, 4, 5}, 1.33);
  SceneDescription free = Slab(milk, 5), counted = free;
  counted.media[0].in_material = false;
  CHECK(CompareWith(free, 1, 1024).same);
  const auto dark = RenderWavefront(counted, 1024);
  CHECK(dark.mean[0].y < 0.6);
}

TEST_CASE("subsurface: a white furnace", "[media][subsurface]") {
  for (const double alpha : {0.0, 0.3}) {
    SceneBuilder b(4, 4);
    b.Depth(2).Orthographic({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 0.6);
    b.AddSphere({0, 0, 0}, 1, AddSubsurface(b, Inside({}, {2, 5, 9}, 1.0, 0.3), alpha));
    Fill(b);
    b.AddEnvironment(Grey(1));
    stat::CheckSame(CompareWith(b.Build(), 1, 1024), fmt::format("alpha {}", alpha));
  }
}

TEST_CASE("subsurface: smooth and rough balls agree with the reference",
          "[media][subsurface]") {
  CheckAgreement(Skin(0), 4096, 4096, 0.15);
  CheckAgreement(Skin(0.3), 4096, 4096, 0.1);
}

TEST_CASE("subsurface: strategies agree", "[media][subsurface]") {
  const SceneDescription scene = Skin(0.3);
  const auto truth = RenderWavefront(scene, 16384);
  for (const char* strategy : {"directions=light", "directions=uniform", "roulette=none",
                               "roulette=adjoint", "distances=equiangular",
                               "light-selection=tree", "points=sobol,pairs=antithetic"}) {
    stat::CheckSame(stat::CompareMeans(RenderWavefront(scene, 4096, strategy), truth,
                                       {8, 1e-6, kFloatTolerance, 1e-7}),
                    strategy);
  }
}

// A texture that is nearly the same everywhere, against the constant; another that is
// not, against each half by itself.
TEST_CASE("subsurface: a textured reflectance", "[media][subsurface]") {
  const auto scene = [](Rgb left, Rgb right, bool textured) {
    SceneBuilder b(2, 2);
    b.Depth(3).Orthographic({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 30);
    ColorValue reflectance = {left, kNone};
    if (textured) {
      Texture board;
      board.kind = TextureKind::kCheckerboard;
      board.tex1 = {left, kNone}, board.tex2 = {right, kNone};
      board.mapping.su = board.mapping.sv = 1 / 100.0;
      b.scene().textures.push_back(board);
      reflectance.texture = 0;
    }
    b.AddPlane(
        {0, 0, 0}, {0, 0, 1},
        AddSubsurface(b, InsideThatReflects(reflectance, {0.02, 0.02, 0.02}, 1.33)));
    Fill(b);
    b.AddEnvironment(Grey(1));
    return b.Build();
  };
  const Rgb dark = {0.2, 0.4, 0.6}, light = {0.9, 0.7, 0.5};
  const double f = reference::FresnelDielectric(1, 1.33);
  for (const Transport transport : {Transport::kRgb, Transport::kSpectral}) {
    SceneDescription boards = scene(dark, light, true);
    boards.integrator.transport = transport;
    const auto textured = RenderWavefront(boards, 16384);
    for (int y = 0; y < 2; ++y) {
      for (int x = 0; x < 2; ++x) {
        const auto at = static_cast<std::size_t>(2 * y + x);
        const Rgb want = x == y ? dark : light;
        for (int c = 0; c < 3; ++c) {
          const double error = std::sqrt(textured.variance[at][c]);
          INFO("pixel " << x << ", " << y << ", channel " << c);
          CHECK(std::abs(textured.mean[at][c] - (f + (1 - f) * want[c])) <
                5 * error + 3e-3);
        }
      }
    }
  }
}

TEST_CASE("subsurface: lights that cannot enter are noted", "[media][subsurface]") {
  const auto notes = [](double alpha, bool point) {
    SceneDescription scene = Skin(alpha);
    Light light;
    light.kind = LightKind::kPoint;
    light.emission = Grey(1);
    if (point) scene.lights.push_back(light);
    return CompileScene(scene, {}).notes;
  };
  CHECK(notes(0, false).empty());
  CHECK(notes(0.3, true).empty());
  REQUIRE(notes(0, true).size() == 1);
  CHECK_THAT(notes(0, true)[0].message, Catch::Contains("do not light a smooth"));
}

TEST_CASE("subsurface: columns exist only in scenes with it", "[media][plan]") {
  const auto has = [](const SceneDescription& scene, Field field) {
    const Plan plan = MakePlan(PrepareScene(scene), {});
    return std::find(plan.live_fields.begin(), plan.live_fields.end(), field) !=
           plan.live_fields.end();
  };
  CHECK(has(Skin(0.3), Field::walked));
  CHECK_FALSE(has(Skin(0.3), Field::inside_r));
  CHECK_FALSE(has(FilledGlass(), Field::walked));
  CHECK_FALSE(has(SmallRoom(8, 3), Field::walked));
}

}  // namespace lanelight::test
