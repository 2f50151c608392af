// Textures.
#include "src/parse/format.h"

namespace lanelight {
namespace {

using enum FormatStatus;
using Lines = std::vector<FormatLine>;

// Of all textures that are looked up by surface coordinates.
Lines Mapped(Lines lines) {
  const Lines mapping = {{"string mapping", kRendered, "", "\"uv\""},
                         {"string mapping", kRendered, "", "\"spherical\""},
                         {"string mapping", kRendered, "", "\"cylindrical\""},
                         {"string mapping", kRendered, "", "\"planar\""},
                         {"float uscale", kRendered},
                         {"float vscale", kRendered},
                         {"float udelta", kRendered},
                         {"float vdelta", kRendered},
                         {"vector3 v1", kRendered, "", "[ 1 0 0 ]"},
                         {"vector3 v2", kRendered, "", "[ 0 1 0 ]"}};
  lines.insert(lines.end(), mapping.begin(), mapping.end());
  return lines;
}

FormatLine Operand(const char* name, FormatStatus status = kRendered) {
  return {name, status};
}

FormatTable Images() {
  return {
      {"Texture", "constant", kRendered, "", {Operand("float|rgb|spectrum value")}},
      {"Texture",
       "scale",
       kRendered,
       "",
       {Operand("float|rgb|spectrum|texture tex"), Operand("float|texture scale")}},
      {"Texture",
       "mix",
       kRendered,
       "",
       {Operand("float|rgb|spectrum|texture tex1"),
        Operand("float|rgb|spectrum|texture tex2"), Operand("float|texture amount")}},
      {"Texture", "checkerboard", kRendered, "",
       Mapped({Operand("float|rgb|spectrum|texture tex1"),
               Operand("float|rgb|spectrum|texture tex2"),
               {"integer dimension", kRendered, "", "2"},
               {"integer dimension", kRendered, "", "3"}})},
      {"Texture", "imagemap", kRendered, "",
       Mapped({{"string filename", kRendered, "", "\"format-image.pfm\"", true},
               {"string wrap", kRendered, "", "\"clamp\""},
               {"string filter", kRendered, "", "\"point\""},
               {"string filter", kRendered, "", "\"bilinear\""},
               {"string filter", kRendered, "", "\"trilinear\""},
               {"string filter", kRendered, "", "\"ewa\""},
               {"float maxanisotropy", kRendered, "", "4"},
               {"string encoding", kRendered, "", "\"linear\""},
               {"float scale", kRendered},
               {"bool invert", kRendered}})},
  };
}

FormatTable Patterns() {
  const FormatLine octaves = {"integer octaves", kRendered};
  const FormatLine roughness = {"float roughness", kRendered};
  return {
      {"Texture",
       "directionmix",
       kRendered,
       "",
       {Operand("float|rgb|spectrum|texture tex1", kRendered),
        Operand("float|rgb|spectrum|texture tex2", kRendered),
        {"vector3 dir", kRendered, "", "[ 0 0 1 ]"}}},
      {"Texture", "bilerp", kRendered, "",
       Mapped({Operand("float|rgb|spectrum v00", kRendered),
               Operand("float|rgb|spectrum v01", kRendered),
               Operand("float|rgb|spectrum v10", kRendered),
               Operand("float|rgb|spectrum v11", kRendered)})},
      {"Texture", "dots", kRendered, "",
       Mapped({Operand("float|rgb|spectrum|texture inside", kRendered),
               Operand("float|rgb|spectrum|texture outside", kRendered)})},
      {"Texture", "fbm", kRendered, "", {octaves, roughness}},
      {"Texture", "wrinkled", kRendered, "", {octaves, roughness}},
      {"Texture", "windy", kRendered, "", {}},
      {"Texture",
       "marble",
       kRendered,
       "",
       {octaves, roughness, {"float scale", kRendered}, {"float variation", kRendered}}},
      {"Texture",
       "ptex",
       kRefused,
       "textures per face (Ptex files) are not in this renderer; an image with "
       "surface coordinates can stand for one",
       {{"string filename", kRefused, "", "\"a.ptex\"", true},
        {"string encoding", kRefused, "", "\"linear\""},
        {"float scale", kRefused}}},
  };
}

}  // namespace

FormatTable TextureFormat() {
  FormatTable table = Images();
  for (FormatObject& object : Patterns()) table.push_back(std::move(object));
  return table;
}

}  // namespace lanelight
