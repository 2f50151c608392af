#include "tests/reference/scenes.h"

#include <sstream>

#include "tests/reference/measured.h"

namespace lanelight::test {
namespace {

// The view of PointOverPlane, SphereLight and PolygonLight, and the plane they light.
SceneBuilder PlaneFromAbove(int size, double eye_height, Scattering scattering) {
  SceneBuilder b(size, size);
  b.Depth(1).Orthographic({0, 0, eye_height}, {0, 0, 0}, {0, 1, 0}, 2);
  b.AddPlane({0, 0, 0}, {0, 0, 1}, b.AddDiffuse(Grey(0.5), scattering));
  return b;
}

Material Rough(Material m, double alpha_u, double alpha_v) {
  m.uroughness.constant = alpha_u;
  m.vroughness.constant = alpha_v;
  m.remap_roughness = false;
  return m;
}

Material Make(MaterialKind kind, const char* name) {
  Material m;
  m.kind = kind;
  m.name = name;
  return m;
}

// Rough metal as a file of measured reflectance would have it.
std::shared_ptr<const MeasuredReflectance> MetalTables() {
  static const auto tables = [] {
    std::istringstream file(reference::MeasuredFile(reference::MetalModel(0.35, 0.35)));
    return ReadMeasuredReflectance(file, "metal.bsdf");
  }();
  return tables;
}

}  // namespace

SceneDescription Furnace(const Material& material, int max_depth, int size) {
  SceneBuilder b(size, size);
  b.Depth(max_depth).Orthographic({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 0.69);
  b.AddSphere({0, 0, 0}, 1, b.AddMaterial(material));
  b.AddEnvironment(Grey(1));
  return b.Build();
}

SceneDescription ClosedRoom(double albedo, int max_depth, Scattering scattering) {
  SceneBuilder b(4, 4);
  b.Depth(max_depth).Perspective({0.3, 0.2, 0.1}, {1, 0, 0}, {0, 1, 0}, 60);
  const Index wall = b.AddDiffuse(Grey(albedo), scattering);
  b.AddSphere({0, 0, 0}, 2, wall, b.AddEmission(Grey(1))).reverse_orientation = true;
  return b.Build();
}

SceneDescription ClosedBox(double albedo, int max_depth) {
  SceneBuilder b(4, 4);
  b.Depth(max_depth).Perspective({0.3, 0.2, 0.1}, {1, 0, 0}, {0, 1, 0}, 60);
  const Index wall = b.AddDiffuse(Grey(albedo));
  Shape& box = b.AddBox({-1, -2, -1}, {2, 1, 1}, wall);
  box.area_light = b.AddEmission(Grey(1));
  box.reverse_orientation = true;
  return b.Build();
}

SceneDescription PointOverPlane(Scattering scattering, int size) {
  SceneBuilder b = PlaneFromAbove(size, 5, scattering);
  b.AddPoint({0, 0, 2}, {1, 2, 3});
  return b.Build();
}

SceneDescription SphereLight(int size) {
  SceneBuilder b = PlaneFromAbove(size, 1, Scattering::kLambertian);
  b.AddSphere({0.5, 0, 2}, 0.5, b.AddDiffuse(Grey(0)), b.AddEmission(Grey(3)));
  return b.Build();
}

std::vector<Vec3d> PolygonCorners() {
  return {{-0.5, -0.25, 1.5}, {-0.5, 0.75, 2}, {1, 0.75, 2}, {1, -0.25, 1.5}};
}

SceneDescription PolygonLight(int size) {
  SceneBuilder b = PlaneFromAbove(size, 1, Scattering::kLambertian);
  const std::vector<Vec3d> c = PolygonCorners();
  // Cross(c1 - c0, c3 - c0) points down.
  b.AddQuad(c[0], c[1] - c[0], c[3] - c[0], b.AddDiffuse(Grey(0)),
            b.AddEmission(Grey(3)));
  return b.Build();
}

Vec3d FilmPoint(double x, double y, int size) {
  // Looking down -z with +y up, pbrt's left-handed camera has its right along -x ... seen
  // from the camera: right = Cross(up, forward) = Cross(+y, -z) = -x.
  return {-(4 * x / size - 2), 2 - 4 * y / size, 0};
}

Exact ConstantImage(double value) {
  return [value](int, int) { return Grey(value); };
}

Exact PixelMean(int size, const std::function<Rgb(Vec3d)>& f) {
  return [=](int x, int y) {
    constexpr int kSub = 8;
    Rgb sum;
    for (int i = 0; i < kSub * kSub; ++i) {
      sum += f(FilmPoint(x + (i % kSub + 0.5) / kSub, y + (i / kSub + 0.5) / kSub, size));
    }
    return sum / (kSub * kSub);
  };
}

SceneDescription GlassSlab(int max_depth) {
  SceneBuilder b(2, 2);
  b.Depth(max_depth).Orthographic({-5, 0, 5}, {0, 0, 0}, {0, 1, 0}, 0.01);
  const Index glass = b.AddDielectric(1.5);
  b.AddQuad({-50, -50, 0}, {100, 0, 0}, {0, 100, 0}, glass);
  b.AddQuad({-50, -50, -0.25}, {0, 100, 0}, {100, 0, 0}, glass);
  b.AddEnvironment(Grey(1));
  return b.Build();
}

SceneDescription SmallRoom(int size, int max_depth, double h) {
  SceneBuilder b(size, size);
  b.Depth(max_depth).Perspective({0, 1, 4.4}, {0, 1, 0}, {0, 1, 0}, 36);
  const Index white = b.AddDiffuse({0.7, 0.68, 0.65});
  const Index red = b.AddDiffuse({0.6, 0.08, 0.06}),
              green = b.AddDiffuse({0.1, 0.5, 0.1});
  b.AddQuad({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, white);
  b.AddQuad({-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, white);
  b.AddQuad({-1, 0, -1}, {2, 0, 0}, {0, 2, 0}, white);
  b.AddQuad({-1, 0, -1}, {0, 2, 0}, {0, 0, 2}, red);
  b.AddQuad({1, 0, -1}, {0, 0, 2}, {0, 2, 0}, green);
  b.AddBox({-0.7, 0, -0.6}, {-0.1, 1.1, 0}, white);
  b.AddSphere({0.4, 0.4, 0.3}, 0.4, b.AddConductor({0.2, 0.9, 1.1}, {3.9, 2.5, 2.2}));
  const Rgb radiance = Rgb{17, 12, 6} * (0.16 / (h * h));
  b.AddQuad({-h, 1.98, -h}, {2 * h, 0, 0}, {0, 0, 2 * h}, white, b.AddEmission(radiance));
  return b.Build();
}

SceneDescription Plate(const Material& material, int size, int max_depth) {
  SceneBuilder b(size, size);
  b.Depth(max_depth).Perspective({0, -3, 2}, {0, 0, 0}, {0, 0, 1}, 35);
  const Index body = b.AddMaterial(material), black = b.AddDiffuse(Grey(0));
  b.AddDisk({0, 0, 0}, {0, 0, 1}, 1.2, body);
  b.AddPlane({0, 0, -0.5}, {0, 0, 1}, b.AddDiffuse({0.6, 0.4, 0.3}));
  b.AddSphere({0.3, 1.4, 1.3}, 0.6, black, b.AddEmission({2, 3, 4}));
  b.AddQuad({-2, 0, 1.2}, {0, 1.5, 0}, {1.5, 0, 0}, black, b.AddEmission({3, 2, 1}));
  b.AddPoint({-0.5, -0.5, 1.5}, {0.5, 0.5, 0.4});
  b.AddEnvironment({0.4, 0.5, 0.6});
  return b.Build();
}

std::vector<Material> MaterialZoo() {
  std::vector<Material> zoo;
  for (Scattering s :
       {Scattering::kLambertian, Scattering::kUniform, Scattering::kInSphere}) {
    const char* names[] = {"lambertian", "uniform", "insphere"};
    zoo.push_back(Make(MaterialKind::kDiffuse, names[static_cast<int>(s)]));
    zoo.back().scattering = s;
    zoo.back().reflectance.constant = {0.8, 0.5, 0.2};
  }
  Material metal = Make(MaterialKind::kConductor, "smooth conductor");
  metal.eta.constant = {0.2, 0.9, 1.1};
  metal.k.constant = {3.9, 2.5, 2.2};
  zoo.push_back(metal);
  metal.name = "rough conductor";
  zoo.push_back(Rough(metal, 0.3, 0.3));
  metal.name = "anisotropic conductor";
  zoo.push_back(Rough(metal, 0.15, 0.5));
  const Material glass = Make(MaterialKind::kDielectric, "smooth dielectric");
  zoo.push_back(glass);
  zoo.push_back(Rough(Make(MaterialKind::kDielectric, "rough dielectric"), 0.3, 0.3));
  zoo.push_back(Make(MaterialKind::kThinDielectric, "thin dielectric"));
  Material coat = Make(MaterialKind::kCoatedDiffuse, "smooth coated diffuse");
  coat.reflectance.constant = {0.8, 0.5, 0.2};
  zoo.push_back(coat);
  coat.name = "rough coated diffuse";
  zoo.push_back(Rough(coat, 0.3, 0.3));
  Material coated_metal = Make(MaterialKind::kCoatedConductor, "coated conductor");
  coated_metal.eta.constant = metal.eta.constant;
  coated_metal.k.constant = metal.k.constant;
  coated_metal.conductor_uroughness.constant = 0.25;
  coated_metal.conductor_vroughness.constant = 0.25;
  zoo.push_back(Rough(coated_metal, 0, 0));
  const auto haze = [](Material clear, const char* name) {
    clear.name = name;
    clear.thickness = 0.5;
    clear.coat_albedo.constant = {0.9, 0.6, 0.3};
    clear.coat_g.constant = 0.4;
    return clear;
  };
  zoo.push_back(haze(coat, "hazy coated diffuse"));
  zoo.push_back(Rough(haze(coated_metal, "hazy coated conductor"), 0.3, 0.3));
  Material leaf = Make(MaterialKind::kDiffuseTransmission, "diffuse transmission");
  leaf.reflectance.constant = {0.4, 0.3, 0.2};
  leaf.transmittance.constant = {0.2, 0.3, 0.5};
  zoo.push_back(leaf);
  Material hair = Make(MaterialKind::kHair, "hair");
  hair.interface_eta = 1.55;
  hair.sigma_a = {0.1, 0.3, 0.8};
  zoo.push_back(hair);
  Material measured = Make(MaterialKind::kMeasured, "measured metal");
  measured.measured = MetalTables();
  zoo.push_back(measured);
  return zoo;
}

}  // namespace lanelight::test
