#include <algorithm>

#include "src/parse/interpret.h"
#include "src/core/suggest.h"

namespace lanelight {
namespace {

constexpr double kTiny = 1e-30;

const std::vector<std::string> kShapeNames = {"sphere",       "disk",    "cylinder",
                                              "trianglemesh", "plymesh", "bilinearmesh",
                                              "loopsubdiv",   "plane"};

void ReadPhi(ParamSet& params, Shape* shape) {
  shape->phi_max = std::min(params.Float("phimax", 360, 0, kHuge), 360.0);
}

// `most`: how far from the middle they can be. pbrt takes them in either order.
void ReadHeights(ParamSet& params, double absent, double most, Shape* shape) {
  const double a = std::clamp(params.Float("zmin", -absent), -most, most);
  const double b = std::clamp(params.Float("zmax", absent), -most, most);
  shape->z_min = std::min(a, b);
  shape->z_max = std::max(a, b);
}

// Nothing can be seen of a sphere, disk or cylinder of radius 0.
bool IsVisible(const Shape& shape) {
  return shape.kind == ShapeKind::kMesh || shape.kind == ShapeKind::kPlane ||
         shape.radius > 0;
}

void ReadSphere(ParamSet& params, Shape* shape) {
  shape->kind = ShapeKind::kSphere;
  shape->radius = params.Float("radius", 1, 0, kHuge);
  ReadHeights(params, shape->radius, shape->radius, shape);
  ReadPhi(params, shape);
}

void ReadCylinder(ParamSet& params, Shape* shape) {
  shape->kind = ShapeKind::kCylinder;
  shape->radius = params.Float("radius", 1, 0, kHuge);
  ReadHeights(params, 1, kHuge, shape);
  ReadPhi(params, shape);
}

void ReadDisk(ParamSet& params, Shape* shape) {
  shape->kind = ShapeKind::kDisk;
  shape->radius = params.Float("radius", 1, 0, kHuge);
  shape->inner_radius = params.Float("innerradius", 0, 0, kHuge);
  shape->height = params.Float("height", 0, -kHuge, kHuge);
  if (shape->inner_radius >= shape->radius && shape->radius > 0) {
    params.Fail(*params.Find("innerradius", {}),
                fmt::format("the inner radius {} is not below the radius {}",
                            shape->inner_radius, shape->radius));
  }
  ReadPhi(params, shape);
}

void ReadPly(ParseState& state, ParamSet& params) {
  const Param* file = params.Find("filename", {ParamType::kString});
  if (file == nullptr) {
    throw InputError(params.where(), "shape \"plymesh\" has no \"string filename\"");
  }
  const std::string name = params.String("filename", "");
  if (name.empty()) params.Fail(*file, "the file name is empty");
  MeshRequest request{ResolvePath(state, name), file->where, state.open_object,
                      state.OpenShapes().size()};
  if (params.Find("displacement", {ParamType::kTexture}) != nullptr) {
    const FloatValue height = TexturedFloat(state, params, "displacement", 0, 0, 0);
    request.displacement = height.texture;
  }
  for (const char* foreign : {"displacement.uvscale", "edgelength"}) {
    params.Ignore(foreign, "pbrt-v4 has no such parameter");
  }
  request.edge_length =
      params.Float("displacement.edgelength", 1, kTiny, kHuge) * state.edge_scale;
  state.meshes.push_back(std::move(request));
}

void ReadGeometry(ParseState& state, const std::string& type, ParamSet& params,
                  Shape* shape) {
  if (type == "sphere") return ReadSphere(params, shape);
  if (type == "disk") return ReadDisk(params, shape);
  if (type == "cylinder") return ReadCylinder(params, shape);
  if (type == "plane") {
    shape->kind = ShapeKind::kPlane;
    return;
  }
  shape->kind = ShapeKind::kMesh;
  if (type == "trianglemesh") {
    shape->mesh = InterpretTriangleMesh(params);
  } else if (type == "bilinearmesh") {
    shape->mesh = InterpretBilinearMesh(params);
  } else if (type == "loopsubdiv") {
    shape->mesh = InterpretLoopSubdivision(params);
  } else {
    ReadPly(state, params);
  }
}

Index CurrentMaterial(ParseState& state, const SourceLocation& where) {
  if (state.graphics.material != kNone) return state.graphics.material;
  if (state.default_material == kNone) {
    ParamSet defaults("material \"diffuse\"", where, {}, nullptr, &state.scene.notes);
    state.default_material = InterpretMaterial(state, "", "diffuse", defaults);
  }
  return state.default_material;
}

// pbrt lets these two cases pass without a light; so do we, and say so.
Index CurrentAreaLight(ParseState& state, const Shape& shape,
                       const SourceLocation& where) {
  const Index light = state.graphics.area_light;
  if (light == kNone) return kNone;
  if (state.open_object != kNone) {
    state.AddNote(where, "the area light has no effect inside an object definition");
    return kNone;
  }
  if (state.scene.materials[shape.material].kind == MaterialKind::kInterface) {
    state.AddNote(where,
                  "the area light has no effect on a shape with material "
                  "\"interface\"");
    return kNone;
  }
  if (shape.kind == ShapeKind::kPlane && state.scene.area_lights[light].power > 0) {
    throw InputError(where,
                     "an area light with \"power\" on a plane, whose area is infinite");
  }
  return light;
}

}  // namespace

void InterpretShape(ParseState& state, const std::string& type, ParamSet& params) {
  if (type == "curve") {
    return state.Unsupported(
        params.where(),
        fmt::format("shape \"curve\" is not supported, as hair and curves are not; "
                    "supported: {}",
                    QuotedList(kShapeNames)));
  }
  if (std::find(kShapeNames.begin(), kShapeNames.end(), type) == kShapeNames.end()) {
    ThrowUnknown(params.where(), "shape", type, kShapeNames);
  }
  Shape shape;
  shape.where = params.where();
  shape.world_from_object = state.graphics.ctm;
  shape.reverse_orientation = state.graphics.reverse_orientation;
  shape.material = CurrentMaterial(state, params.where());
  shape.media = state.graphics.media;
  ReadGeometry(state, type, params, &shape);
  shape.alpha = TexturedFloat(state, params, "alpha", 1, 0, 1);
  params.CheckAllUsed();
  if (!IsVisible(shape)) {
    return state.AddNote(shape.where,
                         fmt::format("left out {}: its radius is 0", params.object()));
  }
  shape.area_light = CurrentAreaLight(state, shape, params.where());
  state.OpenShapes().push_back(std::move(shape));
}

}  // namespace lanelight
