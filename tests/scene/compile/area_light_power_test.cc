// "power" of area lights, held against what pbrt-v4 makes of it.
//
// DiffuseAreaLight::Create, once for each of its shapes: scale / photometric(L), and with
// a power phi scale *= phi / k_e, k_e = pi * area * sides, times the mean luminance of an
// image. `rgb L` is a factor on the illuminant, which alone photometric() measures, so a
// shape emits phi * scale * luminance(L); a spectrum or a black body has luminance 1 by
// then. Its shapes are the triangles of a trianglemesh, loopsubdiv or plymesh, the
// patches of a bilinearmesh, the faces of four corners of a plymesh, and each round
// shape.
#include <catch2/catch.hpp>

#include <fmt/format.h>

#include "src/base/core/pi.h"
#include "src/scene/parse/parse.h"
#include "tests/base/image/temporary_folder.h"
#include "tests/kernels/lights/pictures.h"
#include "tests/scene/compile/testing.h"

namespace lanelight {
namespace {

constexpr double kPower = 50;

struct Emitted {
  double power = 0;                      // of all lights, in the file's units
  double brightest = 0, darkest = 1e30;  // radiances
};

// An image has to have that mean luminance.
Emitted Emit(const std::string& light, const std::string& shape, double mean = 1,
             const std::string& folder = ".") {
  const std::string text = fmt::format(
      "Camera \"perspective\"\nWorldBegin\nAreaLightSource \"diffuse\" \"float power\" "
      "{} "
      "{}\n{}",
      kPower, light, shape);
  const CompiledScene scene = CompileScene(ParseSceneText(text, "test.pbrt", folder));
  Emitted out;
  for (const LightRecord& r : scene.lights.lights) {
    const double radiance = Luminance({r.radiance[0], r.radiance[1], r.radiance[2]});
    out.power += kPi * radiance * mean * double(r.area) * (r.two_sided ? 2 : 1) /
                 (scene.scale * scene.scale);
    out.brightest = std::max(out.brightest, radiance);
    out.darkest = std::min(out.darkest, radiance);
  }
  return out;
}

constexpr const char* kSquare =
    "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] "
    "\"point3 P\" [ 0 0 0  2 0 0  2 2 0  0 2 0 ]";

}  // namespace

TEST_CASE("power multiplies L and scale of area lights", "[lights][compile]") {
  const double two = 2 * kPower;  // two triangles
  CHECK(Emit("", kSquare).power == Approx(two));
  CHECK(Emit("\"float scale\" 3", kSquare).power == Approx(3 * two));
  CHECK(Emit("\"rgb L\" [ 4 4 4 ]", kSquare).power == Approx(4 * two));
  CHECK(Emit("\"rgb L\" [ 0 5 0 ] \"float scale\" 2", kSquare).power ==
        Approx(10 * Luminance({0, 1, 0}) * two));
  CHECK(Emit("\"blackbody L\" 3000", kSquare).power == Approx(two));
  CHECK(Emit("\"spectrum L\" [ 400 7 700 9 ]", kSquare).power == Approx(two));
  CHECK(Emit("\"bool twosided\" true", kSquare).power == Approx(two));
  // 50 W from each triangle of area 2.
  CHECK(Emit("\"rgb L\" [ 4 4 4 ] \"float scale\" 3", kSquare).brightest ==
        Approx(12 * kPower / (kPi * 2)));
}

TEST_CASE("each shape of pbrt's has the power of its area light", "[lights][compile]") {
  const auto shape = [](const std::string& text) { return "Shape " + text; };
  // Triangles of areas 2 and 6: each the whole power, so unequally bright.
  const Emitted uneven =
      Emit("", shape("\"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] "
                     "\"point3 P\" [ 0 0 0  2 0 0  2 2 0  -4 2 0 ]"));
  CHECK(uneven.power == Approx(2 * kPower));
  CHECK(uneven.brightest == Approx(3 * uneven.darkest));
  CHECK(Emit("", shape("\"bilinearmesh\" \"point3 P\" [ 0 0 0  2 0 0  0 2 0  2 2 0 ]"))
            .power == Approx(kPower));
  // Curved, so of many triangles, which are equally bright.
  const Emitted bent =
      Emit("", shape("\"bilinearmesh\" \"integer indices\" [ 0 1 2 3  0 1 2 3 ] "
                     "\"point3 P\" [ 0 0 0  2 0 0  0 2 0  2 2 1 ]"));
  CHECK(bent.power == Approx(2 * kPower));
  CHECK(bent.brightest == Approx(bent.darkest).epsilon(1e-3));
  CHECK(Emit("", shape("\"sphere\"")).power == Approx(kPower));
  CHECK(Emit("", shape("\"disk\" \"float innerradius\" 0.3")).power == Approx(kPower));
  CHECK(Emit("", shape("\"cylinder\"")).power == Approx(kPower));
  CHECK(Emit("", shape("\"sphere\" \"float zmax\" 0.2 \"float phimax\" 200")).power ==
        Approx(kPower));
  CHECK(Emit("", shape("\"loopsubdiv\" \"integer levels\" 1 \"integer indices\" "
                       "[ 0 1 2  0 2 3 ] \"point3 P\" [ 0 0 0  2 0 0  2 2 0  0 2 0 ]"))
            .power == Approx(8 * kPower));
}

TEST_CASE("faces of a mesh file have the power of its area light", "[lights][compile]") {
  const TemporaryFolder folder;
  const auto file = [&](const std::string& z) {
    const std::string ply = fmt::format(
        "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\n"
        "property float z\nelement face 3\nproperty list uchar int vertex_indices\n"
        "end_header\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n3 0 0\n3 2 {}\n"
        "4 0 1 2 3\n4 1 4 5 2\n3 0 3 1\n",
        z);
    folder.Write("faces.ply", ply);
    return "Shape \"plymesh\" \"string filename\" \"" + folder.File("faces.ply") + "\"";
  };
  const Emitted all = Emit("", file("0"));
  CHECK(all.power == Approx(3 * kPower));
  CHECK(all.darkest == Approx(kPower / (kPi * 4)));    // of the square of 2 x 2
  CHECK(all.brightest == Approx(kPower / (kPi * 2)));  // of the two others
  // A corner that is nowhere leaves half of the second face.
  CHECK(Emit("", file("nan")).power == Approx(3 * kPower));
}

// pbrt-v4 makes triangles of all faces before it displaces them.
TEST_CASE("each triangle of a displaced face has the full power", "[lights][compile]") {
  const TemporaryFolder folder;
  folder.Write(
      "quad.ply",
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float "
      "y\nproperty float z\nproperty float u\nproperty float v\nelement face "
      "1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 0 0\n2 0 0 1 "
      "0\n2 2 0 1 1\n0 2 0 0 1\n4 0 1 2 3\n");
  const auto displaced = [&](double edge) {
    return fmt::format(
        "Texture \"flat\" \"float\" \"constant\" \"float value\" 0 Shape \"plymesh\" "
        "\"string filename\" \"{}\" \"texture displacement\" \"flat\" "
        "\"float edgelength\" {}",
        folder.File("quad.ply"), edge);
  };
  CHECK(Emit("", displaced(10)).power == Approx(2 * kPower));
  CHECK(Emit("", displaced(2.5)).power == Approx(4 * kPower));  // the diagonal is cut
}

TEST_CASE("power with an image is that of its mean", "[lights][compile]") {
  double mean = 0;
  for (int i = 0; i < 24; ++i) mean += Luminance(test::Patchwork(i % 6, i / 6)) / 24;
  const std::string image = test::Picture("power.exr", 6, 4, test::Patchwork);
  const std::string light = "\"string filename\" \"" + image + "\" \"float scale\" 3";
  CHECK(Emit(light, "Shape \"disk\"", mean).power == Approx(3 * kPower));
}

}  // namespace lanelight
