#include "src/compile/lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "src/core/check.h"
#include "src/core/error.h"
#include "src/compile/environment.h"
#include "src/compile/rectangles.h"

namespace lanelight {
namespace {

constexpr double kPi = std::numbers::pi;
// No light is picked more rarely than this (or a hundredth of the uniform probability, if
// there are very many): a light of little power may still be all that a corner sees.
constexpr double kMinPmf = 1e-6;
// Rounding of positions changes the areas of very small emitters; from this relative
// change on, their radiance makes up for it.
constexpr double kAreaTolerance = 1e-4;

void Store(Vec3d v, float out[3]) {
  for (int i = 0; i < 3; ++i) out[i] = static_cast<float>(v[i]);
}

bool IsBlack(Rgb c) { return !(c.x > 0 || c.y > 0 || c.z > 0); }

class LightCompiler {
 public:
  LightCompiler(const SceneDescription& d, const Placement& placement,
                CompiledGeometry& geometry)
      : d_(d),
        placement_(placement),
        compiled_(geometry),
        radius_(placement.bounds.HalfDiagonal() * placement.frame.scale) {}

  LightTable Finish();
  std::vector<Note> TakeNotes() { return std::move(notes_); }

 private:
  std::int32_t Push(LightRecord record, double power);
  Rgb Radiance(const PlacedShape& placed, double scene_area) const;
  LightRecord AreaRecord(LightShape shape, const PlacedShape& placed, Rgb radiance,
                         double area, std::uint32_t primitive) const;
  void EmittingMesh(const PlacedShape& placed, const MeshRange& range);
  void EmittingTriangle(const PlacedShape& placed, Rgb radiance, double area,
                        std::uint32_t i);
  void EmittingRectangle(const PlacedShape& placed, Rgb radiance, double area,
                         const Rectangle& r, std::uint32_t begin);
  void EmittingSphere(const PlacedShape& placed, std::size_t i);
  void EmittingDisk(const PlacedShape& placed, std::size_t i);
  void AddShapes();
  void AddLight(const Light& light);
  void Point(const Light& light);
  void Spot(const Light& light);
  void Distant(const Light& light);
  void Infinite(const Light& light);

  Vec3d Position(const Light& light) const {
    return placement_.frame.Point(light.world_from_light.Point(light.from));
  }
  // The power of a distant light and of an environment is what falls on the scene.
  double SceneDisk() const { return radius_ > 0 ? kPi * radius_ * radius_ : kPi; }

  const SceneDescription& d_;
  const Placement& placement_;
  CompiledGeometry& compiled_;
  const double radius_;
  LightTable table_;
  std::vector<double> power_;
  std::vector<Note> notes_;
};

std::int32_t LightCompiler::Push(LightRecord record, double power) {
  table_.lights.push_back(record);
  power_.push_back(power);
  return static_cast<std::int32_t>(table_.lights.size()) - 1;
}

LightRecord EmptyRecord(LightShape shape) {
  LightRecord record{};
  record.shape = static_cast<std::uint32_t>(shape);
  record.primitive = 0xffffffffu;
  record.environment = -1;
  return record;
}

const AreaLight& AreaLightOf(const SceneDescription& d, const PlacedShape& placed) {
  return d.area_lights[static_cast<std::size_t>(placed.area_light)];
}

// Radiance of a shape of that total area in scene units.
Rgb LightCompiler::Radiance(const PlacedShape& placed, double scene_area) const {
  const AreaLight& light = AreaLightOf(d_, placed);
  const Rgb radiance = light.radiance * light.scale;
  if (!(light.power > 0)) return radiance;
  const double scale = placement_.frame.scale;
  const double area = scene_area / scale / scale;  // in the file's units
  return radiance *
         (light.power / (kPi * area * (light.two_sided ? 2 : 1) * Luminance(radiance)));
}

LightRecord LightCompiler::AreaRecord(LightShape shape, const PlacedShape& placed,
                                      Rgb radiance, double area,
                                      std::uint32_t primitive) const {
  LightRecord record = EmptyRecord(shape);
  record.two_sided = AreaLightOf(d_, placed).two_sided ? 1 : 0;
  record.area = static_cast<float>(area);
  record.primitive = primitive;
  Store(radiance, record.radiance);
  return record;
}

double AreaPower(const LightRecord& record) {
  const Rgb l = {record.radiance[0], record.radiance[1], record.radiance[2]};
  return kPi * record.area * Luminance(l) * (record.two_sided ? 2 : 1);
}

double RoundedArea(const TriangleRecord& t) {
  const auto p = [&](int k) { return Vec3d{t.p[k][0], t.p[k][1], t.p[k][2]}; };
  return Length(Cross(p(1) - p(0), p(2) - p(0))) / 2;
}

// Rays and samples meet the rounded triangle; what it emits is to be what the file says.
double CorrectionOf(double area, double rounded) {
  const double ratio = area / rounded;
  return std::abs(ratio - 1) > kAreaTolerance ? ratio : 1;
}

void LightCompiler::EmittingTriangle(const PlacedShape& placed, Rgb radiance, double area,
                                     std::uint32_t i) {
  TriangleRecord& triangle = compiled_.geometry.triangles[i];
  const double rounded = RoundedArea(triangle);
  const LightRecord record = AreaRecord(
      LightShape::kTriangle, placed, radiance * CorrectionOf(area, rounded), rounded, i);
  triangle.light = Push(record, AreaPower(record));
}

void LightCompiler::EmittingRectangle(const PlacedShape& placed, Rgb radiance,
                                      double area, const Rectangle& r,
                                      std::uint32_t begin) {
  const double x = Length(r.x_side), y = Length(r.y_side);
  LightRecord record =
      AreaRecord(LightShape::kRectangle, placed, radiance * CorrectionOf(area, x * y),
                 x * y, begin + r.first);
  record.second_primitive = begin + r.second;
  Store(r.corner, record.position);
  Store(r.x_side / x, record.direction);
  Store(r.y_side / y, record.side);
  record.size[0] = static_cast<float>(x), record.size[1] = static_cast<float>(y);
  const std::int32_t light = Push(record, AreaPower(record));
  for (const std::uint32_t i : {r.first, r.second}) {
    compiled_.geometry.triangles[begin + i].light = light;
  }
}

void LightCompiler::EmittingMesh(const PlacedShape& placed, const MeshRange& range) {
  double total = 0;
  for (double area : range.areas) total += area;
  if (!(total > 0)) return;  // only degenerate triangles: CompileScene leaves a note
  const Rgb radiance = Radiance(placed, total);
  const std::span<TriangleRecord> mesh(&compiled_.geometry.triangles[range.begin],
                                       range.end - range.begin);
  const std::vector<Rectangle> rectangles = FindRectangles(mesh);
  auto next = rectangles.begin();
  for (std::uint32_t i = 0; i < mesh.size(); ++i) {
    if (next != rectangles.end() && next->first == i) {
      const double area = range.areas[i] + range.areas[next->second];
      EmittingRectangle(placed, radiance, area, *next++, range.begin);
    } else if (mesh[i].light < 0) {  // not the second of a rectangle
      EmittingTriangle(placed, radiance, range.areas[i], range.begin + i);
    }
  }
}

void LightCompiler::EmittingSphere(const PlacedShape& placed, std::size_t i) {
  SphereRecord& sphere = compiled_.geometry.spheres[i];
  const double area = 4 * kPi * sphere.radius * sphere.radius;
  const auto primitive =
      compiled_.geometry.ranges.spheres + static_cast<std::uint32_t>(i);
  const LightRecord record =
      AreaRecord(LightShape::kSphere, placed, Radiance(placed, area), area, primitive);
  sphere.light = Push(record, AreaPower(record));
}

void LightCompiler::EmittingDisk(const PlacedShape& placed, std::size_t i) {
  DiskRecord& disk = compiled_.geometry.disks[i];
  const double outer = disk.radius, inner = disk.inner_radius;
  const double area = kPi * (outer - inner) * (outer + inner);
  const auto primitive = compiled_.geometry.ranges.disks + static_cast<std::uint32_t>(i);
  const LightRecord record =
      AreaRecord(LightShape::kDisk, placed, Radiance(placed, area), area, primitive);
  disk.light = Push(record, AreaPower(record));
}

void LightCompiler::AddShapes() {
  for (std::size_t i = 0; i < placement_.meshes.size(); ++i) {
    if (placement_.meshes[i].area_light == kNone) continue;
    EmittingMesh(placement_.meshes[i], compiled_.meshes[i]);
  }
  for (std::size_t i = 0; i < placement_.spheres.size(); ++i) {
    if (placement_.spheres[i].area_light != kNone)
      EmittingSphere(placement_.spheres[i], i);
  }
  for (std::size_t i = 0; i < placement_.disks.size(); ++i) {
    if (placement_.disks[i].area_light != kNone) EmittingDisk(placement_.disks[i], i);
  }
}

// Intensity is power per solid angle; irradiance falls with the square of the distance,
// and distances are scaled.
Rgb SceneIntensity(const Light& light, const Frame& frame) {
  return light.emission * frame.scale * frame.scale;
}

void LightCompiler::Point(const Light& light) {
  LightRecord record = EmptyRecord(LightShape::kPoint);
  const Rgb intensity = SceneIntensity(light, placement_.frame);
  Store(intensity, record.radiance);
  Store(Position(light), record.position);
  Push(record, 4 * kPi * Luminance(intensity));
}

void LightCompiler::Spot(const Light& light) {
  if (!(light.world_from_light.UniformScale() > 0)) {
    throw InputError(light.where,
                     "a spot light under a transform that is not rotation, translation, "
                     "mirroring and uniform scale is not supported");
  }
  const Vec3d axis = light.world_from_light.Vector(light.to - light.from);
  if (!(Length(axis) > 0)) {
    throw InputError(light.where, "a spot light whose \"from\" and \"to\" are the same");
  }
  // 1 - cos, which for a narrow cone is nothing beside 1.
  const auto versine = [](double degrees) {
    const double sine = std::sin(degrees * (kPi / 360));
    return 2 * sine * sine;
  };
  const double total = versine(light.cone_angle);
  const double falloff = versine(light.cone_angle - light.cone_delta);
  LightRecord record = EmptyRecord(LightShape::kSpot);
  const Rgb intensity = SceneIntensity(light, placement_.frame);
  Store(intensity, record.radiance);
  Store(Position(light), record.position);
  Store(Normalize(axis), record.direction);
  record.versine_total = static_cast<float>(total);
  record.versine_falloff = static_cast<float>(falloff);
  // The smooth step between the two angles is 1/2 in the mean.
  Push(record, 2 * kPi * Luminance(intensity) * ((falloff + total) / 2));
}

void LightCompiler::Distant(const Light& light) {
  const Vec3d toward = light.world_from_light.Vector(light.from - light.to);
  if (!(Length(toward) > 0)) {
    throw InputError(light.where,
                     "a distant light whose \"from\" and \"to\" are the same");
  }
  LightRecord record = EmptyRecord(LightShape::kDistant);
  Store(light.emission, record.radiance);
  Store(Normalize(toward), record.direction);
  Push(record, SceneDisk() * Luminance(light.emission));
}

void LightCompiler::Infinite(const Light& light) {
  const bool image = !light.image_path.empty();
  LightRecord record =
      EmptyRecord(image ? LightShape::kInfiniteImage : LightShape::kInfiniteConstant);
  Rgb mean = light.emission;
  if (image) {
    Environment environment = CompileEnvironment(light, &notes_);
    mean = MeanRadiance(environment);
    if (environment.probability.empty()) return;  // black
    record.environment = static_cast<std::int32_t>(table_.environments.size());
    table_.environments.push_back(std::move(environment));
  } else if (light.illuminance > 0) {
    // pi times the radiance reaches a plane under a constant sky.
    mean *= light.illuminance / (kPi * Luminance(mean));
  }
  Store(image ? Rgb{1, 1, 1} : mean, record.radiance);
  const std::int32_t index = Push(record, SceneDisk() * kPi * Luminance(mean));
  table_.infinite.push_back(static_cast<std::uint32_t>(index));
}

void LightCompiler::AddLight(const Light& light) {
  const bool image = light.kind == LightKind::kInfinite && !light.image_path.empty();
  if (!image && IsBlack(light.emission)) return;
  switch (light.kind) {
    case LightKind::kPoint:
      Point(light);
      break;
    case LightKind::kSpot:
      Spot(light);
      break;
    case LightKind::kDistant:
      Distant(light);
      break;
    case LightKind::kInfinite:
      Infinite(light);
      break;
  }
}

// Weights are raised to the smallest probability; that changes their sum by so little
// that no second pass is needed.
void ApplyFloor(std::vector<double>& weights) {
  double sum = 0;
  for (double w : weights) sum += w;
  const double least = std::min(kMinPmf, 0.01 / static_cast<double>(weights.size()));
  for (double& w : weights) w = std::max(w, 1.02 * least * sum);
}

LightTable LightCompiler::Finish() {
  AddShapes();
  for (const Light& light : d_.lights) AddLight(light);
  if (!table_.lights.empty()) ApplyFloor(power_);
  table_.power = std::move(power_);
  return std::move(table_);
}

}  // namespace

LightTable CompileLights(const SceneDescription& description, const Placement& placement,
                         CompiledGeometry& geometry, std::vector<Note>& notes) {
  LightCompiler compiler(description, placement, geometry);
  LightTable table = compiler.Finish();
  for (Note& note : compiler.TakeNotes()) notes.push_back(std::move(note));
  return table;
}

}  // namespace lanelight
