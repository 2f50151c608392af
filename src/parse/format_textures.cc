// Textures.
#include "src/parse/format.h"

namespace lanelight {
namespace {

using enum FormatStatus;
using Lines = std::vector<FormatLine>;

// Of all textures that are looked up by surface coordinates.
Lines Mapped(Lines lines) {
  const Lines mapping = {{"string mapping", kRendered, "", "\"uv\""},
                         {"string mapping", kRefused, "", "\"spherical\""},
                         {"string mapping", kRefused, "", "\"cylindrical\""},
                         {"string mapping", kRefused, "", "\"planar\""},
                         {"float uscale", kRendered},
                         {"float vscale", kRendered},
                         {"float udelta", kRendered},
                         {"float vdelta", kRendered},
                         {"vector3 v1", kRefused, "", "[ 1 0 0 ]"},
                         {"vector3 v2", kRefused, "", "[ 0 1 0 ]"}};
  lines.insert(lines.end(), mapping.begin(), mapping.end());
  return lines;
}

FormatLine Operand(const char* name, FormatStatus status = kRendered) {
  return {name, status};
}

FormatTable Rendered() {
  constexpr const char* kBilinear = "taken as `bilinear`";
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
               {"integer dimension", kRefused, "", "3"}})},
      {"Texture", "imagemap", kRendered, "",
       Mapped({{"string filename", kRendered, "", "\"format-image.pfm\"", true},
               {"string wrap", kRendered, "", "\"clamp\""},
               {"string filter", kRendered, "", "\"point\""},
               {"string filter", kRendered, "", "\"bilinear\""},
               {"string filter", kNoted, kBilinear, "\"trilinear\""},
               {"string filter", kNoted, kBilinear, "\"ewa\""},
               {"float maxanisotropy", kNoted, "there is no anisotropic filter"},
               {"string encoding", kRendered, "", "\"linear\""},
               {"float scale", kRendered},
               {"bool invert", kRendered}})},
  };
}

FormatTable Refused() {
  const FormatLine octaves = {"integer octaves", kRefused};
  const FormatLine roughness = {"float roughness", kRefused};
  return {
      {"Texture",
       "directionmix",
       kRefused,
       "",
       {Operand("float|rgb|spectrum|texture tex1", kRefused),
        Operand("float|rgb|spectrum|texture tex2", kRefused),
        {"vector3 dir", kRefused, "", "[ 0 0 1 ]"}}},
      {"Texture", "bilerp", kRefused, "",
       Mapped({Operand("float|rgb|spectrum v00", kRefused),
               Operand("float|rgb|spectrum v01", kRefused),
               Operand("float|rgb|spectrum v10", kRefused),
               Operand("float|rgb|spectrum v11", kRefused)})},
      {"Texture", "dots", kRefused, "",
       Mapped({Operand("float|rgb|spectrum|texture inside", kRefused),
               Operand("float|rgb|spectrum|texture outside", kRefused)})},
      {"Texture", "fbm", kRefused, "", {octaves, roughness}},
      {"Texture", "wrinkled", kRefused, "", {octaves, roughness}},
      {"Texture", "windy", kRefused, "", {}},
      {"Texture",
       "marble",
       kRefused,
       "",
       {octaves, roughness, {"float scale", kRefused}, {"float variation", kRefused}}},
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
  FormatTable table = Rendered();
  for (FormatObject& object : Refused()) {
    for (FormatLine& line : object.lines) line.status = kRefused;
    table.push_back(std::move(object));
  }
  return table;
}

}  // namespace lanelight
