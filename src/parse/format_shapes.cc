// Shapes.
#include "src/parse/format.h"

namespace lanelight {
namespace {

using enum FormatStatus;
using Lines = std::vector<FormatLine>;

constexpr const char* kQuad = "[ -1 -1 0  1 -1 0  -1 1 0  1 1 0 ]";
constexpr const char* kPtex = "only ptex textures need it";

Lines Quadric(Lines lines) {
  lines.push_back({"float|texture alpha", kRendered});
  return lines;
}

FormatTable Quadrics() {
  return {
      {"Shape", "sphere", kRendered, "",
       Quadric({{"float radius", kRendered},
                {"float zmin", kRendered, "", "-1"},
                {"float zmin", kRendered, "", "-0.5"},
                {"float zmax", kRendered, "", "1"},
                {"float zmax", kRendered, "", "0.5"},
                {"float phimax", kRendered, "", "360"},
                {"float phimax", kRendered, "", "180"}})},
      {"Shape", "disk", kRendered, "",
       Quadric({{"float height", kRendered},
                {"float radius", kRendered},
                {"float innerradius", kRendered, "", "0.25"},
                {"float phimax", kRendered, "", "360"},
                {"float phimax", kRendered, "", "180"}})},
      {"Shape",
       "cylinder",
       kRendered,
       "",
       {{"float radius", kRendered},
        {"float zmin", kRendered, "", "-0.5"},
        {"float zmax", kRendered, "", "0.5"},
        {"float phimax", kRendered, "", "180"},
        {"float|texture alpha", kRendered}}},
      {"Shape", "plane", kRendered, "", Quadric({})},
  };
}

FormatTable Meshes() {
  const FormatLine quad = {"point3 P", kRendered, "", kQuad, true};
  return {
      {"Shape",
       "trianglemesh",
       kRendered,
       "",
       {quad,
        {"integer indices", kRendered, "", "[ 0 1 2 ]", true},
        {"normal N", kRendered, "", "[ 0 0 1  0 0 1  0 0 1  0 0 1 ]"},
        {"vector3 S", kNoted, "tangents follow from the uvs",
         "[ 1 0 0  1 0 0  1 0 0  1 0 0 ]"},
        {"point2 uv", kRendered, "", "[ 0 0  1 0  0 1  1 1 ]"},
        {"integer faceIndices", kNoted, kPtex, "[ 0 ]"},
        {"float|texture alpha", kRendered}}},
      {"Shape",
       "bilinearmesh",
       kRendered,
       "",
       {{"point3 P", kRendered, "", kQuad, true},
        {"point3 P", kRendered, "", "[ -1 -1 0  1 -1 1  -1 1 1  1 1 0 ]"},
        {"integer indices", kRendered, "", "[ 0 1 2 3 ]"},
        {"normal N", kRendered, "", "[ 0 0 1  0 0 1  0 0 1  0 0 1 ]"},
        {"point2 uv", kRendered, "", "[ 0 0  1 0  0 1  1 1 ]"},
        {"string emissionfilename", kNoted, "patches do not sample an image",
         "\"format-image.pfm\""},
        {"integer faceIndices", kNoted, kPtex, "[ 0 ]"},
        {"float|texture alpha", kRendered}}},
      {"Shape",
       "plymesh",
       kRendered,
       "",
       {{"string filename", kRendered, "", "\"format-mesh.ply\"", true},
        {"texture displacement", kRendered},
        {"float edgelength", kNoted, "pbrt-v4 has no such parameter"},
        {"float displacement.edgelength", kRendered},
        {"float displacement.uvscale", kNoted, "pbrt-v4 has no such parameter"},
        {"float|texture alpha", kRendered}}},
      {"Shape",
       "loopsubdiv",
       kRendered,
       "",
       {{"point3 P", kRendered, "", kQuad, true},
        {"integer indices", kRendered, "", "[ 0 1 2 ]", true},
        {"integer levels", kRendered},
        {"string scheme", kRendered, "", "\"loop\""},
        {"float|texture alpha", kRendered}}},
      {"Shape",
       "curve",
       kRefused,
       "hair and curves are not in this renderer; a mesh can stand for them",
       {{"point3 P", kRefused, "", "[ 0 0 0  0 1 0  0 2 0  0 3 0 ]", true},
        {"string basis", kRefused, "", "\"bezier\""},
        {"integer degree", kRefused, "", "3"},
        {"string type", kRefused, "", "\"flat\""},
        {"normal N", kRefused, "", "[ 0 0 1  0 0 1 ]"},
        {"float width", kRefused},
        {"float width0", kRefused},
        {"float width1", kRefused},
        {"integer splitdepth", kRefused},
        {"float|texture alpha", kRefused}}},
  };
}

}  // namespace

FormatTable ShapeFormat() {
  FormatTable table = Quadrics();
  for (FormatObject& mesh : Meshes()) table.push_back(std::move(mesh));
  return table;
}

}  // namespace lanelight
