#include "src/scene/parse/ply.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstring>

#include "tests/base/image/temporary_folder.h"
#include "tests/scene/parse/parse_text.h"
#include "tests/support/input_error.h"

namespace lanelight {
namespace {

// Writes a PLY file value by value in one of the three formats.
class PlyWriter {
 public:
  enum Format { kAscii, kLittle, kBig };

  PlyWriter(Format format, const std::string& declarations) : format_(format) {
    const char* names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    bytes_ = std::string("ply\nformat ") + names[format] +
             " 1.0\ncomment made by a test\n" + declarations + "end_header\n";
  }

  template <typename T>
  PlyWriter& Add(T value) {
    if (format_ == kAscii) {
      bytes_ += std::to_string(value) + ' ';
      return *this;
    }
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    if (format_ == kBig) std::reverse(raw, raw + sizeof(T));
    bytes_.append(raw, sizeof(T));
    return *this;
  }

  const std::string& bytes() const { return bytes_; }

 private:
  Format format_;
  std::string bytes_;
};

constexpr PlyWriter::Format kFormats[] = {PlyWriter::kAscii, PlyWriter::kLittle,
                                          PlyWriter::kBig};

std::string ErrorOf(const std::string& bytes) {
  return InputErrorOf([&] { ParsePly(bytes, "m.ply"); });
}

std::string WithLineEnds(std::string text, const std::string& end) {
  for (std::size_t at = 0; (at = text.find('\n', at)) != text.npos; at += end.size()) {
    text.replace(at, 1, end);
  }
  return text;
}

const char kPlain[] =
    "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\n";

std::string PlainTriangle(PlyWriter::Format format) {
  PlyWriter w(format, kPlain);
  for (float v : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.5f}) w.Add(v);
  return w.Add<std::uint8_t>(3).Add(0).Add(1).Add(2).bytes();
}

TEST_CASE("PLY: lines end with LF, CR LF or CR alone", "[parse][ply]") {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    PlyWriter text(PlyWriter::kAscii, kPlain);
    for (int value : {0, 0, 0, 1, 0, 0, 0, 1, 0, 3, 0, 1, 2}) text.Add(value);
    CHECK(ParsePly(WithLineEnds(text.bytes(), end), "m.ply").mesh.positions.size() == 3);
    // The binary body begins with a byte that looks like a line's end.
    const PlyWriter head(PlyWriter::kLittle, kPlain);
    PlyWriter body(PlyWriter::kLittle, kPlain);
    for (float value : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) body.Add(value);
    body.Add<std::uint8_t>(3);
    for (int value : {0, 1, 2}) body.Add(value);
    std::string binary = body.bytes().substr(head.bytes().size());
    binary[0] = '\n';
    const PlyMesh ply = ParsePly(WithLineEnds(head.bytes(), end) + binary, "m.ply");
    CHECK(ply.mesh.positions.size() == 3);
    const PlyWriter empty(PlyWriter::kAscii, kPlain);
    const std::string bad = WithLineEnds(empty.bytes() + "0 0 0\n1 x 0\n", end);
    CHECK_THAT(ErrorOf(bad), Catch::Contains("m.ply:12:3"));
  }
}

TEST_CASE("a triangle in every format", "[parse][ply]") {
  for (const auto format : kFormats) {
    CAPTURE(format);
    const TriangleMesh mesh = ParsePly(PlainTriangle(format), "m.ply").mesh;
    REQUIRE(mesh.positions.size() == 3);
    CHECK(mesh.positions[1] == Vec3d{1, 0, 0});
    CHECK(mesh.positions[2] == Vec3d{0, 1, 0.5});
    CHECK(mesh.indices == std::vector<std::uint32_t>{0, 1, 2});
    CHECK(mesh.normals.empty());
    CHECK(mesh.uvs.empty());
  }
}

// Every type, foreign properties and elements, a list inside a vertex, s/t as uv.
const char kRich[] =
    "element camera 2\nproperty list ushort short path\nproperty double f\n"
    "element vertex 4\nproperty double x\nproperty int y\nproperty short z\n"
    "property uchar red\nproperty float nx\nproperty char ny\nproperty ushort nz\n"
    "property list uint uint marks\nproperty float s\nproperty double t\n"
    "element face 2\nproperty int face_indices\n"
    "property list uint ushort vertex_index\nproperty list uchar float tex\n"
    "element edge 1\nproperty uint a\n";

std::string RichQuad(PlyWriter::Format format) {
  PlyWriter w(format, kRich);
  w.Add<std::uint16_t>(2).Add<std::int16_t>(5).Add<std::int16_t>(-6).Add(1.5);
  w.Add<std::uint16_t>(0).Add(2.5);
  for (int i = 0; i < 4; ++i) {
    w.Add(i == 1 || i == 2 ? 1.0 : 0.0).Add<std::int32_t>(i / 2).Add<std::int16_t>(-7);
    w.Add<std::uint8_t>(200).Add(0.25f).Add<std::int8_t>(-1).Add<std::uint16_t>(2);
    w.Add<std::uint32_t>(i % 2);
    if (i % 2) w.Add<std::uint32_t>(9);
    w.Add(0.5f * i).Add(0.125 * i);
  }
  w.Add(11).Add<std::uint32_t>(4);
  for (std::uint16_t i = 0; i < 4; ++i) w.Add(i);
  w.Add<std::uint8_t>(1).Add(0.5f);
  w.Add(12).Add<std::uint32_t>(3);
  for (std::uint16_t i : {3, 1, 0}) w.Add(i);
  w.Add<std::uint8_t>(0);
  return w.Add<std::uint32_t>(1).bytes();
}

TEST_CASE("all types, quads, normals, uvs, foreign data", "[parse][ply]") {
  for (const auto format : kFormats) {
    CAPTURE(format);
    const PlyMesh ply = ParsePly(RichQuad(format), "m.ply");
    const TriangleMesh& mesh = ply.mesh;
    REQUIRE(mesh.positions.size() == 4);
    CHECK(mesh.positions[2] == Vec3d{1, 1, -7});
    CHECK(mesh.normals[0] == Vec3d{0.25, -1, 2});
    CHECK(mesh.uvs[3] == std::array<double, 2>{1.5, 0.375});
    CHECK(mesh.indices == std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3, 3, 1, 0});
    CHECK(ply.bent_quads == 0);
  }
}

TEST_CASE("quads without uvs get the corners of the unit square", "[parse][ply]") {
  PlyWriter w(PlyWriter::kAscii,
              "element vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
              "element face 2\nproperty list uchar int vertex_indices\n");
  for (float v :
       {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 1.f, 0.f, 0.f, 1.f, 0.f, 2.f, 0.f, 0.f})
    w.Add(v);
  w.Add<std::uint8_t>(3).Add(1).Add(4).Add(2);
  w.Add<std::uint8_t>(4).Add(0).Add(1).Add(2).Add(3);
  const TriangleMesh mesh = ParsePly(w.bytes(), "m.ply").mesh;
  REQUIRE(mesh.positions.size() == 7);
  REQUIRE(mesh.indices.size() == 9);
  // The quad is a unit square, so its uvs are its positions.
  for (std::size_t i = 3; i < 9; ++i) {
    const std::uint32_t vertex = mesh.indices[i];
    CHECK(mesh.uvs[vertex][0] == mesh.positions[vertex].x);
    CHECK(mesh.uvs[vertex][1] == mesh.positions[vertex].y);
  }
  CHECK(mesh.positions[mesh.indices[1]] == Vec3d{2, 0, 0});
}

TEST_CASE("non-planar quads are counted", "[parse][ply]") {
  PlyWriter w(PlyWriter::kLittle,
              "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
              "property float u\nproperty float v\n"
              "element face 1\nproperty list uchar int vertex_indices\n");
  for (int i = 0; i < 4; ++i) {
    w.Add(i == 1 || i == 2 ? 1.f : 0.f).Add(i >= 2 ? 1.f : 0.f).Add(i == 3 ? 0.5f : 0.f);
    w.Add(0.f).Add(0.f);
  }
  w.Add<std::uint8_t>(4).Add(0).Add(1).Add(2).Add(3);
  CHECK(ParsePly(w.bytes(), "m.ply").bent_quads == 1);
}

TEST_CASE("faces may stand before vertices", "[parse][ply]") {
  PlyWriter w(PlyWriter::kBig,
              "element face 1\nproperty list uchar uint vertex_indices\n"
              "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n");
  w.Add<std::uint8_t>(3).Add<std::uint32_t>(2).Add<std::uint32_t>(1).Add<std::uint32_t>(
      0);
  for (int i = 0; i < 9; ++i) w.Add(static_cast<float>(i));
  CHECK(ParsePly(w.bytes(), "m.ply").mesh.indices == std::vector<std::uint32_t>{2, 1, 0});
}

TEST_CASE("every truncation is an error", "[parse][ply]") {
  for (const auto format : kFormats) {
    for (const std::string& whole : {PlainTriangle(format), RichQuad(format)}) {
      REQUIRE(ErrorOf(whole) == "");
      // Text may lose its last blank.
      const std::size_t end = whole.size() - (format == PlyWriter::kAscii ? 1 : 0);
      for (std::size_t n = 0; n < end; ++n) {
        const std::string message = ErrorOf(whole.substr(0, n));
        // The last number of a text may become a shorter number.
        const bool shorter_number = format == PlyWriter::kAscii && n + 1 >= end;
        if (shorter_number) continue;
        CAPTURE(format, n);
        REQUIRE(message.find("m.ply") == 0);
      }
    }
  }
}

TEST_CASE("binary files with impossible content are refused", "[parse][ply]") {
  struct Case {
    const char* declarations;
    const char* message;
  };
  for (const Case& c : {
           Case{"element vertex 4294967295\nproperty float x\nproperty float y\n"
                "property float z\n",
                "more than the rest of the file can hold"},
           Case{"element vertex 18446744073709551615\nproperty char x\n"
                "property char y\nproperty char z\n",
                "more than the rest of the file can hold"},
           Case{"element camera 1000000000\n", "more than the rest of the file can hold"},
           Case{"element vertex 3\nproperty float x\n",
                "needs the properties x, y and z"},
           Case{"element face 1\nproperty list uint int vertex_indices\n",
                "the PLY list \"vertex_indices\" has"},
       }) {
    CAPTURE(c.declarations);
    PlyWriter w(PlyWriter::kLittle, c.declarations);
    for (int i = 0; i < 20; ++i) w.Add<std::uint32_t>(0x7f000000u + i);
    const std::string message = ErrorOf(w.bytes());
    CAPTURE(message);
    CHECK(message.find(c.message) != std::string::npos);
    CHECK(message.find("(at byte ") != std::string::npos);
  }
}

TEST_CASE("binary values that are not indices are refused", "[parse][ply]") {
  PlyWriter index(PlyWriter::kLittle, kPlain);
  for (int i = 0; i < 9; ++i) index.Add(1.f);
  index.Add<std::uint8_t>(3).Add(0).Add(-1).Add(2);
  CHECK(ErrorOf(index.bytes()).find("-1 in PLY face 0 is not an index") !=
        std::string::npos);
}

// The error of a scene whose mesh has these bytes.
std::string SceneErrorOf(const std::string& bytes) {
  const TemporaryFolder folder;
  folder.Write("m.ply", bytes);
  return InputErrorOf([&] {
    ParseSceneText("WorldBegin\n  Shape \"plymesh\" \"string filename\" \"m.ply\"",
                   "main.pbrt", folder.File(""));
  });
}

TEST_CASE("a bad binary mesh is reported at the scene's line", "[parse][ply]") {
  const std::string whole = PlainTriangle(PlyWriter::kLittle);
  CHECK_THAT(SceneErrorOf(whole.substr(0, whole.size() - 1)),
             Catch::StartsWith("main.pbrt:2:19: error: ") && Catch::Contains("m.ply: "));
}

TEST_CASE("mistakes in the text of a mesh are reported with their place",
          "[parse][ply]") {
  const std::string good =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
      "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  CHECK(SceneErrorOf(good) == "");
  const std::string end = good.substr(good.find("end_header"));
  struct Case {
    std::string from, to;        // what is replaced in the mesh
    std::string place, message;  // both in the error
  };
  const Case cases[] = {
      {"vertex 3", "vertex three", "m.ply:3:1", "not a count"},
      {"vertex 3", "vertex 4000000000", "m.ply:10:1",
       "more than the rest of the file can hold"},
      {"vertex 3", "vertex 99999999999999999999", "m.ply:3:1", "not a count"},
      {"ascii", "ascii_text", "m.ply:2:1", "unknown PLY format \"ascii_text\""},
      {"1.0", "2.0", "m.ply:2:1", "1.0 is"},
      {"float z", "flot z", "m.ply:6:1: unknown PLY type \"flot\"",
       "did you mean \"float\"?"},
      {"list uchar", "list float", "", "must be an integer type"},
      {"3 0 1 2", "3 0 1 3", "", "the vertex index 3, but there are 3 vertices"},
      {"3 0 1 2", "3 0 1 -2", "m.ply:13:9", "-2 in PLY face 0 is not an index"},
      {end, "", "m.ply:9:1", "ends without end_header"},
      {"face 1", "face 0", "", "no faces"},
      {"vertex_indices", "corners", "", "needs the list vertex_indices"},
      {"property float z\n", "", "", "needs the properties x, y and z"},
      {"ply\n", "OFF\n", "m.ply:1:1", "not a PLY file"},
      {"3 0 1 2", "5 0 1 2 0 1", "", "no faces of 3 or 4 corners"},
      {"element vertex 3\n", "", "m.ply:3:1", "before any element"},
      {"1 0 0", "1 nan 0", "",
       "no face of the PLY file has corners with finite coordinates"},
      {"3 0 1 2\n", "3 0 1", "m.ply:13:2",
       "list \"vertex_indices\" has 3 values, more than the rest of the file"},
      {"1 0 0", "1 zero 0", "m.ply:11:3", "\"zero\" is not a number"}};
  for (const Case& c : cases) {
    std::string bad = good;
    REQUIRE(bad.find(c.from) != bad.npos);
    bad.replace(bad.find(c.from), c.from.size(), c.to);
    CAPTURE(c.to);
    CHECK_THAT(SceneErrorOf(bad), Catch::StartsWith("main.pbrt:2:19: error: ") &&
                                      Catch::Contains(c.place) &&
                                      Catch::Contains(c.message));
  }
}

}  // namespace
}  // namespace lanelight
