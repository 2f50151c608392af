// The fuzz target on a fixed list of inputs: valid scenes and meshes, changed by a seeded
// generator. Nothing but InputError may escape, and both outcomes must occur.
#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "tests/fuzz/parse_fuzz.h"

namespace lanelight {
namespace {

namespace fs = std::filesystem;

const char kScene[] = R"(LookAt 0 1 5  0 0 0  0 1 0
Camera "perspective" "float fov" 45 "float screenwindow" [ -1 1 -1 1 ]
Film "rgb" "integer xresolution" 64 "integer yresolution" 32
  "float cropwindow" [ 0 1 0 1 ]
Sampler "zsobol" "integer pixelsamples" 4
PixelFilter "mitchell" "float B" 0.3
Integrator "volpath" "integer maxdepth" 3
Option "seed" 7
WorldBegin
Texture "a" "float" "constant" "float value" 0.5
Texture "b" "spectrum" "checkerboard" "rgb tex1" [ 1 0 0 ] "float uscale" 4
Texture "c" "spectrum" "imagemap" "string filename" "x.png" "string encoding" "gamma 2"
MakeNamedMaterial "m" "string type" "coateddiffuse" "texture reflectance" "b"
MakeNamedMaterial "n" "string type" "conductor" "spectrum eta" "metal-Au-eta"
Material "mix" "string materials" [ "m" "n" ] "texture amount" "a"
)";
const char kWorld[] = R"(WorldBegin
LightSource "spot" "blackbody I" 3000 "float power" 10 "point3 from" [ 0 1 0 ]
LightSource "infinite" "spectrum L" [ 400 1 500 2 600 3 ]
AttributeBegin Translate 1 2 3 Rotate 30 0 1 0 Scale 1 2 3
AreaLightSource "diffuse" "rgb L" [ 1 2 3 ] "bool twosided" true
Shape "sphere" "float radius" 2
AttributeEnd
ObjectBegin "o" Attribute "shape" "float radius" 3 Shape "disk" Shape "plane" ObjectEnd
TransformBegin Transform [ 1 0 0 0 0 1 0 0 0 0 1 0 1 2 3 1 ]
ObjectInstance "o" TransformEnd
Shape "trianglemesh" "point3 P" [ 0 0 0 1 0 0 0 1 0 1 1 0 ] "integer indices" [ 0 1 2 ]
Shape "bilinearmesh" "point3 P" [ 0 0 0 1 0 0 0 1 0 1 1 0 ]
  "point2 uv" [ 0 0 1 0 0 1 1 1 ]
CoordinateSystem "s" CoordSysTransform "s" ReverseOrientation
)";
const char kAsciiPly[] =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nproperty float u\nproperty float v\nelement face 2\n"
    "property list uchar int vertex_indices\nend_header\n0 0 0 0 0\n1 0 0 1 0\n"
    "1 1 0 1 1\n0 1 0 0 1\n4 0 1 2 3\n3 0 1 2\n";

std::string BinaryPly(bool big) {
  std::string bytes = std::string("ply\nformat ") +
                      (big ? "binary_big_endian" : "binary_little_endian") +
                      " 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                      "property double z\nproperty list uchar short l\nelement face 1\n"
                      "property list uchar uint vertex_index\nend_header\n";
  bytes += std::string(3 * 17, '\0');
  const char* indices = big ? "\3\0\0\0\0\0\0\0\1\0\0\0\2" : "\3\0\0\0\0\1\0\0\0\2\0\0\0";
  return bytes + std::string(indices, 13);
}

using Random = std::mt19937;

std::size_t Below(Random& random, std::size_t n) {
  return n == 0 ? 0 : random() % n;  // not std::uniform_int_distribution: it may differ
}

// Words and numbers that have a meaning somewhere, or none anywhere.
const std::vector<std::string> kPieces = {"[",
                                          "]",
                                          "\"",
                                          "#",
                                          "\n",
                                          "-1",
                                          "0",
                                          "1e308",
                                          "1e-320",
                                          "nan",
                                          "4294967296",
                                          "0.5",
                                          "\"float radius\"",
                                          "\"string type\"",
                                          "\"diffuse\"",
                                          "Shape \"sphere\"",
                                          "AttributeBegin",
                                          "AttributeEnd",
                                          "ObjectBegin \"o\"",
                                          "ObjectEnd",
                                          "Scale 0 0 0",
                                          "Include \"a\"",
                                          "\"rgb L\" [",
                                          "\"texture alpha\" \"a\"",
                                          "property list uchar int vertex_indices",
                                          "element vertex 99999999",
                                          "\xff\xfe",
                                          std::string(1, '\0')};

void Mutate(Random& random, const std::string& other, std::string* text) {
  const std::size_t at = Below(random, text->size() + 1);
  const std::size_t length = std::min(Below(random, 12), text->size() - at);
  switch (random() % 9) {
    case 0:
      text->erase(at, length);
      break;
    case 1:
      text->insert(at, kPieces[Below(random, kPieces.size())]);
      break;
    case 2:
      text->insert(at, text->substr(at, length));
      break;
    case 3:
      if (at < text->size()) (*text)[at] = static_cast<char>(random());
      break;
    case 4:
      text->resize(at);
      break;
    case 5:
    case 6:
    case 7: {  // another digit: input that is well-formed and often accepted
      const std::size_t digit = text->find_first_of("0123456789", at);
      if (digit != text->npos) (*text)[digit] = static_cast<char>('0' + random() % 10);
      break;
    }
    default: {  // a line of another input
      const std::size_t from = other.find('\n', Below(random, other.size()));
      if (from != other.npos) text->insert(at, other.substr(from, 1 + Below(random, 60)));
    }
  }
}

std::vector<std::string> Seeds() {
  std::vector<std::string> seeds = {kScene, kWorld, kAsciiPly, BinaryPly(false),
                                    BinaryPly(true)};
  const fs::path folder = fs::path(LANELIGHT_SOURCE_DIR) / "tests" / "scene" / "broken";
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(folder)) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  for (const fs::path& path : paths) {
    std::ifstream file(path, std::ios::binary);
    std::stringstream content;
    content << file.rdbuf();
    if (content.str().size() < 1000) seeds.push_back(content.str());
  }
  return seeds;
}

TEST_CASE("only InputError escapes from mutated input", "[parse]") {
  const std::vector<std::string> seeds = Seeds();
  for (int i = 0; i < 5; ++i) REQUIRE(FuzzParse(seeds[i]));
  Random random(1);
  int accepted = 0;
  constexpr int kInputs = 20000;
  for (int i = 0; i < kInputs; ++i) {
    // Half of the inputs start from the valid ones.
    const std::size_t pool = i % 2 == 0 ? 5 : seeds.size();
    std::string text = seeds[Below(random, pool)];
    const int changes = 1 + static_cast<int>(random() % 4);
    for (int k = 0; k < changes; ++k) {
      Mutate(random, seeds[Below(random, seeds.size())], &text);
    }
    try {
      accepted += FuzzParse(text) ? 1 : 0;
    } catch (const std::exception& error) {
      CAPTURE(i, text);
      FAIL("escaped: " << error.what());
    }
  }
  CHECK(accepted > kInputs / 50);
  CHECK(accepted < kInputs);
}

}  // namespace
}  // namespace lanelight
