#include "src/scene/compile/gbuffer.h"

namespace lanelight {

GbufferSpace CompileGbufferSpace(const Film& film, const Camera& camera,
                                 const WorldFrame& frame) {
  if (film.gbuffer == Gbuffer::kNone) return {};
  const bool in_camera = film.gbuffer == Gbuffer::kCamera;
  // Subtracting first keeps the digits of nearby points.
  const Transform scene_from_space =
      in_camera ? frame.After(camera.world_from_camera) : frame.After(Transform());
  const Transform space_from_scene = scene_from_space.Inverse();
  const Vec3d columns[3] = {space_from_scene.Vector({1, 0, 0}),
                            space_from_scene.Vector({0, 1, 0}),
                            space_from_scene.Vector({0, 0, 1})};
  const Vec3d from = in_camera ? scene_from_space.Point({0, 0, 0}) : Vec3d{0, 0, 0};
  GbufferSpace space;
  space.of_camera = in_camera;
  space.from = ToFloat(from);
  space.to = ToFloat(in_camera ? Vec3d{0, 0, 0} : frame.center);
  space.x = ToFloat({columns[0].x, columns[1].x, columns[2].x});
  space.y = ToFloat({columns[0].y, columns[1].y, columns[2].y});
  space.z = ToFloat({columns[0].z, columns[1].z, columns[2].z});
  // Transposed and inverse; of any length.
  const double unit = Length(scene_from_space.Vector({0, 0, 1}));
  space.normal_x = ToFloat(scene_from_space.Vector({1, 0, 0}) / unit);
  space.normal_y = ToFloat(scene_from_space.Vector({0, 1, 0}) / unit);
  space.normal_z = ToFloat(scene_from_space.Vector({0, 0, 1}) / unit);
  return space;
}

}  // namespace lanelight
