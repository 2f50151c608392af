// Files of numbers, parted as pbrt-v4 parts them.
#include "src/base/core/error.h"
#include "src/scene/parse/lex.h"

#include <catch2/catch.hpp>

#include "src/scene/parse/parse.h"
#include "tests/base/image/temporary_folder.h"
#include "tests/support/input_error.h"

namespace lanelight {
namespace {

std::vector<double> NumbersOf(const std::string& text) {
  return ReadNumbers(text, std::make_shared<const std::string>("a.spd"));
}

std::string NumbersError(const std::string& text) {
  return InputErrorOf([&] { NumbersOf(text); });
}

TEST_CASE("numbers are separated by blanks or by one character", "[parse]") {
  using Values = std::vector<double>;
  CHECK(NumbersOf("400 0.5\n500\t.25\r\n") == Values{400, 0.5, 500, 0.25});
  CHECK(NumbersOf("400, 0.5\n500,.25") == Values{400, 0.5, 500, 0.25});
  CHECK(NumbersOf("400;0.5\n500:+2.5e-1,\n") == Values{400, 0.5, 500, 0.25});
  CHECK(NumbersOf("# nm, value\n400,0.5 # the first\n#end") == Values{400, 0.5});
  CHECK(NumbersOf("\xef\xbb\xbf"
                  "400,-1") == Values{400, -1});
  CHECK(NumbersOf("400 1#comment\n500 2") == Values{400, 1, 500, 2});
  CHECK(NumbersOf("") == Values{});
}

TEST_CASE("number files that pbrt-v4 refuses are errors with a location", "[parse]") {
  using Catch::Contains;
  CHECK_THAT(NumbersError("wavelength,value\n400,0.5"),
             Contains("a.spd:1:1") && Contains("#"));
  CHECK_THAT(NumbersError("400,0.5\n500 , 1"),
             Contains("a.spd:2:5") && Contains("\",\""));
  CHECK_THAT(NumbersError("400,,0.5"), Contains("a.spd:1:5"));
  CHECK_THAT(NumbersError("400 0.5\n500nm 1"),
             Contains("a.spd:2:5") && Contains("\"m\""));
  CHECK_THAT(NumbersError("400 1-2"), Contains("a.spd:1:5") && Contains("\"1-2\""));
  CHECK_THAT(NumbersError("400 1e999"), Contains("finite"));
  CHECK_THAT(NumbersError("400 nan"), Contains("a.spd:1:5"));
  CHECK_THAT(NumbersError("400 .\n"), Contains("a.spd:1:5"));
}

TEST_CASE("lines of a file of numbers may end in CR alone", "[parse]") {
  CHECK(NumbersOf("# a\r400 1 # b\r500 2\r") == std::vector<double>{400, 1, 500, 2});
  CHECK_THAT(NumbersError("# a\r400 1\r\n500 x"), Catch::Contains("a.spd:3:5"));
}

TEST_CASE("scenes read spectra and lenses with commas", "[parse]") {
  const TemporaryFolder folder;
  folder.Write("flat.csv", "# nm, value\n400, 0.25\n700, 0.25\n");
  folder.Write("lens.dat",
               "# radius, thickness, eta, diameter\r30, 5, 1.5, 20\r"
               "0, 5, 0, 10\r-30, 40, 1, 20\r");
  const std::string scene = folder.Write("scene.pbrt", R"(
    Camera "realistic" "string lensfile" "lens.dat" "float aperturediameter" 2
    WorldBegin Material "diffuse" "spectrum reflectance" "flat.csv" Shape "sphere")");
  const SceneDescription read = ParseScene(scene);
  CHECK(read.camera.lens.size() == 12);
  const Material& material =
      read.materials.at(static_cast<std::size_t>(read.shapes.at(0).material));
  CHECK(material.reflectance.constant.y == Approx(0.25).epsilon(0.01));
}

}  // namespace
}  // namespace lanelight
