#include "tests/scene/parse/format_scenes.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <set>

#include "src/base/core/error.h"
#include "src/scene/compile/compile.h"
#include "src/scene/compiled/scene.h"
#include "src/scene/parse/parse.h"
#include "tests/base/image/sparse_grid_file.h"
#include "tests/reference/measured.h"
#include "tests/scene/parse/format_values.h"

namespace lanelight {
namespace {

const std::set<std::string> kBeforeWorld = {"Camera",  "Film",          "PixelFilter",
                                            "Sampler", "Integrator",    "Accelerator",
                                            "Option",  "TransformTimes"};

// The objects that the tested object may refer to.
constexpr const char* kWorld = R"(
Shape "sphere"
LightSource "point" "point3 from" [ 0 2 -2 ]
Texture "tex" "float" "checkerboard" "float tex1" 0.4 "float tex2" 0.5
Texture "tex" "spectrum" "checkerboard" "rgb tex1" [ 0.5 0.4 0.3 ] "rgb tex2" [ 0.4 0.4 0.3 ]
MakeNamedMaterial "first" "string type" "diffuse"
MakeNamedMaterial "second" "string type" "conductor"
)";

std::string ParameterText(const FormatParameter& parameter) {
  return " \"" + parameter.typed + "\" " + parameter.value;
}

// `object` with its operands, and what makes it part of the picture.
std::string Statement(const FormatObject& object, const std::string& params,
                      const std::string& value_type) {
  const std::string &directive = object.directive, &type = object.type;
  const std::string quoted = " \"" + type + "\"";
  if (directive == "Texture") {
    const std::string use = value_type == "float"
                                ? "\nMaterial \"conductor\" \"texture roughness\" \"t\""
                                  "\nShape \"sphere\""
                                : "\nMaterial \"diffuse\" \"texture reflectance\" \"t\""
                                  "\nShape \"sphere\"";
    return "Texture \"t\" \"" + value_type + "\"" + quoted + params + use;
  }
  if (directive == "MakeNamedMedium") {
    return "MakeNamedMedium \"m\" \"string type\"" + quoted + params +
           "\nMaterial \"interface\"\nMediumInterface \"m\" \"\"\nShape \"sphere\"";
  }
  const bool shown = directive == "Material" || directive == "AreaLightSource";
  return directive + quoted + params + (shown ? "\nShape \"sphere\"" : "");
}

std::string Scene(const std::string& directive, const std::string& statement) {
  const bool early = kBeforeWorld.contains(directive);
  std::string text = "LookAt 0 0 -5 0 0 0 0 1 0\n";
  if (directive != "Camera") text += "Camera \"perspective\"\n";
  if (directive != "Film")
    text += "Film \"rgb\" \"integer xresolution\" 4 \"integer yresolution\" 4\n";
  if (directive == "WorldBegin") return text + statement + kWorld;
  return text + (early ? statement : "") + "\nWorldBegin" + kWorld +
         (early ? "" : statement) + "\n";
}

}  // namespace

std::vector<std::string> TypedParameters(const FormatLine& line) {
  const std::string text = line.parameter;
  const std::string types = text.substr(0, text.find(' '));
  std::vector<std::string> typed;
  for (std::size_t at = 0; at <= types.size();) {
    const std::size_t end = std::min(types.find('|', at), types.size());
    typed.push_back(types.substr(at, end - at) + text.substr(text.find(' ')));
    at = end + 1;
  }
  return typed;
}

std::string ParameterName(const std::string& parameter) {
  return parameter.substr(parameter.find_last_of(' ') + 1);
}

std::string FormatScene(const FormatObject& object, const FormatParameter& parameter,
                        const std::string& extra, const std::string& value_type) {
  std::string params;
  for (const std::string& needed : NeededParameters(object)) {
    if (ParameterName(needed) == ParameterName(parameter.typed)) continue;
    params += ParameterText({needed, FormatValues(object, {}, needed).front()});
  }
  if (!parameter.typed.empty()) params += ParameterText(parameter);
  return Scene(object.directive, Statement(object, params + extra, value_type));
}

std::string OperandScene(const FormatObject& object, const FormatLine& line) {
  const std::string& directive = object.directive;
  if (directive == "Option") {
    const std::string value = FormatValues(object, line, line.parameter).front();
    return Scene(directive, directive + ParameterText({line.parameter, value}));
  }
  std::string value = FormatOperands(object, line);
  const std::size_t at = value.find('@');
  if (at == value.npos) return Scene(directive, directive + " " + value);
  return Scene(directive, value.replace(at, 1, directive));
}

void WriteFormatFiles(const std::string& folder) {
  std::ofstream(folder + "/format-part.pbrt") << "Shape \"sphere\"\n";
  std::ofstream image(folder + "/format-image.pfm", std::ios::binary);
  image << "PF\n2 2\n-1.0\n";
  const std::vector<float> ones(12, 1.0f);
  image.write(reinterpret_cast<const char*>(ones.data()), 48);
  std::ofstream(folder + "/format-mesh.ply")
      << "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
         "property float z\nproperty float u\nproperty float v\nelement face 1\n"
         "property list uchar int vertex_indices\n"
         "end_header\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n";
  // A double Gauss of two elements would do as well: curvature, thickness, eta, aperture.
  std::ofstream(folder + "/format-lens.dat") << "50 5 1.5 20\n-50 0 1 20\n";
  std::ofstream(folder + "/format-measured.bsdf", std::ios::binary)
      << reference::MeasuredFile(reference::ChalkModel(0.5));
  test::SparseFileGrid cloud;
  cloud.value = [](int, int, int) { return 1.0f; };
  test::WriteSparseFile(folder + "/format-cloud.nvdb", {cloud});
}

FormatOutcome RunFormatScene(const std::string& text, const std::string& folder) {
  FormatOutcome outcome;
  try {
    const SceneDescription scene = ParseSceneText(text, "format.pbrt", folder);
    for (const Note& note : scene.notes) outcome.notes.push_back(note.message);
    const CompiledScene compiled = CompileScene(scene);
    for (const Note& note : compiled.notes) outcome.notes.push_back(note.message);
  } catch (const InputError& error) {
    outcome.error = error.what();
  }
  std::sort(outcome.notes.begin(), outcome.notes.end());
  return outcome;
}

}  // namespace lanelight
