#include <utility>

#include "tests/reference/frame.h"
#include "tests/reference/scenes.h"

namespace lanelight::test {
namespace {

// Moves the origin to `point` and +z to `normal`.
Transform Place(Vec3d point, Vec3d normal) {
  const reference::TangentFrame f = reference::MakeFrame(Normalize(normal));
  return Transform({{{f.x.x, f.y.x, f.z.x, point.x},
                     {f.x.y, f.y.y, f.z.y, point.y},
                     {f.x.z, f.y.z, f.z.z, point.z},
                     {0, 0, 0, 1}}});
}

}  // namespace

SceneBuilder::SceneBuilder(int width, int height) {
  scene_.path = "test";
  scene_.film.width = width;
  scene_.film.height = height;
  scene_.filter.kind = FilterKind::kBox;
  scene_.filter.x_radius = scene_.filter.y_radius = 0.5;
  scene_.strategy.sampler = SampleSequence::kIndependent;
}

SceneBuilder& SceneBuilder::Depth(int max_depth) {
  scene_.integrator.max_depth = max_depth;
  return *this;
}

SceneBuilder& SceneBuilder::Perspective(Vec3d eye, Vec3d look, Vec3d up, double fov) {
  scene_.camera.kind = CameraKind::kPerspective;
  scene_.camera.fov = fov;
  scene_.camera.world_from_camera = Transform::LookAt(eye, look, up).Inverse();
  return *this;
}

SceneBuilder& SceneBuilder::Orthographic(Vec3d eye, Vec3d look, Vec3d up,
                                         double half_size) {
  scene_.camera.kind = CameraKind::kOrthographic;
  scene_.camera.world_from_camera = Transform::LookAt(eye, look, up).Inverse();
  const double aspect = static_cast<double>(scene_.film.width) / scene_.film.height;
  const double x = half_size * std::max(1.0, aspect);
  const double y = half_size * std::max(1.0, 1 / aspect);
  const double window[4] = {-x, x, -y, y};
  std::copy(window, window + 4, scene_.camera.screen_window);
  return *this;
}

SceneBuilder& SceneBuilder::Lens(double radius, double focal_distance) {
  scene_.camera.lens_radius = radius;
  scene_.camera.focal_distance = focal_distance;
  return *this;
}

Index SceneBuilder::AddMaterial(const Material& material) {
  scene_.materials.push_back(material);
  return static_cast<Index>(scene_.materials.size()) - 1;
}

Index SceneBuilder::AddDiffuse(Rgb albedo, Scattering scattering) {
  Material m;
  m.reflectance.constant = albedo;
  m.scattering = scattering;
  return AddMaterial(m);
}

Index SceneBuilder::AddConductor(Rgb eta, Rgb k, double alpha) {
  Material m;
  m.kind = MaterialKind::kConductor;
  m.eta.constant = eta;
  m.k.constant = k;
  m.uroughness.constant = m.vroughness.constant = alpha;
  m.remap_roughness = false;
  return AddMaterial(m);
}

Index SceneBuilder::AddDielectric(double eta, double alpha) {
  Material m;
  m.kind = MaterialKind::kDielectric;
  m.interface_eta = eta;
  m.uroughness.constant = m.vroughness.constant = alpha;
  m.remap_roughness = false;
  return AddMaterial(m);
}

Index SceneBuilder::AddEmission(Rgb radiance, bool two_sided) {
  AreaLight light;
  light.radiance = radiance;
  light.two_sided = two_sided;
  scene_.area_lights.push_back(light);
  return static_cast<Index>(scene_.area_lights.size()) - 1;
}

Shape& SceneBuilder::Add(Shape shape, Index material, Index light) {
  shape.material = material;
  shape.area_light = light;
  scene_.shapes.push_back(std::move(shape));
  return scene_.shapes.back();
}

Shape& SceneBuilder::AddSphere(Vec3d center, double radius, Index material, Index light) {
  Shape shape;
  shape.kind = ShapeKind::kSphere;
  shape.radius = radius;
  shape.world_from_object = Transform::Translate(center);
  return Add(std::move(shape), material, light);
}

Shape& SceneBuilder::AddDisk(Vec3d center, Vec3d normal, double radius, Index material,
                             Index light) {
  Shape shape;
  shape.kind = ShapeKind::kDisk;
  shape.radius = radius;
  shape.world_from_object = Place(center, normal);
  return Add(std::move(shape), material, light);
}

Shape& SceneBuilder::AddPlane(Vec3d point, Vec3d normal, Index material) {
  Shape shape;
  shape.kind = ShapeKind::kPlane;
  shape.world_from_object = Place(point, normal);
  return Add(std::move(shape), material, kNone);
}

Shape& SceneBuilder::AddMesh(const TriangleMesh& mesh, Index material, Index light) {
  Shape shape;
  shape.mesh = std::make_shared<TriangleMesh>(mesh);
  return Add(std::move(shape), material, light);
}

Shape& SceneBuilder::AddQuad(Vec3d corner, Vec3d e1, Vec3d e2, Index material,
                             Index light) {
  TriangleMesh mesh;
  mesh.positions = {corner, corner + e1, corner + e1 + e2, corner + e2};
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return AddMesh(mesh, material, light);
}

Shape& SceneBuilder::AddBox(Vec3d low, Vec3d high, Index material) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.positions.push_back(
        {i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
  }
  // Two triangles per face, wound so that the normals point out of the box.
  mesh.indices = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                  2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  return AddMesh(mesh, material);
}

void SceneBuilder::AddPoint(Vec3d from, Rgb intensity) {
  Light light;
  light.kind = LightKind::kPoint;
  light.from = from;
  light.emission = intensity;
  scene_.lights.push_back(light);
}

void SceneBuilder::AddSpot(Vec3d from, Vec3d to, Rgb intensity, double cone,
                           double delta) {
  AddPoint(from, intensity);
  scene_.lights.back().kind = LightKind::kSpot;
  scene_.lights.back().to = to;
  scene_.lights.back().cone_angle = cone;
  scene_.lights.back().cone_delta = delta;
}

void SceneBuilder::AddDistant(Vec3d toward, Rgb irradiance) {
  AddPoint(toward, irradiance);
  scene_.lights.back().kind = LightKind::kDistant;
  scene_.lights.back().to = {0, 0, 0};
}

void SceneBuilder::AddEnvironment(Rgb radiance) {
  AddPoint({}, radiance);
  scene_.lights.back().kind = LightKind::kInfinite;
}

}  // namespace lanelight::test
