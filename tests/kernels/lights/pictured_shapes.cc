#include "tests/kernels/lights/pictured_shapes.h"

#include "tests/kernels/lights/image_strategies.h"
#include "tests/kernels/lights/pictures.h"
#include "tests/reference/scenes.h"

namespace lanelight::test {
namespace {

template <class Add>
SceneDescription OnlyPictured(const Add& add) {
  SceneBuilder b(4, 4);
  b.Depth(2).Perspective({0, -4, 2}, {0, 0, 0}, {0, 0, 1}, 50);
  const Index light = b.AddEmission({2, 3, 1}, true);
  b.scene().area_lights[0].image_path = Picture("wide.exr", kWide, kHigh, Patchwork);
  add(b, b.AddDiffuse(Grey(0)), light);
  b.AddPoint({3, 3, 3}, Grey(1));
  return b.Build();
}

SceneDescription PicturedMesh(const TriangleMesh& mesh) {
  return OnlyPictured([&](SceneBuilder& b, Index material, Index light) {
    b.AddMesh(mesh, material, light);
  });
}

TriangleMesh UnevenTriangle() {
  TriangleMesh mesh;
  mesh.positions = {{-0.7, -0.4, 0.1}, {0.9, -0.2, 0}, {0.1, 0.3, 0.8}};
  mesh.uvs = {{0.9, 0.1}, {0.2, 0.3}, {0.4, 1.2}};
  mesh.indices = {0, 1, 2};
  return mesh;
}

TriangleMesh UnevenRectangle() {
  TriangleMesh mesh;
  mesh.positions = {{-0.6, 0, -0.4}, {0.6, 0, -0.4}, {0.6, 0, 0.4}, {-0.6, 0, 0.4}};
  mesh.uvs = {{0.05, 0.1}, {0.6, 0.3}, {0.95, 0.7}, {0.5, 1}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

Texture PictureOf(const AreaLight& light) {
  Texture picture;
  picture.kind = TextureKind::kImage;
  picture.path = light.image_path;
  picture.wrap = WrapMode::kClamp;
  return picture;
}

}  // namespace

std::vector<PicturedShape> PicturedShapes() {
  const std::vector<Vec3d> around = {{0.8, -1.6, 0.9}, {-0.5, 0.7, -0.6}};
  const SceneDescription ring =
      OnlyPictured([](SceneBuilder& b, Index material, Index light) {
        b.AddDisk({}, {0.1, 1, 0.3}, 0.7, material, light).inner_radius = 0.2;
      });
  const SceneDescription sphere =
      OnlyPictured([](SceneBuilder& b, Index material, Index light) {
        b.AddSphere({}, 0.5, material, light).world_from_object =
            Transform::Rotate(50, {1, 2, 0.5}) * Transform::Scale({1, -1, 1});
      });
  std::vector<PicturedShape> shapes = {
      {"triangle", PicturedMesh(UnevenTriangle()), {0.1, -0.1, 0.3}, 1, around},
      {"rectangle", PicturedMesh(UnevenRectangle()), {}, 0.8, around},
      {"ring", ring, {}, 0.75, around},
      {"sphere", sphere, {}, 0.55, {around[0], {0.1, 0.2, -0.1}}}};
  for (int k = 0; k < 2; ++k) {
    PicturedShape by_angle = shapes[std::size_t(k)];
    by_angle.name += " by solid angle";
    by_angle.solid_angle = true;
    shapes.push_back(by_angle);
  }
  return shapes;
}

PictureTruth::PictureTruth(const PicturedShape& shape)
    : radiance_(shape.scene.area_lights[0].radiance),
      images_({PictureOf(shape.scene.area_lights[0])}),
      textures_(images_),
      geometry_(shape.scene, {}) {}

Rgb PictureTruth::Along(Vec3d from, Vec3d d) const {
  const reference::Ray ray = {from, d, kNone};
  reference::Hit nearest;
  for (std::size_t k = 0; k < geometry_.primitives().size(); ++k) {
    reference::Hit hits[2];
    const int count =
        reference::IntersectPrimitive(geometry_.primitives()[k], ray, false, hits);
    for (int h = 0; h < count; ++h) {
      if (hits[h].t >= nearest.t) continue;
      nearest = hits[h];
      nearest.primitive = static_cast<int>(k);
    }
  }
  if (nearest.primitive == kNone) return {};
  const reference::SurfacePoint at = geometry_.Describe(ray, nearest);
  return radiance_ * textures_.Eval(0, {at.u, at.v, at.p, at.ng});
}

}  // namespace lanelight::test
