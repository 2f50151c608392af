// Shape "curve": bases, widths, normals, and what becomes of many.
#include <catch2/catch.hpp>

#include "tests/scene/parse/parse_text.h"

namespace lanelight {
namespace {

const std::vector<Curve>& CurvesOf(const SceneDescription& scene, std::size_t shape = 0) {
  REQUIRE(scene.shapes.size() > shape);
  REQUIRE(scene.shapes[shape].kind == ShapeKind::kCurves);
  return *scene.shapes[shape].curves;
}

Vec3d BezierAt(const Curve& c, double u) {
  const double w = 1 - u;
  return w * w * w * c.p[0] + 3 * w * w * u * c.p[1] + 3 * w * u * u * c.p[2] +
         u * u * u * c.p[3];
}

bool IsNear(Vec3d a, Vec3d b) { return Length(a - b) < 1e-12; }

const std::string kSeven =
    R"("point3 P" [ 0 0 0  1 3 0  2 -1 1  3 0 0  4 1 0  5 0 2  6 0 0 ])";

}  // namespace

TEST_CASE("Bezier curves of several parts share their ends", "[parse][curves]") {
  const auto scene = ParseWorld("Shape \"curve\" \"float width0\" 3 " + kSeven);
  const std::vector<Curve>& curves = CurvesOf(scene);
  REQUIRE(curves.size() == 2);
  CHECK(curves[0].p[3] == Vec3d{3, 0, 0});
  CHECK(curves[1].p[0] == Vec3d{3, 0, 0});
  CHECK(curves[1].p[2] == Vec3d{5, 0, 2});
  CHECK(curves[0].width[0] == 3);
  CHECK(curves[0].width[1] == 2);
  CHECK(curves[1].width[1] == 1);
  CHECK(curves[0].type == CurveType::kFlat);
}

TEST_CASE("quadratic curves are the same as cubic ones", "[parse][curves]") {
  const auto scene = ParseWorld("Shape \"curve\" \"integer degree\" 2 " + kSeven);
  const std::vector<Curve>& curves = CurvesOf(scene);
  REQUIRE(curves.size() == 3);
  const Vec3d a = {0, 0, 0}, b = {1, 3, 0}, c = {2, -1, 1};
  for (const double u : {0.0, 0.3, 1.0}) {
    const double w = 1 - u;
    CHECK(IsNear(BezierAt(curves[0], u), w * w * a + 2 * w * u * b + u * u * c));
  }
}

TEST_CASE("B-splines are smooth where their parts meet", "[parse][curves]") {
  for (const int degree : {2, 3}) {
    const auto scene =
        ParseWorld("Shape \"curve\" \"string basis\" \"bspline\" \"integer degree\" " +
                   std::to_string(degree) + " " + kSeven);
    const std::vector<Curve>& curves = CurvesOf(scene);
    REQUIRE(curves.size() == static_cast<std::size_t>(7 - degree));
    for (std::size_t i = 0; i + 1 < curves.size(); ++i) {
      const Curve &a = curves[i], &b = curves[i + 1];
      CHECK(IsNear(a.p[3], b.p[0]));
      CHECK(IsNear(a.p[3] - a.p[2], b.p[1] - b.p[0]));
      if (degree == 2) continue;  // and as bent
      CHECK(IsNear(a.p[3] - 2.0 * a.p[2] + a.p[1], b.p[2] - 2.0 * b.p[1] + b.p[0]));
    }
    // Cox and de Boor: what the basis functions are in the middle of a part.
    const Vec3d a = {0, 0, 0}, b = {1, 3, 0}, c = {2, -1, 1}, d = {3, 0, 0};
    const Vec3d middle =
        degree == 2 ? (a + 6.0 * b + c) / 8 : (a + 23.0 * b + 23.0 * c + d) / 48;
    CHECK(IsNear(BezierAt(curves[0], 0.5), middle));
  }
}

TEST_CASE("ribbons have a normal at each end of a part", "[parse][curves]") {
  const auto scene = ParseWorld(
      "Shape \"curve\" \"string type\" \"ribbon\" \"normal N\" [ 0 0 2  0 3 0  1 0 0 ] " +
      kSeven);
  const std::vector<Curve>& curves = CurvesOf(scene);
  REQUIRE(curves.size() == 2);
  CHECK(curves[0].normal[0] == Vec3d{0, 0, 1});
  CHECK(curves[0].normal[1] == Vec3d{0, 1, 0});
  CHECK(curves[1].normal[1] == Vec3d{1, 0, 0});
}

TEST_CASE("strands one after the other become one shape", "[parse][curves]") {
  const std::string curve = "Shape \"curve\" " + kSeven + "\n";
  const auto scene =
      ParseWorld(curve + curve + "Translate 1 0 0\n" + curve + "Material \"diffuse\"\n" +
                 curve + curve + "ReverseOrientation\n" + curve);
  REQUIRE(scene.shapes.size() == 4);
  CHECK(CurvesOf(scene, 0).size() == 4);
  CHECK(CurvesOf(scene, 1).size() == 2);
  CHECK(CurvesOf(scene, 2).size() == 4);
  CHECK(CurvesOf(scene, 3).size() == 2);
}

TEST_CASE("invisible curves are left out with a note", "[parse][curves]") {
  const auto none = ParseWorld("Shape \"curve\" \"float width\" 0 " + kSeven);
  CHECK(none.shapes.empty());
  CHECK(none.notes.size() == 1);
  const auto half = ParseWorld(
      "Shape \"curve\" \"point3 P\" [ 1 1 1  1 1 1  1 1 1  1 1 1  2 1 1  3 1 1  4 1 1 ]");
  CHECK(CurvesOf(half).size() == 1);
  CHECK(half.notes.size() == 1);
}

TEST_CASE("curves cannot emit or bound media", "[parse][curves]") {
  const auto scene = ParseWorld(
      "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\"\n"
      "MediumInterface \"fog\" \"\"\nAreaLightSource \"diffuse\"\n"
      "Shape \"curve\" " +
      kSeven + "Shape \"curve\" " + kSeven);
  CHECK(scene.shapes[0].area_light == kNone);
  CHECK_FALSE(scene.shapes[0].media.IsTransition());
  CHECK(scene.notes.size() == 2);
}

TEST_CASE("the colour of hair is given in one of four ways", "[parse][hair]") {
  const auto hair = [](const std::string& params) {
    return ParseWorld("Material \"hair\" " + params + " Shape \"sphere\"");
  };
  const Material brown = hair("").materials.back();
  CHECK(brown.kind == MaterialKind::kHair);
  CHECK(brown.interface_eta == 1.55);
  CHECK(brown.sigma_a.x == Approx(1.3 * 0.419));
  const Material red = hair("\"float pheomelanin\" 2").materials.back();
  CHECK(red.sigma_a.z == Approx(2.1));
  const Material mixed =
      hair("\"float eumelanin\" 1 \"float pheomelanin\" 1").materials.back();
  CHECK(mixed.sigma_a.y == Approx(1.097));
  const auto blond = hair("\"rgb reflectance\" [ 0.8 0.7 0.5 ] \"float eumelanin\" 1");
  CHECK(blond.materials.back().has_reflectance);
  CHECK(blond.materials.back().reflectance.constant == Rgb{0.8, 0.7, 0.5});
  CHECK(blond.notes.size() == 1);
  const auto clear = hair("\"rgb sigma_a\" [ 0.1 0 2 ] \"rgb reflectance\" [ 1 1 1 ]");
  CHECK(clear.materials.back().sigma_a == Rgb{0.1, 0, 2});
  CHECK_FALSE(clear.materials.back().has_reflectance);
  CHECK(clear.notes.size() == 1);
}

}  // namespace lanelight
