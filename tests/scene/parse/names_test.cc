// Names that look the same are the same, however their letters are composed.
#include "src/scene/parse/names.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>

#include "tests/base/image/temporary_folder.h"
#include "tests/scene/parse/parse_text.h"

namespace lanelight {
namespace {

const std::string kOne = "caf\xc3\xa9";   // é as one letter
const std::string kTwo = "cafe\xcc\x81";  // e, then a combining acute accent
const std::string kLatin1 = "caf\xe9";    // not UTF-8

// Replaces each ONE and TWO.
std::string WithNames(std::string text) {
  for (const auto& [word, name] : {std::pair{"ONE", kOne}, {"TWO", kTwo}}) {
    for (std::size_t at; (at = text.find(word)) != text.npos;) text.replace(at, 3, name);
  }
  return text;
}

TEST_CASE("names are composed (NFC); other bytes are kept", "[parse]") {
  CHECK(NormalizedName(kTwo) == kOne);
  CHECK(NormalizedName(kOne) == kOne);
  CHECK(NormalizedName("") == "");
  CHECK(NormalizedName("plain") == "plain");
  CHECK(NormalizedName(kLatin1) == kLatin1);
  // Hangul letters by rule, and marks in canonical order.
  CHECK(NormalizedName("\xe1\x84\x92\xe1\x85\xa1\xe1\x86\xab") == "\xed\x95\x9c");
  CHECK(NormalizedName("q\xcc\x87\xcc\xa3") == "q\xcc\xa3\xcc\x87");
  // Compatibility forms are other names: the ligature fi.
  CHECK(NormalizedName("\xef\xac\x81") == "\xef\xac\x81");
}

TEST_CASE("every kind of name is found in another Unicode composition", "[parse]") {
  const std::string world = GENERATE(
      R"(MakeNamedMaterial "ONE" "string type" "diffuse" NamedMaterial "TWO")",
      R"(NamedMaterial "ONE" Shape "sphere"
         MakeNamedMaterial "TWO" "string type" "diffuse")",
      R"(MakeNamedMaterial "ONE" "string type" "diffuse"
         Material "mix" "string materials" [ "TWO" "ONE" ])",
      R"(Texture "TWO" "spectrum" "constant" "rgb value" [ 0.1 0.2 0.3 ]
         Material "diffuse" "texture reflectance" "ONE")",
      R"(Texture "ONE" "float" "constant" "float value" 1
         Texture "b" "float" "scale" "texture tex" "TWO")",
      R"(MakeNamedMedium "ONE" "string type" "homogeneous" MediumInterface "TWO" "ONE")",
      R"(ObjectBegin "ONE" Shape "sphere" ObjectEnd ObjectInstance "TWO")",
      R"(ObjectInstance "ONE" ObjectBegin "TWO" Shape "sphere" ObjectEnd)",
      R"(CoordinateSystem "ONE" CoordSysTransform "TWO")");
  INFO(world);
  const SceneDescription scene = ParseWorld(WithNames(world) + " Shape \"sphere\"");
  CHECK_FALSE(HasWarning(scene, "unknown"));
}

TEST_CASE("a name in two Unicode compositions is one name", "[parse]") {
  CHECK(WorldError(WithNames(R"(MakeNamedMaterial "ONE" "string type" "diffuse"
                                MakeNamedMaterial "TWO" "string type" "diffuse")"))
            .find("is defined twice") != std::string::npos);
}

TEST_CASE("file names are used unchanged", "[parse]") {
  const TemporaryFolder folder;
  std::ofstream(folder.File(kTwo + ".pbrt")) << "Shape \"sphere\"";
  std::ofstream(folder.File("main.pbrt"))
      << WithNames("WorldBegin Include \"TWO.pbrt\" Import \"TWO.pbrt\"");
  CHECK(ParseScene(folder.File("main.pbrt"), {}).shapes.size() == 2);
}

}  // namespace
}  // namespace lanelight
