#include "src/scene/compile/environment.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <numbers>

#include "src/base/image/octahedral.h"
#include "tests/scene/compile/testing.h"

namespace lanelight {
namespace {

Image Grey(int size, float value) {
  Image image = MakeImage(size, size, {"R", "G", "B"});
  for (float& v : image.pixels) v = value;
  return image;
}

Light Infinite() {
  Light light;
  light.kind = LightKind::kInfinite;
  light.where = At(40);
  light.image_path = "sky.exr";
  return light;
}

TEST_CASE("compile: environment probabilities follow luminance", "[scene][compile]") {
  Image image = Grey(4, 1);
  image.At(2, 1, 0) = 5;   // luminance 1 + 4 * 0.212671
  image.At(0, 3, 1) = 0;   // 1 - 0.715160
  image.At(3, 3, 2) = -7;  // cut at 0: 1 - 0.072169
  Light light = Infinite();
  light.image_scale = 2;
  const Environment e = CompileEnvironment(light, image);
  CHECK(e.size == 4);
  REQUIRE(e.rgb.size() == 48);
  CHECK(e.rgb[3 * 6] == 10);
  CHECK(e.rgb[3 * 15 + 2] == 0);
  const double sum = 16 + 4 * 0.212671 - 0.715160 - 0.072169;
  REQUIRE(e.table->probability.size() == 16);
  CHECK(e.table->probability[0] == Approx(1 / sum));
  CHECK(e.table->probability[6] == Approx((1 + 4 * 0.212671) / sum));
  CHECK(e.table->probability[12] == Approx((1 - 0.715160) / sum));
  CHECK(e.table->probability[15] == Approx((1 - 0.072169) / sum));
  double total = 0;
  for (float p : e.table->probability) total += p;
  CHECK(total == Approx(1));
  CHECK(MeanRadiance(e).x == Approx(2 * (16 + 4) / 16.0));
}

TEST_CASE("compile: guides enclose every step of a distribution", "[scene][compile]") {
  // One bright texel, black rows and columns, sizes around the powers of two.
  for (int size : {1, 3, 4, 5, 17, 64}) {
    Image image = Grey(size, 0);
    for (int i = 0; i < size; i += 3) image.At(i, size / 2, 0) = float(1 + i % 7);
    image.At(size - 1, size - 1, 1) = 1e6f;
    const Environment e = CompileEnvironment(Infinite(), image);
    const int parts = 1 << e.table->guide_bits;
    REQUIRE(e.table->row_guide.size() == std::size_t(parts) + 1);
    REQUIRE(e.table->column_guide.size() == (std::size_t(parts) + 1) * size);
    for (int row = -1; row < size; ++row) {
      const float* cdf =
          row < 0 ? e.table->row_cdf.data() : &e.table->column_cdf[row * (size + 1)];
      const std::int32_t* guide =
          row < 0 ? e.table->row_guide.data() : &e.table->column_guide[row * (parts + 1)];
      for (int i = 0; i < 4096; ++i) {
        const float u = float(i) / 4096;
        int step = 0;
        while (step + 1 < size && cdf[step + 1] <= u) ++step;
        const int part = static_cast<int>(u * float(parts));
        REQUIRE(guide[part] <= step);
        REQUIRE(step <= guide[part + 1]);
      }
    }
  }
}

TEST_CASE("compile: grey and black environments", "[scene][compile]") {
  Image grey = MakeImage(2, 2, {"Y"});
  grey.At(1, 0, 0) = 3;
  const Environment e = CompileEnvironment(Infinite(), grey);
  CHECK(e.rgb[3] == 3);
  CHECK(e.rgb[5] == 3);
  CHECK(e.table->probability[1] == 1);
  CHECK(e.table->probability[0] == 0);
  CHECK(CompileEnvironment(Infinite(), Grey(2, 0)).table->probability.empty());
}

TEST_CASE("compile: environment rotation", "[scene][compile]") {
  Light light = Infinite();
  light.world_from_light = Transform::Scale({-3, 3, 3}) *
                           Transform::Rotate(37, {1, 2, 3}) *
                           Transform::Translate({5, 6, 7});
  const Environment e = CompileEnvironment(light, Grey(1, 1));
  const Vec3d local = Normalize(Vec3d{0.3, -0.5, 0.8});
  const Vec3d world = Normalize(light.world_from_light.Vector(local));
  const float* m = e.light_from_scene;
  for (int i = 0; i < 3; ++i) {
    CHECK(m[3 * i] * world.x + m[3 * i + 1] * world.y + m[3 * i + 2] * world.z ==
          Approx(local[i]).margin(1e-6));
  }
}

TEST_CASE("compile: stretched environments keep their total power", "[scene][compile]") {
  Light light = Infinite();
  light.world_from_light =
      Transform::Rotate(37, {1, 2, 3}) * Transform::Scale({-10, 20, 5});
  const Environment e = CompileEnvironment(light, Grey(1, 1));
  CHECK(e.stretched);
  const Vec3d local = Normalize(Vec3d{0.3, -0.5, 0.8});
  const auto times = [](const float* m, Vec3d v) {
    return Vec3d{m[0] * v.x + m[1] * v.y + m[2] * v.z,
                 m[3] * v.x + m[4] * v.y + m[5] * v.z,
                 m[6] * v.x + m[7] * v.y + m[8] * v.z};
  };
  const Vec3d world = times(e.scene_from_light, local);
  CHECK(Length(world - light.world_from_light.Vector(local) / 10) < 1e-6);
  CHECK(Length(times(e.light_from_scene, world) - local) < 1e-6);
}

TEST_CASE("compile: illuminance of environments as in pbrt", "[scene][compile]") {
  Light light = Infinite();
  light.illuminance = 10;
  light.image_scale = 3;
  // A uniform map of value v has pbrt illuminance pi v / 2
  // (src/scene/compile/environment.cc).
  const Environment e = CompileEnvironment(light, Grey(64, 0.25f));
  CHECK(e.rgb[0] == Approx(3 * 10 / (std::numbers::pi / 2)).epsilon(2e-3));
  Image below = Grey(64, 0);
  below.At(0, 0, 0) = 1;  // a corner: straight down
  CHECK_THROWS_WITH(CompileEnvironment(light, below), Catch::Contains("illuminance"));
}

TEST_CASE("compile: negative values of an environment are reported", "[scene][compile]") {
  Image image = Grey(2, 1);
  std::vector<Note> notes;
  CompileEnvironment(Infinite(), image, &notes);
  CHECK(notes.empty());
  image.At(1, 0, 2) = -0.5f;
  image.At(1, 1, 0) = -2;
  image.At(0, 0, 0) = -0.0f;
  const Environment e = CompileEnvironment(Infinite(), image, &notes);
  REQUIRE(notes.size() == 1);
  CHECK(notes[0].where.line == 40);
  CHECK(
      notes[0].message ==
      "2 of 12 values of the environment image are negative (the least is -2) and count "
      "as 0");
  CHECK(e.rgb[3 * 1 + 2] == 0);
  CHECK(e.rgb[3 * 3] == 0);
}

TEST_CASE("compile: a value that is not a number darkens one texel", "[scene][compile]") {
  Image image = Grey(2, 1);
  image.At(1, 0, 2) = std::nanf("");
  std::vector<Note> notes;
  const Environment e = CompileEnvironment(Infinite(), image, &notes);
  REQUIRE(notes.size() == 1);
  CHECK(notes[0].message ==
        "1 of 12 values of the environment image are not a number and count as 0");
  for (std::size_t i = 0; i < 12; ++i) CHECK(e.rgb[i] == (i == 5 ? 0 : 1));
}

TEST_CASE("compile: invalid environment images are refused", "[scene][compile]") {
  CHECK_THROWS_WITH(CompileEnvironment(Infinite(), MakeImage(4, 2, {"R", "G", "B"})),
                    Catch::Contains("scene.pbrt:40:1") && Catch::Contains("4 x 2") &&
                        Catch::Contains("makeequiarea"));
  Image image = Grey(2, 1);
  image.At(1, 0, 2) = std::numeric_limits<float>::infinity();
  CHECK_THROWS_WITH(CompileEnvironment(Infinite(), image),
                    Catch::Contains("pixel (1, 0)"));
  CHECK_THROWS_WITH(CompileEnvironment(Infinite(), MakeImage(2, 2, {"X", "Y", "Z"})),
                    Catch::Contains("its channels (X, Y, Z) are not a colour image"));
  SceneDescription d = SquareScene();
  d.lights = {Infinite()};
  d.lights[0].image_path = "/nowhere/sky.exr";
  const std::string error = CompileError(d);
  CHECK(error.find("scene.pbrt:40:1: error: ") == 0);
  CHECK(error.find("/nowhere/sky.exr") != std::string::npos);
  CHECK(error.rfind("error: ") == error.find("error: "));
}

}  // namespace
}  // namespace lanelight
