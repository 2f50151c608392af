#include "tests/scene/parse/format_values.h"

#include <map>

namespace lanelight {
namespace {

using Values = std::vector<std::string>;

constexpr const char* kImage = "\"format-image.pfm\"";
constexpr const char* kQuad = "[ -1 -1 0  1 -1 0  -1 1 0  1 1 0 ]";
constexpr const char* kTwisted = "[ -1 -1 0  1 -1 1  -1 1 1  1 1 0 ]";
constexpr const char* kTriangle = "[ 0 1 2 ]";
constexpr const char* kEight = "[ 0 1 0 1  1 0 1 0 ]";
constexpr const char* kColors =
    "[ 0 1 0  1 1 0  1 0 0  0 1 1  0 0 0  1 1 1  0 0 1  1 0 1 ]";
constexpr const char* kMatrix = "[ 1 0 0 0  0 1 0 0  0 0 2 0  0 0 0 1 ]";

const std::map<std::string, std::string> kOfTypes = {
    {"bool", "true"},
    {"integer", "2"},
    {"float", "0.5"},
    {"rgb", "[ 0.2 0.3 0.4 ]"},
    {"spectrum", "[ 400 0.2 700 0.4 ]"},
    {"blackbody", "3000"},
    {"string", "\"linear\""},
    {"point3", kQuad},
    {"normal", "[ 0 0 1  0 0 1  0 0 1  0 0 1 ]"},
    {"texture", "\"tex\""}};

// By "directive type name", else by the parameter alone.
const std::map<std::string, Values> kValues = {
    {"float fov", {"40"}},
    {"float frameaspectratio", {"1.5"}},
    {"float screenwindow", {"[ -1 1 -0.5 1 ]"}},
    {"float lensradius", {"0.1"}},
    {"float focaldistance", {"5"}},
    {"float shutterclose", {"2"}},
    {"Camera spherical mapping", {"\"equirectangular\""}},
    {"string lensfile", {"\"format-lens.dat\""}},
    {"float aperturediameter", {"5"}},
    {"float focusdistance", {"5"}},
    {"string aperture", {"\"gaussian\""}},
    {"integer xresolution", {"3"}},
    {"integer yresolution", {"3"}},
    {"float cropwindow", {"[ 0 0.5 0 1 ]"}},
    {"integer pixelbounds", {"[ 0 2 0 2 ]"}},
    {"Film rgb filename", {"\"image.exr\""}},
    {"Film gbuffer filename", {"\"image.exr\""}},
    {"Film spectral filename", {"\"image.exr\""}},
    {"integer nbuckets", {"4"}},
    {"float lambdamin", {"370"}},
    {"float lambdamax", {"800"}},
    {"float iso", {"200"}},
    {"bool savefp16", {"false"}},
    {"float whitebalance", {"5000"}},
    {"float maxcomponentvalue", {"10"}},
    {"string coordinatesystem", {"\"camera\""}},
    {"float tau", {"2"}},
    {"string randomization", {"\"none\""}},
    {"bool jitter", {"false"}},
    {"string lightsampler", {"\"uniform\"", "\"power\""}},
    {"string strategy", {"\"points=halton\""}},
    {"string transport", {"\"spectral\""}},
    {"string function", {"\"step\""}},
    {"string splitmethod", {"\"middle\""}},
    {"string rendercoordsys", {"\"world\""}},
    {"float zmin", {"-0.5"}},
    {"float zmax", {"0.5"}},
    {"float innerradius", {"0.25"}},
    {"float phimax", {"180"}},
    {"integer indices", {kTriangle}},
    {"Shape curve P", {kQuad}},
    {"Shape curve N", {"[ 0 0 1  0 1 0 ]"}},
    {"integer splitdepth", {"2"}},
    {"integer degree", {"3"}},
    {"float eumelanin", {"0.4"}},
    {"float width", {"0.1"}},
    {"Shape bilinearmesh P", {kQuad, kTwisted}},
    {"Shape bilinearmesh indices", {"[ 0 1 2 3 ]"}},
    {"vector3 S", {"[ 1 0 0  1 0 0  1 0 0  1 0 0 ]"}},
    {"point2 uv", {"[ 0 0  1 0  0 1  1 1 ]"}},
    {"integer faceIndices", {"[ 0 ]"}},
    {"string emissionfilename", {kImage}},
    {"Shape plymesh filename", {"\"format-mesh.ply\""}},
    {"string scheme", {"\"loop\""}},
    {"point3 from", {"[ 0 3 0 ]"}},
    {"point3 to", {"[ 0 -1 2 ]"}},
    {"float coneangle", {"40"}},
    {"float conedeltaangle", {"10"}},
    {"string filename", {kImage}},
    {"point3 portal", {"[ -1 2 -1  1 2 -1  1 2 1  -1 2 1 ]"}},
    {"string normalmap", {kImage}},
    {"string scattering", {"\"uniform\""}},
    {"bool remaproughness", {"false"}},
    {"float eta", {"1.3"}},
    {"float interface.eta", {"1.3"}},
    {"Material dielectric spectrum eta", {"\"glass-BK7\""}},
    {"Material thindielectric spectrum eta", {"\"glass-BK7\""}},
    {"Material coateddiffuse spectrum eta", {"\"glass-BK7\""}},
    {"spectrum interface.eta", {"\"glass-BK7\""}},
    {"string materials", {"[ \"first\" \"second\" ]"}},
    {"vector3 v1", {"[ 1 0 0 ]"}},
    {"vector3 v2", {"[ 0 1 0 ]"}},
    {"vector3 dir", {"[ 0 0 1 ]"}},
    {"string wrap", {"\"clamp\""}},
    {"float maxanisotropy", {"4"}},
    {"string preset", {"\"Wholemilk\""}},
    {"point3 p0", {"[ -1 -1 -1 ]"}},
    {"point3 p1", {"[ 1 1 1 ]"}},
    {"MakeNamedMedium uniformgrid density", {kEight}},
    {"float temperature", {kEight}},
    {"MakeNamedMedium uniformgrid Lescale", {kEight}},
    {"MakeNamedMedium rgbgrid sigma_a", {kColors}},
    {"MakeNamedMedium rgbgrid sigma_s", {kColors}},
    {"MakeNamedMedium rgbgrid Le", {kColors}},
    {"MakeNamedMedium nanovdb filename", {"\"format-cloud.nvdb\""}},
    {"Material measured filename", {"\"format-measured.bsdf\""}},
    {"string name", {"\"Skin1\""}},
    {"Material subsurface spectrum eta", {"\"glass-BK7\""}},
    {"string gridname", {"\"density\""}},
    {"string temperaturename", {"\"temperature\""}}};

// The operands of each directive.
const std::map<std::string, std::string> kOperands = {
    {"Translate x y z", "1 2 3"},
    {"Scale x y z", "1 2 3"},
    {"Rotate angle x y z", "30 0 1 0"},
    {"LookAt eye, target, up", "0 0 5 0 0 0 0 1 0"},
    {"Transform affine matrix", kMatrix},
    {"Transform projective matrix", "[ 1 0 0 0.5  0 1 0 0  0 0 1 0  0 0 0 1 ]"},
    {"ConcatTransform affine matrix", kMatrix},
    {"CoordinateSystem name", "\"here\""},
    {"CoordSysTransform name", "CoordinateSystem \"here\" @ \"here\""},
    {"TransformBegin ", "TransformEnd"},
    {"TransformEnd ", "TransformBegin @"},
    {"TransformTimes start end", "0 1"},
    {"WorldBegin ", "Identity"},
    {"AttributeBegin ", "AttributeEnd"},
    {"AttributeEnd ", "AttributeBegin @"},
    {"Attribute \"shape\"", "\"shape\" \"float radius\" 2"},
    {"Attribute \"light\"", "\"light\" \"float scale\" 2"},
    {"Attribute \"material\"", "\"material\" \"rgb reflectance\" [ 0.5 0 0 ]"},
    {"Attribute \"medium\"", "\"medium\" \"float g\" 0.5"},
    {"Attribute \"texture\"", "\"texture\" \"float uscale\" 2"},
    {"ObjectBegin name", "\"o\" ObjectEnd"},
    {"ObjectEnd ", "ObjectBegin \"o\" @"},
    {"ObjectInstance name", "ObjectBegin \"o\" Shape \"sphere\" ObjectEnd @ \"o\""},
    {"Include file", "\"format-part.pbrt\""},
    {"Import file", "\"format-part.pbrt\""},
    {"MakeNamedMaterial name, \"string type\", parameters of Material",
     "\"m\" \"string type\" \"diffuse\""},
    {"NamedMaterial name", "\"first\""},
    {"MediumInterface no names", "\"\" \"\""},
    {"MediumInterface names",
     "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" @ \"fog\" \"\""}};

const std::map<std::string, Values> kNeeded = {
    {"Camera realistic", {"string lensfile"}},
    {"Shape trianglemesh", {"point3 P", "integer indices"}},
    {"Shape bilinearmesh", {"point3 P"}},
    {"Shape curve", {"point3 P"}},
    {"Shape plymesh", {"string filename"}},
    {"Shape loopsubdiv", {"point3 P", "integer indices"}},
    {"LightSource goniometric", {"string filename"}},
    {"LightSource projection", {"string filename"}},
    {"Material mix", {"string materials"}},
    {"Material measured", {"string filename"}},
    {"Texture imagemap", {"string filename"}},
    {"MakeNamedMedium uniformgrid",
     {"float density", "integer nx", "integer ny", "integer nz"}},
    {"MakeNamedMedium rgbgrid",
     {"rgb sigma_a", "integer nx", "integer ny", "integer nz"}},
    {"MakeNamedMedium nanovdb", {"string filename"}}};

}  // namespace

std::vector<std::string> FormatValues(const FormatObject& object, const FormatLine& line,
                                      const std::string& parameter) {
  if (!line.value.empty()) return {line.value};
  const std::size_t space = parameter.find(' ');
  const std::string of = object.directive + " " + object.type + " ";
  for (const std::string& key :
       {of + parameter, of + parameter.substr(space + 1), parameter}) {
    const auto found = kValues.find(key);
    if (found != kValues.end()) return found->second;
  }
  return {kOfTypes.at(parameter.substr(0, space))};
}

std::string FormatOperands(const FormatObject& object, const FormatLine& line) {
  const auto found = kOperands.find(object.directive + " " + line.parameter);
  return found == kOperands.end() ? line.parameter : found->second;
}

std::vector<std::string> NeededParameters(const FormatObject& object) {
  const auto found = kNeeded.find(object.directive + " " + object.type);
  return found == kNeeded.end() ? Values() : found->second;
}

}  // namespace lanelight
