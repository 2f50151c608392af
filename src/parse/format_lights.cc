// Lights.
#include "src/parse/format.h"

namespace lanelight {

FormatTable LightFormat() {
  using enum FormatStatus;
  const FormatLine scale = {"float scale", kRendered};
  const FormatLine power = {"float power", kRendered};
  const FormatLine from = {"point3 from", kRendered, "", "[ 0 3 0 ]"};
  const FormatLine to = {"point3 to", kRendered, "", "[ 0 -1 2 ]"};
  const FormatLine intensity = {"rgb|spectrum|blackbody I", kRendered};
  const FormatLine radiance = {"rgb|spectrum|blackbody L", kRendered};
  return {
      {"LightSource", "point", kRendered, "", {intensity, from, scale, power}},
      {"LightSource",
       "spot",
       kRendered,
       "",
       {intensity,
        from,
        to,
        {"float coneangle", kRendered, "", "40"},
        {"float conedeltaangle", kRendered, "", "10"},
        scale,
        power}},
      {"LightSource",
       "distant",
       kRendered,
       "",
       {radiance, from, to, {"float illuminance", kRendered}, scale}},
      {"LightSource",
       "infinite",
       kRendered,
       "",
       {radiance,
        {"string filename", kRendered, "", "\"format-image.pfm\""},
        {"float illuminance", kRendered},
        scale,
        {"point3 portal", kRendered, "", "[ -1 2 -1  1 2 -1  1 2 1  -1 2 1 ]"}}},
      {"LightSource",
       "goniometric",
       kRendered,
       "",
       {{"string filename", kRendered, "", "\"format-image.pfm\"", true},
        {"rgb|spectrum|blackbody I", kRendered},
        {"float scale", kRendered},
        {"float power", kRendered}}},
      {"LightSource",
       "projection",
       kRendered,
       "",
       {{"string filename", kRendered, "", "\"format-image.pfm\"", true},
        {"float fov", kRendered, "", "40"},
        {"float scale", kRendered},
        {"float power", kRendered}}},
      {"AreaLightSource",
       "diffuse",
       kRendered,
       "",
       {radiance,
        scale,
        power,
        {"bool twosided", kRendered},
        {"string filename", kRendered, "", "\"format-image.pfm\""}}},
  };
}

}  // namespace lanelight
