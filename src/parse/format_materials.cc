// Materials.
#include "src/parse/format.h"

namespace lanelight {
namespace {

using enum FormatStatus;
using Lines = std::vector<FormatLine>;

constexpr const char* kDispersion = "dispersion is not modelled: eta at 587.6 nm";
constexpr const char* kGlass = "\"glass-BK7\"";

// Of all materials.
constexpr const char* kImage = "\"format-image.pfm\"";

Lines Relief(Lines lines) {
  lines.push_back({"float|texture displacement", kRendered});
  lines.push_back({"string normalmap", kRendered, "", kImage});
  return lines;
}

Lines NoRelief(Lines lines) {
  constexpr const char* kWhy = "it has no relief of its own";
  lines.push_back({"float|texture displacement", kNoted, kWhy});
  lines.push_back({"string normalmap", kNoted, kWhy, kImage});
  return lines;
}

Lines Roughness(Lines lines, const char* both, const char* u, const char* v,
                FormatStatus status, const char* why = "") {
  for (const char* name : {both, u, v}) lines.push_back({name, status, why});
  return lines;
}

Lines Rough(Lines lines) {
  lines.push_back({"bool remaproughness", kRendered, "", "false"});
  return Relief(Roughness(std::move(lines), "float|texture roughness",
                          "float|texture uroughness", "float|texture vroughness",
                          kRendered));
}

// Of a coat or the metal below it, with its prefix; literals live as long as the table.
Lines CoatRoughness(Lines lines, const std::string& prefix) {
  if (prefix == "interface.") {
    lines =
        Roughness(std::move(lines), "float interface.roughness",
                  "float interface.uroughness", "float interface.vroughness", kRendered);
    return Roughness(std::move(lines), "texture interface.roughness",
                     "texture interface.uroughness", "texture interface.vroughness",
                     kRendered);
  }
  if (prefix == "conductor.") {
    lines =
        Roughness(std::move(lines), "float conductor.roughness",
                  "float conductor.uroughness", "float conductor.vroughness", kRendered);
    return Roughness(std::move(lines), "texture conductor.roughness",
                     "texture conductor.uroughness", "texture conductor.vroughness",
                     kRendered);
  }
  lines = Roughness(std::move(lines), "float roughness", "float uroughness",
                    "float vroughness", kRendered);
  return Roughness(std::move(lines), "texture roughness", "texture uroughness",
                   "texture vroughness", kRendered);
}

Lines Coat(Lines lines) {
  const Lines coat = {{"float thickness", kRendered},
                      {"texture thickness", kRendered},
                      {"float g", kRendered},
                      {"texture g", kRendered},
                      {"rgb|spectrum albedo", kRendered},
                      {"texture albedo", kRendered},
                      {"integer maxdepth", kRendered},
                      {"integer nsamples", kNoted, "one walk a path"}};
  lines.insert(lines.end(), coat.begin(), coat.end());
  return lines;
}

FormatTable Plain() {
  const FormatLine reflectance = {"rgb|spectrum|texture reflectance", kRendered};
  return {
      {"Material", "diffuse", kRendered, "",
       Relief({reflectance, {"string scattering", kRendered, "", "\"uniform\""}})},
      {"Material", "diffusetransmission", kRendered, "",
       Relief({reflectance,
               {"rgb|spectrum transmittance", kRendered},
               {"texture transmittance", kRendered},
               {"float scale", kRendered}})},
      {"Material", "dielectric", kRendered, "",
       Rough({{"float eta", kRendered, "", "1.3"},
              {"spectrum eta", kNoted, kDispersion, kGlass}})},
      {"Material", "thindielectric", kRendered, "",
       Relief({{"float eta", kRendered, "", "1.3"},
               {"spectrum eta", kNoted, kDispersion, kGlass}})},
      {"Material", "conductor", kRendered, "",
       Rough({{"rgb|spectrum eta", kRendered},
              {"texture eta", kRendered},
              {"rgb|spectrum k", kRendered},
              {"texture k", kRendered},
              {"rgb|spectrum reflectance", kRendered},
              {"texture reflectance", kRendered}})},
      {"Material", "interface", kRendered, "", NoRelief({})},
      {"Material", "mix", kRendered, "",
       NoRelief({{"string materials", kRendered, "", "[ \"first\" \"second\" ]", true},
                 {"float|texture amount", kRendered}})},
  };
}

FormatTable Coated() {
  const Lines metal = {{"rgb|spectrum conductor.eta", kRendered},
                       {"texture conductor.eta", kRendered},
                       {"rgb|spectrum conductor.k", kRendered},
                       {"texture conductor.k", kRendered},
                       {"rgb|spectrum reflectance", kRendered},
                       {"texture reflectance", kRendered},
                       {"float interface.eta", kRendered, "", "1.3"},
                       {"spectrum interface.eta", kNoted, kDispersion, kGlass},
                       {"bool remaproughness", kRendered, "", "false"}};
  return {
      {"Material", "coateddiffuse", kRendered, "",
       CoatRoughness(Relief(Coat({{"rgb|spectrum|texture reflectance", kRendered},
                                  {"float eta", kRendered, "", "1.3"},
                                  {"spectrum eta", kNoted, kDispersion, kGlass},
                                  {"bool remaproughness", kRendered, "", "false"}})),
                     "")},
      {"Material", "coatedconductor", kRendered, "",
       CoatRoughness(CoatRoughness(Relief(Coat(metal)), "interface."), "conductor.")},
  };
}

FormatTable Foreign() {
  return {
      {"Material",
       "hair",
       kRefused,
       "hair and curves are not in this renderer",
       {{"rgb|spectrum|texture sigma_a", kRefused},
        {"rgb|spectrum|texture reflectance", kRefused},
        {"rgb|spectrum|texture color", kRefused},
        {"float|texture eumelanin", kRefused},
        {"float|texture pheomelanin", kRefused},
        {"float|texture eta", kRefused},
        {"float|texture beta_m", kRefused},
        {"float|texture beta_n", kRefused},
        {"float|texture alpha", kRefused}}},
      {"Material",
       "measured",
       kRefused,
       "measured BRDFs are not in this renderer",
       {{"string filename", kRefused, "", "\"a.bsdf\"", true}}},
      {"Material",
       "subsurface",
       kRefused,
       "light that leaves a surface elsewhere than it entered is not in this renderer; "
       "\"dielectric\" around a medium is the same in full",
       {{"rgb|spectrum|texture mfp", kRefused},
        {"string name", kRefused, "", "\"Skin1\""},
        {"rgb|spectrum|texture sigma_a", kRefused},
        {"rgb|spectrum|texture sigma_s", kRefused},
        {"rgb|spectrum|texture reflectance", kRefused},
        {"float scale", kRefused},
        {"float eta", kRefused},
        {"float g", kRefused},
        {"float|texture roughness", kRefused},
        {"float|texture uroughness", kRefused},
        {"float|texture vroughness", kRefused},
        {"bool remaproughness", kRefused}}},
  };
}

}  // namespace

FormatTable MaterialFormat() {
  FormatTable table;
  for (const auto part : {Plain, Coated, Foreign}) {
    for (FormatObject& object : part()) table.push_back(std::move(object));
  }
  return table;
}

}  // namespace lanelight
