#include "src/scene/compile/lights.h"

#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "src/base/core/pi.h"

namespace lanelight {
namespace {

// Rounding of positions changes the areas of very small emitters; from this relative
// change on, their radiance makes up for it.
constexpr double kAreaTolerance = 1e-4;
// Faces whose areas differ by no more than rounding are equally bright at one power.
constexpr double kFaceTolerance = 1e-3;

const AreaLight& AreaLightOf(const SceneDescription& d, const PlacedShape& placed) {
  return d.area_lights[static_cast<std::size_t>(placed.area_light)];
}

// Returns whether rays can pass through parts of the shape, but not through all of it.
bool HasHoles(const PlacedShape& placed) {
  return placed.alpha.texture != kNone ||
         (placed.alpha.constant < 1 && placed.alpha.constant > 0);
}

double RoundedArea(const TriangleRecord& t) {
  const auto p = [&](int k) { return Vec3d{t.p[k][0], t.p[k][1], t.p[k][2]}; };
  return Length(Cross(p(1) - p(0), p(2) - p(0))) / 2;
}

// Returns the factor that keeps the emitted power although the area is rounded.
double CorrectionOf(double area, double rounded) {
  const double ratio = area / rounded;
  return std::abs(ratio - 1) > kAreaTolerance ? ratio : 1;
}

class AreaLightCompiler {
 public:
  AreaLightCompiler(const SceneDescription& d, const Placement& placement,
                    CompiledGeometry& geometry, LightImageTable& images,
                    LightList& lights)
      : d_(d), placement_(placement), compiled_(geometry), lights_(lights) {
    LoadImages(images);
  }

  void AddShapes() {
    for (std::size_t i = 0; i < placement_.meshes.size(); ++i) {
      if (!Shines(placement_.meshes[i])) continue;
      EmittingMesh(placement_.meshes[i], compiled_.meshes[i]);
    }
    for (std::size_t i = 0; i < placement_.spheres.size(); ++i) {
      if (Shines(placement_.spheres[i])) EmittingSphere(placement_.spheres[i], i);
    }
    for (std::size_t i = 0; i < placement_.disks.size(); ++i) {
      if (Shines(placement_.disks[i])) EmittingDisk(placement_.disks[i], i);
    }
  }

 private:
  void LoadImages(LightImageTable& images) {
    images_.assign(d_.area_lights.size(), 0);
    means_.assign(d_.area_lights.size(), Rgb{1, 1, 1});
    const auto load = [&](const std::vector<PlacedShape>& shapes) {
      for (const PlacedShape& placed : shapes) {
        if (placed.area_light == kNone) continue;
        const auto i = static_cast<std::size_t>(placed.area_light);
        const AreaLight& light = d_.area_lights[i];
        if (light.image_path.empty() || images_[i] != 0) continue;
        const LightImage image =
            images.Load({light.where, "area light's image", light.image_path},
                        LightImageTable::Use::kColor);
        images_[i] = images.Add(image);
        means_[i] = images.Mean(image);
      }
    };
    load(placement_.meshes);
    load(placement_.spheres);
    load(placement_.disks);
  }

  // Returns false for shapes that do not emit or whose image is black.
  bool Shines(const PlacedShape& placed) const {
    return placed.area_light != kNone && Luminance(MeanOf(placed)) > 0;
  }

  std::int32_t Push(const LightRecord& record, const PlacedShape& placed) {
    const Rgb l = {record.radiance[0], record.radiance[1], record.radiance[2]};
    const double power =
        kPi * record.area * Luminance(l * MeanOf(placed)) * (record.two_sided ? 2 : 1);
    return lights_.Push(record, power, AreaLightOf(d_, placed));
  }

  Rgb MeanOf(const PlacedShape& placed) const {
    return means_[static_cast<std::size_t>(placed.area_light)];
  }

  // Radiance of a shape, or a face of one, of that area in scene units; with an image, of
  // its texels of value 1.
  Rgb Radiance(const PlacedShape& placed, double scene_area) const {
    const AreaLight& light = AreaLightOf(d_, placed);
    const Rgb radiance = light.radiance * light.scale;
    if (!(light.power > 0)) return radiance;
    const double scale = placement_.frame.scale;
    const double area = scene_area / scale / scale;  // in the file's units
    return radiance * (light.power / (kPi * area * (light.two_sided ? 2 : 1) *
                                      Luminance(MeanOf(placed))));
  }

  LightRecord AreaRecord(LightShape shape, const PlacedShape& placed, Rgb radiance,
                         double area, std::uint32_t primitive) const {
    LightRecord record = EmptyRecord(shape);
    record.two_sided = AreaLightOf(d_, placed).two_sided ? 1 : 0;
    record.area = static_cast<float>(area);
    record.primitive = primitive;
    record.image = images_[static_cast<std::size_t>(placed.area_light)];
    Store(radiance, record.radiance);
    return record;
  }

  void EmittingMesh(const PlacedShape& placed, const MeshRange& range) {
    if (range.begin == range.end) return;  // all degenerate: CompileScene leaves a note
    const std::span<TriangleRecord> mesh(&compiled_.geometry.triangles[range.begin],
                                         range.end - range.begin);
    std::vector<Rectangle> rectangles = FindRectangles(mesh);
    if (AreaLightOf(d_, placed).power > 0) {
      // A rectangle needs equal radiance on both triangles, and power divides by the
      // face's area.
      std::erase_if(rectangles, [&](const Rectangle& r) {
        const double a = range.face_areas[r.first], b = range.face_areas[r.second];
        return std::abs(a - b) > kFaceTolerance * a;
      });
    }
    auto next = rectangles.begin();
    for (std::uint32_t i = 0; i < mesh.size(); ++i) {
      const Rgb radiance = Radiance(placed, range.face_areas[i]);
      if (next != rectangles.end() && next->first == i) {
        const double area = range.areas[i] + range.areas[next->second];
        EmittingRectangle(placed, radiance, area, *next++, range.begin);
      } else if (mesh[i].light < 0) {  // not the second of a rectangle
        EmittingTriangle(placed, radiance, range.areas[i], range.begin + i);
      }
    }
  }

  void EmittingTriangle(const PlacedShape& placed, Rgb radiance, double area,
                        std::uint32_t i) {
    TriangleRecord& triangle = compiled_.geometry.triangles[i];
    const double rounded = RoundedArea(triangle);
    const LightRecord record =
        AreaRecord(LightShape::kTriangle, placed, radiance * CorrectionOf(area, rounded),
                   rounded, i);
    triangle.light = Push(record, placed);
  }

  void EmittingRectangle(const PlacedShape& placed, Rgb radiance, double area,
                         const Rectangle& r, std::uint32_t begin) {
    const double x = Length(r.x_side), y = Length(r.y_side);
    LightRecord record =
        AreaRecord(LightShape::kRectangle, placed, radiance * CorrectionOf(area, x * y),
                   x * y, begin + r.first);
    record.second_primitive = begin + r.second;
    Store(r.corner, record.position);
    Store(r.x_side / x, record.direction);
    Store(r.y_side / y, record.side);
    record.size[0] = static_cast<float>(x), record.size[1] = static_cast<float>(y);
    const std::int32_t light = Push(record, placed);
    for (const std::uint32_t i : {r.first, r.second}) {
      compiled_.geometry.triangles[begin + i].light = light;
    }
  }

  void EmittingSphere(const PlacedShape& placed, std::size_t i) {
    SphereRecord& sphere = compiled_.geometry.spheres[i];
    const double area = 4 * kPi * sphere.radius * sphere.radius;
    const auto primitive =
        compiled_.geometry.ranges.spheres + static_cast<std::uint32_t>(i);
    LightRecord record =
        AreaRecord(LightShape::kSphere, placed, Radiance(placed, area), area, primitive);
    const bool inside_shines = record.two_sided != 0 || sphere.normal_sign < 0;
    record.size[0] = inside_shines && HasHoles(placed)
                         ? std::numeric_limits<float>::infinity()
                         : ConeFrom(sphere.radius);
    sphere.light = Push(record, placed);
  }

  void EmittingDisk(const PlacedShape& placed, std::size_t i) {
    DiskRecord& disk = compiled_.geometry.disks[i];
    const double outer = disk.radius, inner = disk.inner_radius;
    const double area = kPi * (outer - inner) * (outer + inner);
    const auto primitive =
        compiled_.geometry.ranges.disks + static_cast<std::uint32_t>(i);
    const LightRecord record =
        AreaRecord(LightShape::kDisk, placed, Radiance(placed, area), area, primitive);
    disk.light = Push(record, placed);
  }

  const SceneDescription& d_;
  const Placement& placement_;
  CompiledGeometry& compiled_;
  LightList& lights_;
  // Per area light: its image or 0, and the image's mean (else 1).
  std::vector<std::uint32_t> images_;
  std::vector<Rgb> means_;
};

}  // namespace

void CompileAreaLights(const SceneDescription& description, const Placement& placement,
                       CompiledGeometry& geometry, LightImageTable& images,
                       LightList& lights) {
  AreaLightCompiler(description, placement, geometry, images, lights).AddShapes();
}

}  // namespace lanelight
