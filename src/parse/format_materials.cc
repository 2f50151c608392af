// Materials.
#include "src/parse/format.h"

namespace lanelight {
namespace {

using enum FormatStatus;
using Lines = std::vector<FormatLine>;

constexpr const char* kDispersion = "dispersion is not modelled: eta at 587.6 nm";
constexpr const char* kGlass = "\"glass-BK7\"";

// Of all materials.
Lines Relief(Lines lines) {
  lines.push_back(
      {"float|texture displacement", kNoted, "displacement is not supported"});
  lines.push_back(
      {"string normalmap", kNoted, "normal maps are not supported", "\"n.png\""});
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
  constexpr const char* kWhy = "cannot be textured below or in a coat";
  if (prefix == "interface.") {
    lines =
        Roughness(std::move(lines), "float interface.roughness",
                  "float interface.uroughness", "float interface.vroughness", kRendered);
    return Roughness(std::move(lines), "texture interface.roughness",
                     "texture interface.uroughness", "texture interface.vroughness",
                     kRefused, kWhy);
  }
  if (prefix == "conductor.") {
    lines =
        Roughness(std::move(lines), "float conductor.roughness",
                  "float conductor.uroughness", "float conductor.vroughness", kRendered);
    return Roughness(std::move(lines), "texture conductor.roughness",
                     "texture conductor.uroughness", "texture conductor.vroughness",
                     kRefused, kWhy);
  }
  lines = Roughness(std::move(lines), "float roughness", "float uroughness",
                    "float vroughness", kRendered);
  return Roughness(std::move(lines), "texture roughness", "texture uroughness",
                   "texture vroughness", kRefused, kWhy);
}

Lines Coat(Lines lines) {
  const Lines coat = {{"float thickness", kRendered},
                      {"texture thickness", kRefused, "cannot be textured"},
                      {"float g", kRendered},
                      {"texture g", kRefused, "cannot be textured"},
                      {"rgb albedo", kRendered, "", "[ 0 0 0 ]"},
                      {"rgb|spectrum albedo", kRefused, "a coat that scatters"},
                      {"texture albedo", kRefused, "cannot be textured"},
                      {"integer maxdepth", kRendered},
                      {"integer nsamples", kRendered}};
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
               {"texture transmittance", kRefused, ""},
               {"float scale", kRendered}})},
      {"Material", "dielectric", kRendered, "",
       Rough({{"float eta", kRendered, "", "1.3"},
              {"spectrum eta", kNoted, kDispersion, kGlass}})},
      {"Material", "thindielectric", kRendered, "",
       Relief({{"float eta", kRendered, "", "1.3"},
               {"spectrum eta", kNoted, kDispersion, kGlass}})},
      {"Material", "conductor", kRendered, "",
       Rough({{"rgb|spectrum eta", kRendered},
              {"texture eta", kRefused, ""},
              {"rgb|spectrum k", kRendered},
              {"texture k", kRefused, ""},
              {"rgb|spectrum reflectance", kRendered},
              {"texture reflectance", kRefused, ""}})},
      {"Material", "interface", kRendered, "", Relief({})},
      {"Material", "mix", kRendered, "",
       Relief({{"string materials", kRendered, "", "[ \"first\" \"second\" ]", true},
               {"float|texture amount", kRendered}})},
  };
}

FormatTable Coated() {
  const Lines metal = {{"rgb|spectrum conductor.eta", kRendered},
                       {"texture conductor.eta", kRefused, ""},
                       {"rgb|spectrum conductor.k", kRendered},
                       {"texture conductor.k", kRefused, ""},
                       {"rgb|spectrum reflectance", kRendered},
                       {"texture reflectance", kRefused, ""},
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
