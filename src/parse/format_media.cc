// Participating media.
#include "src/parse/format.h"

namespace lanelight {
namespace {

using enum FormatStatus;
using Lines = std::vector<FormatLine>;

constexpr const char* kEight = "[ 0 1 0 1  1 0 1 0 ]";
constexpr const char* kColors =
    "[ 0 1 0  1 1 0  1 0 0  0 1 1  0 0 0  1 1 1  0 0 1  1 0 1 ]";

Lines Grid(Lines lines, FormatStatus s) {
  const Lines size = {{"integer nx", s, "", "2", true},
                      {"integer ny", s, "", "2", true},
                      {"integer nz", s, "", "2", true},
                      {"point3 p0", s, "", "[ -1 -1 -1 ]"},
                      {"point3 p1", s, "", "[ 1 1 1 ]"}};
  lines.insert(lines.end(), size.begin(), size.end());
  return lines;
}

Lines Temperature(Lines lines, FormatStatus s) {
  const Lines more = {{"float temperaturescale", s},
                      {"float temperatureoffset", s},
                      {"float temperaturecutoff", s}};
  lines.insert(lines.end(), more.begin(), more.end());
  return lines;
}

Lines Coefficients(Lines lines, FormatStatus s) {
  const Lines more = {{"rgb|spectrum sigma_a", s},
                      {"rgb|spectrum sigma_s", s},
                      {"float scale", s},
                      {"float g", s}};
  lines.insert(lines.end(), more.begin(), more.end());
  return lines;
}

}  // namespace

FormatTable MediumFormat() {
  constexpr FormatStatus kYes = kRendered;
  return {
      {"MakeNamedMedium", "homogeneous", kYes, "",
       Coefficients({{"string preset", kYes, "", "\"Wholemilk\""},
                     {"rgb|spectrum|blackbody Le", kYes},
                     {"float Lescale", kYes}},
                    kYes)},
      {"MakeNamedMedium", "uniformgrid", kYes, "",
       Coefficients(Temperature(Grid({{"float density", kYes, "", kEight, true},
                                      {"float temperature", kYes, "", kEight},
                                      {"rgb|spectrum|blackbody Le", kYes},
                                      {"float Lescale", kYes, "", kEight}},
                                     kYes),
                                kYes),
                    kYes)},
      {"MakeNamedMedium", "rgbgrid", kYes, "",
       Grid({{"rgb sigma_a", kYes, "", kColors, true},
             {"rgb sigma_s", kYes, "", kColors},
             {"rgb Le", kYes, "", kColors},
             {"float Lescale", kYes},
             {"float scale", kYes},
             {"float g", kYes}},
            kYes)},
      {"MakeNamedMedium",
       "cloud",
       kYes,
       "",
       {{"rgb|spectrum sigma_a", kYes},
        {"rgb|spectrum sigma_s", kYes},
        {"float g", kYes},
        {"float density", kYes},
        {"float wispiness", kYes},
        {"float frequency", kYes},
        {"point3 p0", kYes, "", "[ -1 -1 -1 ]"},
        {"point3 p1", kYes, "", "[ 1 1 1 ]"}}},
      {"MakeNamedMedium", "nanovdb", kYes, "",
       Coefficients(
           Temperature({{"string filename", kYes, "", "\"format-cloud.nvdb\"", true},
                        {"string gridname", kYes, "", "\"density\""},
                        {"string temperaturename", kYes, "", "\"temperature\""},
                        {"float Lescale", kYes},
                        {"float LeScale", kYes}},
                       kYes),
           kYes)},
  };
}

}  // namespace lanelight
