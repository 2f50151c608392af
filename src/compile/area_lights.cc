#include "src/compile/area_lights.h"

#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "src/compile/rectangles.h"

namespace lanelight {
namespace {

constexpr double kPi = std::numbers::pi;
// Rounding of positions changes the areas of very small emitters; from this relative
// change on, their radiance makes up for it.
constexpr double kAreaTolerance = 1e-4;

class AreaLightCompiler {
 public:
  AreaLightCompiler(const SceneDescription& d, const Placement& placement,
                    CompiledGeometry& geometry, LightList& lights)
      : d_(d), placement_(placement), compiled_(geometry), lights_(lights) {}

  void AddShapes();

 private:
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

  const SceneDescription& d_;
  const Placement& placement_;
  CompiledGeometry& compiled_;
  LightList& lights_;
};

const AreaLight& AreaLightOf(const SceneDescription& d, const PlacedShape& placed) {
  return d.area_lights[static_cast<std::size_t>(placed.area_light)];
}

// Radiance of a shape of that total area in scene units.
Rgb AreaLightCompiler::Radiance(const PlacedShape& placed, double scene_area) const {
  const AreaLight& light = AreaLightOf(d_, placed);
  const Rgb radiance = light.radiance * light.scale;
  if (!(light.power > 0)) return radiance;
  const double scale = placement_.frame.scale;
  const double area = scene_area / scale / scale;  // in the file's units
  return radiance *
         (light.power / (kPi * area * (light.two_sided ? 2 : 1) * Luminance(radiance)));
}

LightRecord AreaLightCompiler::AreaRecord(LightShape shape, const PlacedShape& placed,
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

void AreaLightCompiler::EmittingTriangle(const PlacedShape& placed, Rgb radiance,
                                         double area, std::uint32_t i) {
  TriangleRecord& triangle = compiled_.geometry.triangles[i];
  const double rounded = RoundedArea(triangle);
  const LightRecord record = AreaRecord(
      LightShape::kTriangle, placed, radiance * CorrectionOf(area, rounded), rounded, i);
  triangle.light = lights_.Push(record, AreaPower(record));
}

void AreaLightCompiler::EmittingRectangle(const PlacedShape& placed, Rgb radiance,
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
  const std::int32_t light = lights_.Push(record, AreaPower(record));
  for (const std::uint32_t i : {r.first, r.second}) {
    compiled_.geometry.triangles[begin + i].light = light;
  }
}

void AreaLightCompiler::EmittingMesh(const PlacedShape& placed, const MeshRange& range) {
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

void AreaLightCompiler::EmittingSphere(const PlacedShape& placed, std::size_t i) {
  SphereRecord& sphere = compiled_.geometry.spheres[i];
  const double area = 4 * kPi * sphere.radius * sphere.radius;
  const auto primitive =
      compiled_.geometry.ranges.spheres + static_cast<std::uint32_t>(i);
  const LightRecord record =
      AreaRecord(LightShape::kSphere, placed, Radiance(placed, area), area, primitive);
  sphere.light = lights_.Push(record, AreaPower(record));
}

void AreaLightCompiler::EmittingDisk(const PlacedShape& placed, std::size_t i) {
  DiskRecord& disk = compiled_.geometry.disks[i];
  const double outer = disk.radius, inner = disk.inner_radius;
  const double area = kPi * (outer - inner) * (outer + inner);
  const auto primitive = compiled_.geometry.ranges.disks + static_cast<std::uint32_t>(i);
  const LightRecord record =
      AreaRecord(LightShape::kDisk, placed, Radiance(placed, area), area, primitive);
  disk.light = lights_.Push(record, AreaPower(record));
}

void AreaLightCompiler::AddShapes() {
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

}  // namespace

void CompileAreaLights(const SceneDescription& description, const Placement& placement,
                       CompiledGeometry& geometry, LightList& lights) {
  AreaLightCompiler(description, placement, geometry, lights).AddShapes();
}

}  // namespace lanelight
