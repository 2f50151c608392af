#include <fmt/format.h>

#include <algorithm>

#include "src/base/core/suggest.h"
#include "src/scene/parse/interpret.h"
#include "src/scene/parse/motion.h"

namespace lanelight {
namespace {

constexpr double kTiny = 1e-30;

void ReadPhi(ParamSet& params, Shape* shape) {
  shape->phi_max = std::min(params.Float("phimax", 360, kNotNegative), 360.0);
}

// `max_height` limits their distance from the middle. pbrt accepts them in either order.
void ReadHeights(ParamSet& params, double absent, double max_height, Shape* shape) {
  const double a = std::clamp(params.Float("zmin", -absent), -max_height, max_height);
  const double b = std::clamp(params.Float("zmax", absent), -max_height, max_height);
  shape->z_min = std::min(a, b);
  shape->z_max = std::max(a, b);
}

bool IsVisible(const Shape& shape) {
  return shape.kind == ShapeKind::kMesh || shape.kind == ShapeKind::kPlane ||
         shape.kind == ShapeKind::kCurves || shape.radius > 0;
}

void ReadSphere(ParseState&, ParamSet& params, Shape* shape) {
  shape->radius = params.Float("radius", 1, kNotNegative);
  ReadHeights(params, shape->radius, shape->radius, shape);
  ReadPhi(params, shape);
}

void ReadCylinder(ParseState&, ParamSet& params, Shape* shape) {
  shape->radius = params.Float("radius", 1, kNotNegative);
  ReadHeights(params, 1, kHuge, shape);
  ReadPhi(params, shape);
}

void ReadDisk(ParseState&, ParamSet& params, Shape* shape) {
  shape->radius = params.Float("radius", 1, kNotNegative);
  shape->inner_radius = params.Float("innerradius", 0, kNotNegative);
  shape->height = params.Float("height", 0, Limits());
  if (shape->inner_radius >= shape->radius && shape->radius > 0) {
    params.Fail(*params.Find("innerradius", {}),
                "the inner radius {} is not below the radius {}", shape->inner_radius,
                shape->radius);
  }
  ReadPhi(params, shape);
}

// Longest side of displaced triangles. pbrt-v4 has the second name on GPUs only.
double EdgeLength(ParseState& state, ParamSet& params) {
  constexpr const char* kGpuParameter = "displacement.edgelength";
  const Limits limits = {kTiny, kHuge};
  const double other = params.Float(kGpuParameter, 1, limits);
  if (const Param* gpu_param = params.Find(kGpuParameter, {})) {
    state.AddNote(gpu_param->where,
                  "pbrt-v4 takes \"{}\" on GPUs only; write \"edgelength\"",
                  kGpuParameter);
  }
  return params.Float("edgelength", other, limits) * state.edge_scale;
}

void ReadPly(ParseState& state, ParamSet& params, Shape*) {
  const NamedFile file = RequireFile(state, params, "filename");
  MeshRequest request{file.path, file.param->where, state.open_object,
                      state.OpenShapes().size()};
  request.world_from_object = state.graphics.ctm;
  if (params.Find("displacement", {ParamType::kTexture}) != nullptr) {
    request.displacement = TexturedFloat(state, params, "displacement", 0).texture;
  }
  request.edge_length = EdgeLength(state, params);
  params.Ignore("displacement.uvscale", "pbrt-v4 has no such parameter");
  state.meshes.push_back(std::move(request));
}

template <std::shared_ptr<const TriangleMesh> (*kInterpret)(ParamSet&)>
void ReadMesh(ParseState&, ParamSet& params, Shape* shape) {
  shape->mesh = kInterpret(params);
}

void ReadCurve(ParseState& state, ParamSet& params, Shape* shape) {
  shape->curves = std::make_shared<std::vector<Curve>>(InterpretCurve(state, params));
}

struct ShapeType {
  ShapeKind kind;
  void (*read)(ParseState&, ParamSet&, Shape*);
};
constexpr std::pair<const char*, ShapeType> kShapes[] = {
    {"sphere", {ShapeKind::kSphere, ReadSphere}},
    {"disk", {ShapeKind::kDisk, ReadDisk}},
    {"cylinder", {ShapeKind::kCylinder, ReadCylinder}},
    {"trianglemesh", {ShapeKind::kMesh, ReadMesh<InterpretTriangleMesh>}},
    {"plymesh", {ShapeKind::kMesh, ReadPly}},
    {"bilinearmesh", {ShapeKind::kMesh, ReadMesh<InterpretBilinearMesh>}},
    {"loopsubdiv", {ShapeKind::kMesh, ReadMesh<InterpretLoopSubdivision>}},
    {"plane", {ShapeKind::kPlane, [](ParseState&, ParamSet&, Shape*) {}}},
    {"curve", {ShapeKind::kCurves, ReadCurve}}};

Index CurrentMaterial(ParseState& state, const SourceLocation& where) {
  if (state.graphics.later_material) {
    return Resolve(state, *state.graphics.later_material);
  }
  if (state.graphics.material != kNone) return state.graphics.material;
  if (state.default_material == kNone) {
    ParamSet defaults("material \"diffuse\"", where, {}, nullptr, &state.scene.notes);
    state.default_material = InterpretMaterial(state, "", "diffuse", defaults);
  }
  return state.default_material;
}

// The medium inside of a material takes precedence over MediumInterface.
MediumInterface MediaOf(ParseState& state, const Shape& shape) {
  MediumInterface media = state.graphics.media;
  const Index inside = state.scene.materials[shape.material].inside;
  if (inside == kNone) return media;
  if (media.IsTransition() && media.inside != kNone) {
    state.AddNote(shape.where, "the material's own medium replaces {} inside",
                  Quoted(state.scene.media[media.inside].name));
  }
  media.inside = inside;
  return media;
}

// In these cases pbrt-v4 drops the light silently; here a note reports it.
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
                  "the area light has no effect on a shape with material \"interface\"");
    return kNone;
  }
  if (shape.kind == ShapeKind::kCurves) {
    state.AddNoteOnce(where, "the area light has no effect on curves: they emit nothing");
    return kNone;
  }
  if (shape.kind == ShapeKind::kPlane && state.scene.area_lights[light].power > 0) {
    throw InputError(where,
                     "an area light with \"power\" on a plane, whose area is infinite");
  }
  return light;
}

// True if the curves may join those of the shape before. Hair has one directive per
// strand.
bool ContinuesCurves(const Shape& shape, const Shape& before) {
  return before.kind == ShapeKind::kCurves && shape.material == before.material &&
         shape.reverse_orientation == before.reverse_orientation &&
         shape.world_from_object == before.world_from_object;
}

void AddCurves(ParseState& state, Shape shape) {
  if (shape.alpha.texture != kNone || shape.alpha.constant != 1) {
    return state.Unsupported(shape.where,
                             "\"alpha\" is not supported for shape \"curve\"");
  }
  if (shape.curves->empty()) return;
  if (shape.media.IsTransition()) {
    state.AddNoteOnce(
        shape.where, "the medium interface has no effect on curves: they have no inside");
    shape.media = {};
  }
  std::vector<Shape>& shapes = state.OpenShapes();
  if (shapes.empty() || !ContinuesCurves(shape, shapes.back())) {
    return shapes.push_back(std::move(shape));
  }
  std::vector<Curve>& curves = *shapes.back().curves;
  curves.insert(curves.end(), shape.curves->begin(), shape.curves->end());
}

void AddShape(ParseState& state, const std::string& type, ParamSet& params,
              const Transform& world_from_object) {
  const auto& [kind, read] = Lookup(kShapes, type, params.where(), "shape");
  Shape shape;
  shape.kind = kind;
  shape.where = params.where();
  shape.world_from_object = world_from_object;
  shape.reverse_orientation = state.graphics.reverse_orientation;
  shape.material = CurrentMaterial(state, params.where());
  shape.media = MediaOf(state, shape);
  read(state, params, &shape);
  shape.alpha = TexturedFloat(state, params, "alpha", 1, {0, 1});
  params.CheckAllUsed();
  if (!IsVisible(shape)) {
    return state.AddNote(shape.where, "left out {}: its radius is 0", params.object());
  }
  shape.area_light = CurrentAreaLight(state, shape, params.where());
  if (shape.kind == ShapeKind::kCurves) return AddCurves(state, std::move(shape));
  state.OpenShapes().push_back(std::move(shape));
}

// Why a shape that moves in the file cannot move here; empty if it can.
std::string ReasonNotMoving(const ParseState& state, ShapeKind kind, Index material) {
  if (const char* why = MotionProblem(kind)) return why;
  const bool emits = state.graphics.area_light != kNone && state.open_object == kNone &&
                     state.scene.materials[material].kind != MaterialKind::kInterface;
  return emits ? "an area light cannot move: light is sampled where it is at the start"
               : "";
}

}  // namespace

// A moving shape becomes an object with one instance, as in pbrt-v4.
void InterpretShape(ParseState& state, const std::string& type, ParamSet& params) {
  const Transform& ctm = state.graphics.ctm;
  if (!state.graphics.Moves()) return AddShape(state, type, params, ctm);
  const ShapeKind kind = Lookup(kShapes, type, params.where(), "shape").kind;
  const std::string why =
      ReasonNotMoving(state, kind, CurrentMaterial(state, params.where()));
  if (!why.empty()) {
    state.Unsupported(params.where(), why);
    return AddShape(state, type, params, ctm);
  }
  AddMovingShape(state, params.where(),
                 [&] { AddShape(state, type, params, Transform()); });
}

}  // namespace lanelight
