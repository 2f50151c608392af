// Lights of every shape, put together by hand, and what a point sees of them: plain
// formulas in double precision, of which the kernels know nothing.
#pragma once

#include <vector>

#include "src/scene/compiled/scene.h"
#include "src/vocabulary/path/wave.h"

namespace lanelight::test {

/// Lights that a light stage can sample, each with a name for messages. Radiances,
/// selection probabilities and sides differ.
struct NamedLight {
  const char* name;
  LightRecord record;
  float pmf;
};

/// Triangles, spheres and disks that emit, among dark ones, and lights without a shape:
/// sixteen lights, as many as the widest vector has lanes.
struct LightScene {
  CompiledScene scene;
  LightChances chances;
  std::vector<NamedLight> lights;

  LightScene();
  SceneParts Parts() const { return PartsOf(scene, scene.view, &chances); }
  /// Only light `i`; what emitted otherwise is dark.
  void Keep(std::size_t i);
  /// Adds `count` point lights with selection probability 0.
  void AddOthers(int count);

 private:
  void AddShapes();
  void AddRectangle();
  void AddLight(const char* name, LightShape shape, std::uint32_t primitive, double area);
  void StoreRecords();
};

/// Record of a triangle or rectangle from `corner` along two sides, as the scene compiler
/// would write it: its triangles are primitives 0 and 1; no radiance.
LightRecord FlatLight(LightShape shape, Vec3d corner, Vec3d x, Vec3d y);

/// What lies along the unit direction `w` from `from`, if the light is met there.
struct VisibleLight {
  bool met = false;     // within rounding of its edges
  bool facing = false;  // the side that emits
  double distance = 0;
  double cosine = 1;  // of the light's normal with the direction, 1 without a surface
  double pdf = 0;     // of sampling `w`, light selection not included; 0: delta light
  Vec3d radiance;     // delta lights: radiance / pdf
};
/// solid_angle: triangles and rectangles are sampled by that, instead of by area.
VisibleLight FindVisibleLight(const CompiledScene& scene, const LightRecord& light,
                              Vec3d from, Vec3d w, bool solid_angle = false);

/// Solid angle under which the light is seen, and the integral of the direction over it;
/// closed forms. Disks: from points of their axis only.
struct SolidAngle {
  double steradians = 0;
  Vec3d moment;
};
SolidAngle SolidAngleOf(const CompiledScene& scene, const LightRecord& light, Vec3d from);

}  // namespace lanelight::test
