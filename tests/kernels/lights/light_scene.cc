#include <cmath>

#include "src/base/core/pi.h"
#include "src/scene/compile/environment.h"
#include "tests/kernels/lights/light_truth.h"
#include "tests/support/wave_fixture.h"

namespace lanelight::test {
namespace {

void Store(Vec3d v, float* out) {
  for (int i = 0; i < 3; ++i) out[i] = static_cast<float>(v[i]);
}

// An image with dark corners and a bright texel, so that probabilities differ widely.
Environment Sky(int size, double turn, Vec3d scale) {
  Image image = MakeImage(size, size, {"R", "G", "B"});
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      for (int c = 0; c < 3; ++c) image.At(x, y, c) = 0.2f + (x * 3 + y * 5 + c) % 7;
    }
  }
  image.At(size / 2, size / 3, 0) = 30;
  Light light;
  light.kind = LightKind::kInfinite;
  light.world_from_light = Transform::Rotate(turn, {1, 2, -1}) * Transform::Scale(scale);
  return CompileEnvironment(light, image);
}

}  // namespace

LightRecord FlatLight(LightShape shape, Vec3d corner, Vec3d x, Vec3d y) {
  LightRecord record{};
  record.shape = static_cast<std::uint32_t>(shape);
  record.environment = -1;
  const bool rectangle = shape == LightShape::kRectangle;
  record.area = static_cast<float>(Length(Cross(x, y)) / (rectangle ? 1 : 2));
  if (!rectangle) return record;
  record.second_primitive = 1;
  Store(corner, record.position);
  Store(Normalize(x), record.direction);
  Store(Normalize(y), record.side);
  record.size[0] = static_cast<float>(Length(x));
  record.size[1] = static_cast<float>(Length(y));
  return record;
}

LightScene::LightScene() {
  AddShapes();
  const PrimitiveRanges& r = scene.geometry.ranges;
  const auto disk_area = [](double outer, double inner) {
    return kPi * (outer * outer - inner * inner);
  };
  AddLight("triangle", LightShape::kTriangle, 1, 0);
  AddLight("two-sided triangle", LightShape::kTriangle, 2, 0);
  AddLight("sphere", LightShape::kSphere, r.spheres + 1, 4 * kPi * 0.49);
  AddLight("room of a sphere", LightShape::kSphere, r.spheres + 2, 4 * kPi * 400);
  AddLight("two-sided sphere", LightShape::kSphere, r.spheres + 3, 4 * kPi * 225);
  AddLight("tiny sphere", LightShape::kSphere, r.spheres + 4, 4 * kPi * 1e-6);
  AddLight("sphere that emits inward", LightShape::kSphere, r.spheres + 5, 4 * kPi);
  AddLight("ring", LightShape::kDisk, r.disks + 1, disk_area(1.2, 0.5));
  AddLight("two-sided disk", LightShape::kDisk, r.disks + 2, disk_area(0.8, 0));
  AddLight("point", LightShape::kPoint, 0xffffffffu, 0);
  AddLight("spot", LightShape::kSpot, 0xffffffffu, 0);
  AddLight("distant", LightShape::kDistant, 0xffffffffu, 0);
  AddLight("constant sky", LightShape::kInfiniteConstant, 0xffffffffu, 0);
  AddLight("sky", LightShape::kInfiniteImage, 0xffffffffu, 0);
  AddLight("another sky", LightShape::kInfiniteImage, 0xffffffffu, 0);
  scene.lights.environments = {Sky(4, 0, {1, 1, 1}), Sky(13, 70, {-0.6, 1.4, 1})};
  for (const Environment& e : scene.lights.environments) {
    chances.environments.push_back(e.table);
  }
  lights[13].record.environment = 0, lights[14].record.environment = 1;
  AddRectangle();
  StoreRecords();
}

void LightScene::AddShapes() {
  Geometry g;
  g.triangles = {MakeTriangle({9, 9, 9}, {9, 8, 9}, {9, 9, 8}),
                 MakeTriangle({-1, -1, 3}, {0.5f, 1.5f, 2.5f}, {1, -1, 3.5f}),
                 MakeTriangle({2, -1, 0.5f}, {2.2f, 1, 0}, {1.9f, 0, 2}),
                 MakeTriangle({-9, 9, 9}, {9, -8, 9}, {9, 9, -8}),
                 MakeTriangle({-2, 1, 0.5f}, {-2, -0.5f, 1.5f}, {-1, 1, 0.5f}),
                 MakeTriangle({-1, -0.5f, 1.5f}, {-1, 1, 0.5f}, {-2, -0.5f, 1.5f})};
  g.spheres = {MakeSphere({8, 0, 0}, 1),     MakeSphere({0, 0, 4}, 0.7f),
               MakeSphere({0, 0, 0}, 20),    MakeSphere({0.5f, 0, 0}, 15),
               MakeSphere({3, 3, 3}, 1e-3f), MakeSphere({-3, 0, 1}, 1)};
  g.spheres[2].normal_sign = g.spheres[5].normal_sign = -1;
  g.disks = {MakeDisk({0, 8, 0}, {0, 1, 0}, 1),
             MakeDisk({0.5f, 3, 0}, {0.1f, -1, 0.2f}, 1.2f, 0.5f),
             MakeDisk({0, -3, 0.5f}, {0.3f, -1, 0}, 0.8f)};
  g.planes = {MakePlane({0, 0, -9}, {0, 0, 1})};
  scene = MakeScene(std::move(g));
}

// The last two triangles.
void LightScene::AddRectangle() {
  AddLight("rectangle", LightShape::kRectangle, 4, 0);
  LightRecord& light = lights.back().record;
  LightRecord flat =
      FlatLight(LightShape::kRectangle, {-2, 1, 0.5}, {0, -1.5, 1}, {1, 0, 0});
  std::copy_n(light.radiance, 3, flat.radiance);
  flat.primitive = 4, flat.second_primitive = 5;
  light = flat;
}

void LightScene::AddLight(const char* name, LightShape shape, std::uint32_t primitive,
                          double area) {
  const auto i = static_cast<int>(lights.size());
  LightRecord record{};
  record.shape = static_cast<std::uint32_t>(shape);
  record.two_sided = std::string(name).rfind("two-sided", 0) == 0;
  record.primitive = primitive;
  record.environment = -1;
  Store({1 + 0.5 * i, 2 + 0.25 * i, 3 - 0.125 * i}, record.radiance);
  if (shape == LightShape::kInfiniteImage) Store({1, 1, 1}, record.radiance);
  Store({1, 2, 1.5}, record.position);
  Store(Normalize(Vec3d{-0.4, -0.8, -0.5}), record.direction);
  record.versine_total = 0.5f, record.versine_falloff = 0.1f;
  if (shape == LightShape::kTriangle) {
    const TriangleRecord& t = scene.geometry.triangles[primitive];
    const auto side = [&](int k) {
      return Vec3d{t.p[k][0], t.p[k][1], t.p[k][2]} -
             Vec3d{t.p[0][0], t.p[0][1], t.p[0][2]};
    };
    area = Length(Cross(side(1), side(2))) / 2;
  }
  if (shape == LightShape::kSphere) {
    const SphereRecord& sphere =
        scene.geometry.spheres[primitive - scene.geometry.ranges.spheres];
    record.size[0] = ConeFrom(sphere.radius);
  }
  record.area = static_cast<float>(area);
  lights.push_back({name, record, 0.02f + 0.005f * static_cast<float>(i)});
}

// Records into the table, and what shapes and escaped rays know of them.
void LightScene::StoreRecords() {
  Geometry& g = scene.geometry;
  for (auto& t : g.triangles) t.light = -1;
  for (auto& s : g.spheres) s.light = -1;
  for (auto& d : g.disks) d.light = -1;
  scene.lights.lights.clear();
  scene.lights.infinite.clear();
  chances.pmf.clear();
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const LightRecord& r = lights[i].record;
    const auto index = static_cast<std::int32_t>(i);
    scene.lights.lights.push_back(r);
    chances.pmf.push_back(lights[i].pmf);
    switch (static_cast<LightShape>(r.shape)) {
      case LightShape::kTriangle:
        g.triangles[r.primitive].light = index;
        break;
      case LightShape::kRectangle:
        g.triangles[r.primitive].light = g.triangles[r.second_primitive].light = index;
        break;
      case LightShape::kSphere:
        g.spheres[r.primitive - g.ranges.spheres].light = index;
        break;
      case LightShape::kDisk:
        g.disks[r.primitive - g.ranges.disks].light = index;
        break;
      case LightShape::kInfiniteConstant:
      case LightShape::kInfiniteImage:
        scene.lights.infinite.push_back(static_cast<std::uint32_t>(i));
        break;
      default:
        break;
    }
  }
}

void LightScene::Keep(std::size_t i) {
  lights = {lights[i]};
  StoreRecords();
}

void LightScene::AddOthers(int count) {
  for (int i = 0; i < count; ++i) {
    AddLight("another point", LightShape::kPoint, 0xffffffffu, 0);
  }
  StoreRecords();
}

}  // namespace lanelight::test
