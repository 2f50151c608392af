#include "tests/kernels/shade/probe_batch.h"

#include <cmath>
#include <numbers>
#include <sstream>

#include "src/scene/compile/coat.h"
#include "src/scene/compile/materials.h"
#include "tests/reference/measured.h"
#include "tests/support/test_target.h"

namespace lanelight::test {
namespace {

using reference::LocalMaterial;

LocalMaterial Diffuse(MaterialKind kind, Scattering scattering) {
  LocalMaterial m;
  m.kind = kind;
  m.scattering = scattering;
  m.reflectance = {0.8, 0.5, 0.1};
  m.transmittance = {0.1, 0.3, 0.2};
  return m;
}
LocalMaterial Metal(double ax, double ay) {
  LocalMaterial m;
  m.kind = MaterialKind::kConductor;
  m.eta = {0.2, 0.92, 1.1};
  m.k = {3.9, 2.45, 2.14};
  m.interface = {ax, ay};
  return m;
}
LocalMaterial Glass(MaterialKind kind, double index, double ax, double ay) {
  LocalMaterial m;
  m.kind = kind;
  m.index = index;
  m.interface = {ax, ay};
  return m;
}
LocalMaterial Plastic(double index, double alpha, Rgb rho, double thickness = 0.01) {
  LocalMaterial m = Glass(MaterialKind::kCoatedDiffuse, index, alpha, alpha);
  m.reflectance = rho;
  m.thickness = thickness;
  return m;
}
LocalMaterial Lacquer(double index, double coat, double metal) {
  LocalMaterial m = Metal(coat, coat);
  m.kind = MaterialKind::kCoatedConductor;
  m.index = index;
  m.metal = {metal, metal};
  m.thickness = 0.01;
  return m;
}

LocalMaterial Hair(double beta_m, double beta_n, double tilt, double h, Rgb sigma_a) {
  LocalMaterial m;
  m.kind = MaterialKind::kHair;
  m.index = 1.55;
  m.beta_m = beta_m;
  m.beta_n = beta_n;
  m.tilt = tilt / 180 * std::numbers::pi;
  m.h = h;
  m.sigma_a = sigma_a;
  // The table has the colour that the absorption stands for, and roughness as alpha.
  const double n = beta_n;
  const double k = 5.969 - 0.215 * n + 2.532 * n * n - 10.73 * std::pow(n, 3) +
                   5.574 * std::pow(n, 4) + 0.245 * std::pow(n, 5);
  for (int c = 0; c < 3; ++c) m.reflectance[c] = std::exp(-k * std::sqrt(sigma_a[c]));
  m.interface = {beta_m, beta_n};
  m.metal = {m.tilt, 0};
  return m;
}

LocalMaterial Hazy(LocalMaterial m, double thickness, double g) {
  m.thickness = thickness;
  m.albedo = {0.9, 0.6, 0.3};
  m.g = g;
  return m;
}

LocalMaterial Measured(reference::MeasuredModel model) {
  model.thetas = 5, model.size = 12, model.normals_size = 24;
  LocalMaterial m;
  m.kind = MaterialKind::kMeasured;
  std::istringstream file(reference::MeasuredFile(model));
  m.measured = ReadMeasuredReflectance(file, "test.bsdf");
  return m;
}
// On a part of the circle.
LocalMaterial Brushed(int parts) {
  reference::MeasuredModel model = reference::MetalModel(0.5, 0.2);
  model.phis = 9, model.parts = parts;
  return Measured(model);
}

}  // namespace

TestMaterial MakeTestMaterial(const std::string& name, ShadeKind kind,
                              const LocalMaterial& m) {
  TestMaterial out{name, kind, m, {}, {}};
  out.uv_v.push_back(static_cast<float>((m.h + 1) / 2));
  MaterialTable& t = out.table;
  const bool metal =
      m.kind == MaterialKind::kConductor || m.kind == MaterialKind::kCoatedConductor;
  const Rgb color0 = metal ? m.eta : m.reflectance;
  const Rgb color1 = metal ? m.k : m.transmittance;
  const auto add = [](AlignedVector<float>& column, double v) {
    column.push_back(static_cast<float>(v));
  };
  t.kind.push_back(static_cast<std::uint32_t>(kind));
  add(t.color0_r, color0.x), add(t.color0_g, color0.y), add(t.color0_b, color0.z);
  add(t.color1_r, color1.x), add(t.color1_g, color1.y), add(t.color1_b, color1.z);
  add(t.alpha_x, m.interface.ax), add(t.alpha_y, m.interface.ay);
  add(t.alpha2_x, m.metal.ax), add(t.alpha2_y, m.metal.ay);
  add(t.eta, m.index);
  t.coat.push_back(0);
  t.coat_internal.push_back(0);
  if (m.kind == MaterialKind::kCoatedDiffuse) {
    const double alpha = std::sqrt(m.interface.ax * m.interface.ay);
    const CoatTable coat = ComputeCoatTable(alpha, m.index, m.thickness);
    for (float v : coat.transmittance) add(t.coat_transmittance, v);
    t.coat_internal[0] = coat.internal_reflectance;
  }
  add(t.coat_thickness, m.thickness);
  add(t.coat_g, m.g);
  add(t.coat_albedo_r, m.albedo.x), add(t.coat_albedo_g, m.albedo.y);
  add(t.coat_albedo_b, m.albedo.z);
  t.coat_albedo_texture.push_back(-1);
  t.coat_g_texture.push_back(-1);
  t.coat_depth.push_back(static_cast<std::uint32_t>(m.coat_max_depth));
  if (m.measured != nullptr) {
    MaterialRow row;
    row.measured = m.measured;
    AddMeasured({row}, t.measured);
  }
  return out;
}

const std::vector<TestMaterial>& TestMaterials() {
  using K = ShadeKind;
  static const std::vector<TestMaterial> materials = [] {
    std::vector<TestMaterial> list;
    const auto add = [&](const char* name, K kind, const LocalMaterial& m) {
      list.push_back(MakeTestMaterial(name, kind, m));
    };
    const MaterialKind diffuse = MaterialKind::kDiffuse;
    const MaterialKind glass = MaterialKind::kDielectric;
    add("diffuse", K::kDiffuse, Diffuse(diffuse, Scattering::kLambertian));
    add("uniform", K::kDiffuseUniform, Diffuse(diffuse, Scattering::kUniform));
    add("insphere", K::kDiffuseInSphere, Diffuse(diffuse, Scattering::kInSphere));
    add("diffuse transmission", K::kDiffuseTransmission,
        Diffuse(MaterialKind::kDiffuseTransmission, Scattering::kLambertian));
    add("mirror", K::kConductorSmooth, Metal(0, 0));
    add("metal 0.3", K::kConductorRough, Metal(0.3, 0.3));
    add("metal 0.5 x 0.15", K::kConductorRough, Metal(0.5, 0.15));
    add("glass", K::kDielectricSmooth, Glass(glass, 1.5, 0, 0));
    add("glass 0.67", K::kDielectricSmooth, Glass(glass, 0.67, 0, 0));
    add("frosted 0.3", K::kDielectricRough, Glass(glass, 1.5, 0.3, 0.3));
    add("frosted 0.4 x 0.2", K::kDielectricRough, Glass(glass, 1.33, 0.4, 0.2));
    add("frosted 0.67", K::kDielectricRough, Glass(glass, 0.67, 0.5, 0.5));
    add("thin", K::kThinDielectric, Glass(MaterialKind::kThinDielectric, 1.5, 0, 0));
    add("plastic", K::kCoatedDiffuseSmooth, Plastic(1.5, 0, {0.9, 0.5, 0.05}));
    add("white plastic", K::kCoatedDiffuseSmooth, Plastic(1.5, 0, {1, 1, 1}));
    add("plastic 0.3", K::kCoatedDiffuseRough, Plastic(1.5, 0.3, {0.9, 0.5, 0.05}));
    add("white plastic 0.2", K::kCoatedDiffuseRough, Plastic(1.5, 0.2, {1, 1, 1}));
    add("plastic 0.6, thick", K::kCoatedDiffuseRough,
        Plastic(1.8, 0.6, {0.9, 0.9, 0.5}, 0.2));
    add("lacquer 0, 0.3", K::kCoatedConductor, Lacquer(1.5, 0, 0.3));
    add("lacquer 0.3, 0", K::kCoatedConductor, Lacquer(1.5, 0.3, 0));
    add("lacquer 0.2, 0.3", K::kCoatedConductor, Lacquer(1.5, 0.2, 0.3));
    add("lacquer 0, 0", K::kCoatedConductor, Lacquer(1.5, 0, 0));
    const Rgb paint = {0.9, 0.5, 0.05};
    add("hazy plastic", K::kCoatedDiffuseMedium, Hazy(Plastic(1.5, 0, paint), 0.5, 0.4));
    add("hazy plastic 0.3", K::kCoatedDiffuseMedium,
        Hazy(Plastic(1.5, 0.3, paint), 1, -0.5));
    add("hazy lacquer 0.2, 0.3", K::kCoatedConductorMedium,
        Hazy(Lacquer(1.5, 0.2, 0.3), 0.3, 0.6));
    add("hair", K::kHair, Hair(0.3, 0.3, 2, 0.3, {0.2, 0.5, 1.4}));
    add("hair, rough, at its edge", K::kHair, Hair(0.9, 0.7, 5, -0.95, {0.1, 0.3, 2}));
    add("hair, smoother", K::kHair, Hair(0.2, 0.25, 3, -0.6, {0, 0.05, 0.2}));
    add("hazy lacquer 0, 0", K::kCoatedConductorMedium, Hazy(Lacquer(1.5, 0, 0), 0.5, 0));
    add("measured metal 0.3", K::kMeasured, Measured(reference::MetalModel(0.3, 0.3)));
    add("measured chalk", K::kMeasured, Measured(reference::ChalkModel(0.8)));
    add("measured brushed metal", K::kMeasured, Brushed(1));
    add("measured brushed metal, a half", K::kMeasured, Brushed(2));
    add("measured brushed metal, a quarter", K::kMeasured, Brushed(4));
    return list;
  }();
  return materials;
}

bool IsSpecular(ShadeKind kind) {
  return GetBsdfProbe(TestTarget(), kind).eval == nullptr;
}

ProbeBatch::ProbeBatch(std::uint32_t count) : n(count) {
  const std::size_t size = (count + kProbePadding - 1) / kProbePadding * kProbePadding;
  for (int c = 0; c < 3; ++c) {
    wo[c].assign(size, c == 2 ? 1.f : 0.f);
    wi[c].assign(size, c == 2 ? 1.f : 0.f);
    u[c].assign(size, 0.5f);
    value[c].assign(size, 0.f);
  }
  pdf.assign(size, 0.f);
  eta_scale.assign(size, 1.f);
}

void ProbeBatch::SetWo(Vec3d w) {
  for (int c = 0; c < 3; ++c) wo[c].assign(wo[c].size(), static_cast<float>(w[c]));
}
void ProbeBatch::RandomPoints(std::uint64_t seed) {
  reference::Random random(seed);
  for (auto& column : u) {  // 24 bits, as the samplers give
    for (float& v : column) v = static_cast<float>(random.Bits() >> 40) * 0x1p-24f;
  }
}
void ProbeBatch::SetWi(std::uint32_t i, Vec3d w) {
  for (int c = 0; c < 3; ++c) wi[c][i] = static_cast<float>(w[c]);
}

BsdfBatch ProbeBatch::View(const TestMaterial& material, std::uint32_t seed) {
  BsdfBatch batch;
  batch.materials = &material.table;
  batch.n = n;
  batch.seed = seed;
  batch.uv_v = material.uv_v.data();
  if (!material.wavelength.empty()) batch.wavelength = material.wavelength.data();
  for (int c = 0; c < 3; ++c) {
    batch.wo[c] = wo[c].data();
    batch.u[c] = u[c].data();
    batch.wi[c] = wi[c].data();
    batch.value[c] = value[c].data();
  }
  batch.pdf = pdf.data();
  batch.eta_scale = eta_scale.data();
  return batch;
}
void ProbeBatch::Sample(const TestMaterial& material, std::uint32_t seed) {
  GetBsdfProbe(TestTarget(), material.kind).sample(View(material, seed));
}
void ProbeBatch::Eval(const TestMaterial& material, std::uint32_t seed) {
  GetBsdfProbe(TestTarget(), material.kind).eval(View(material, seed));
}

std::vector<Vec3d> TestDirections() {
  std::vector<Vec3d> list;
  for (double degrees : {5., 50., 82., 130.}) {
    const double theta = degrees * std::numbers::pi / 180, phi = 0.7;
    list.push_back({std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                    std::cos(theta)});
  }
  return list;
}

std::vector<Vec3d> TestDirections(const std::string& target) {
  if (target == "EMU128") return {TestDirections()[3]};
  return TestDirections();
}

Vec3d RandomDirection(reference::Random& random) {
  const double z = 2 * random.Uniform() - 1;
  const double phi = 2 * std::numbers::pi * random.Uniform(), r = std::sqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

}  // namespace lanelight::test
