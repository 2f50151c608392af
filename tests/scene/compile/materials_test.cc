#include "src/scene/compile/materials.h"

#include <catch2/catch.hpp>

#include <cmath>

#include "src/scene/compile/coat.h"
#include "src/scene/compile/spectrum_rows.h"
#include "tests/scene/compile/testing.h"

namespace lanelight {
namespace {

// The table of one material.
MaterialTable Compile(const Material& m, const CompileOptions& options = {}) {
  SceneDescription d;
  AddMaterial(d, m);
  return CompileMaterials(d, {0}, options).table;
}

ShadeKind KindOf(const MaterialTable& table, std::size_t i = 0) {
  return static_cast<ShadeKind>(table.kind[i]);
}

Texture Checker() {
  Texture texture;
  texture.kind = TextureKind::kCheckerboard;
  return texture;
}

Texture Constant(Rgb value) {
  Texture texture;
  texture.value = value;
  return texture;
}

TEST_CASE("compile: diffuse kinds and the override", "[scene][compile]") {
  Material m;
  m.reflectance.constant = {0.25, 0.5, 2};
  CHECK(KindOf(Compile(m)) == ShadeKind::kDiffuse);
  CHECK(Compile(m).color0_r[0] == 0.25f);
  CHECK(Compile(m).color0_b[0] == 1.0f);  // clamped, as pbrt
  m.scattering = Scattering::kInSphere;
  CHECK(KindOf(Compile(m)) == ShadeKind::kDiffuseInSphere);
  CompileOptions options;
  options.scattering = Scattering::kUniform;
  CHECK(KindOf(Compile(m, options)) == ShadeKind::kDiffuseUniform);
  options.scattering = Scattering::kLambertian;
  CHECK(KindOf(Compile(m, options)) == ShadeKind::kDiffuse);
}

TEST_CASE("compile: roughness decides the kind", "[scene][compile]") {
  struct Case {
    double u, v;
    bool remap, smooth;
    double alpha_x, alpha_y;
  };
  for (const Case& c :
       {Case{0, 0, false, true, 1e-4, 1e-4},
        Case{9.99e-4, 5e-4, false, true, 9.99e-4, 5e-4},
        Case{1e-3, 0, false, false, 1e-3, 1e-4}, Case{0.04, 0.09, true, false, 0.2, 0.3},
        Case{1e-7, 1e-7, true, true, 3.1623e-4, 3.1623e-4},
        Case{1e-6, 1.1e-6, true, false, 1e-3, 1.0488e-3},
        Case{0.3, 0.3, false, false, 0.3, 0.3}}) {
    INFO(c.u << " " << c.v << " remap " << c.remap);
    for (MaterialKind kind : {MaterialKind::kConductor, MaterialKind::kDielectric,
                              MaterialKind::kCoatedDiffuse}) {
      Material m = OfKind(kind);
      m.uroughness.constant = c.u;
      m.vroughness.constant = c.v;
      m.remap_roughness = c.remap;
      const MaterialTable table = Compile(m);
      const ShadeKind smooth =
          kind == MaterialKind::kConductor    ? ShadeKind::kConductorSmooth
          : kind == MaterialKind::kDielectric ? ShadeKind::kDielectricSmooth
                                              : ShadeKind::kCoatedDiffuseSmooth;
      const ShadeKind rough =
          kind == MaterialKind::kConductor    ? ShadeKind::kConductorRough
          : kind == MaterialKind::kDielectric ? ShadeKind::kDielectricRough
                                              : ShadeKind::kCoatedDiffuseRough;
      CHECK(KindOf(table) == (c.smooth ? smooth : rough));
      CHECK(table.alpha_x[0] == Approx(c.alpha_x).epsilon(1e-4));
      CHECK(table.alpha_y[0] == Approx(c.alpha_y).epsilon(1e-4));
    }
  }
}

TEST_CASE("compile: dielectrics", "[scene][compile]") {
  Material m = OfKind(MaterialKind::kDielectric);
  m.interface_eta = 1.33;
  CHECK(Compile(m).eta[0] == 1.33f);
  m.uroughness.constant = m.vroughness.constant = 0.5;
  CHECK(KindOf(Compile(m)) == ShadeKind::kDielectricRough);
  m.interface_eta = 1;  // nothing to see
  CHECK(KindOf(Compile(m)) == ShadeKind::kDielectricSmooth);
  m.interface_eta = 1 + 1e-5;
  CHECK(KindOf(Compile(m)) == ShadeKind::kDielectricRough);
  m.interface_eta = 0;
  CHECK_THROWS_WITH(Compile(m), Catch::Contains("index of refraction 0"));
  m = OfKind(MaterialKind::kThinDielectric);
  CHECK(KindOf(Compile(m)) == ShadeKind::kThinDielectric);
  CHECK(Compile(m).eta[0] == 1.5f);
}

TEST_CASE("compile: hair absorbs by its spectrum", "[scene][compile]") {
  Material m = OfKind(MaterialKind::kHair);
  m.sigma_a = {3, 0.1, 3};
  m.sigma_a_spectrum = std::make_shared<const Spectrum>(
      [](double nm) { return nm > 520 && nm < 560 ? 0.05 : 3.0; });
  SceneDescription d;
  AddMaterial(d, m);
  d.integrator.transport = Transport::kSpectral;
  SpectrumRows rows;
  const CompiledMaterials compiled = CompileMaterials(d, {0}, {}, &rows);
  const std::size_t first =
      static_cast<std::size_t>(compiled.table.color0_spectrum[0]) * kWavelengthBins;
  const SpectrumTable table = rows.Finish();
  // The reflectance of much hair that absorbs so, with a roughness around it of 0.3.
  const double k = 5.969 - 0.215 * 0.3 + 2.532 * 0.09 - 10.73 * 0.027 + 5.574 * 0.0081 +
                   0.245 * 0.00243;
  int green = 0;
  for (std::size_t b = 0; b < kWavelengthBins; ++b) {
    const double low = CarriedWavelengths().edge[b],
                 high = CarriedWavelengths().edge[b + 1];
    if ((low < 520 && high > 520) || (low < 560 && high > 560)) continue;
    const double sigma = low >= 520 && high <= 560 ? 0.05 : 3;
    green += sigma < 1;
    CAPTURE(low, high);
    CHECK(table.rows[first + b] == Approx(std::exp(-k * std::sqrt(sigma))).epsilon(1e-4));
  }
  CHECK(green > 3);
}

TEST_CASE("compile: regularized materials are appended as rougher rows",
          "[scene][compile]") {
  SceneDescription d;
  d.integrator.regularize = true;
  Material glass = OfKind(MaterialKind::kDielectric);
  Material metal = OfKind(MaterialKind::kConductor);
  metal.remap_roughness = false;
  metal.uroughness.constant = 0.12, metal.vroughness.constant = 0.4;
  for (const Material& m : {glass, OfKind(MaterialKind::kDiffuse), metal}) {
    AddMaterial(d, m);
  }
  const MaterialTable table = CompileMaterials(d, {0, 1, 2}, {}).table;
  REQUIRE(table.regular == AlignedVector<std::int32_t>{3, 1, 4, 3, 4});
  CHECK(KindOf(table, 0) == ShadeKind::kDielectricSmooth);
  CHECK(KindOf(table, 3) == ShadeKind::kDielectricRough);
  CHECK(table.alpha_x[3] == 0.1f);
  CHECK(table.alpha_x[4] == 0.24f);
  CHECK(table.alpha_y[4] == 0.4f);
  d.integrator.regularize = false;
  CHECK(CompileMaterials(d, {0, 1, 2}, {}).table.regular.empty());
}

TEST_CASE("compile: conductors", "[scene][compile]") {
  Material m = OfKind(MaterialKind::kConductor);
  m.eta.constant = {0.2, 0.9, 1.1};
  m.k.constant = {3.9, 2.4, 2.1};
  CHECK(Compile(m).color0_g[0] == 0.9f);
  CHECK(Compile(m).color1_b[0] == 2.1f);
  // Given by normal reflectance: ((eta-1)^2 + k^2) / ((eta+1)^2 + k^2) = r.
  m.has_reflectance = true;
  m.reflectance.constant = {0.5, 0.04, 1};
  const MaterialTable table = Compile(m);
  CHECK(table.color0_r[0] == 1);
  CHECK(table.color1_r[0] == 2);
  for (const auto& [k, r] : {std::pair{table.color1_r[0], 0.5},
                             {table.color1_g[0], 0.04},
                             {table.color1_b[0], 0.9999}}) {
    CHECK(double(k) * k / (4 + double(k) * k) == Approx(r));
  }
  SceneDescription d;
  AddTexture(d, Checker());
  m.reflectance.texture = 0;
  AddMaterial(d, m);
  // A textured one becomes a texture of k.
  const CompiledMaterials textured = CompileMaterials(d, {0}, {});
  REQUIRE(textured.derived.size() == 1);
  CHECK(textured.table.color1_texture[0] == 1);
  CHECK(textured.table.color0_texture[0] == kNone);
  CHECK(textured.table.color0_r[0] == 1);
  CHECK(textured.derived[0].kind == TextureKind::kMetalExtinction);
  CHECK(textured.derived[0].tex1.texture == 0);
}

TEST_CASE("compile: coats", "[scene][compile]") {
  SceneDescription d;
  Material m = OfKind(MaterialKind::kCoatedConductor);
  m.remap_roughness = false;
  m.eta.constant = {3, 3, 3};
  m.k.constant = {1.5, 3, 0};
  m.uroughness.constant = m.vroughness.constant = 0.2;
  m.conductor_uroughness.constant = 0.3;
  m.conductor_vroughness.constant = 0.4;
  AddMaterial(d, m);  // 0
  m.kind = MaterialKind::kCoatedDiffuse;
  m.reflectance.constant = {0.1, 0.2, 0.3};
  AddMaterial(d, m);  // 1: the same coat
  m.uroughness.constant = 0.8;
  m.vroughness.constant = 0.05;
  AddMaterial(d, m);  // 2: alpha sqrt(0.8 * 0.05) = 0.2, the same table
  m.interface_eta = 1.7;
  AddMaterial(d, m);  // 3: another
  const MaterialTable t = CompileMaterials(d, {0, 1, 2, 3}, {}).table;
  CHECK(KindOf(t, 0) == ShadeKind::kCoatedConductor);
  CHECK(t.color0_r[0] == 2);  // relative to the coat: 3 / 1.5
  CHECK(t.color1_r[0] == 1);
  CHECK(t.color1_g[0] == 2);
  CHECK(t.alpha2_x[0] == 0.3f);
  CHECK(t.alpha2_y[0] == 0.4f);
  // The base stands for its spectrum (coat.h): near the colour, not equal to it.
  CHECK(t.color0_b[1] == Approx(0.3f).margin(0.01));
  CHECK(t.color0_b[1] != 0.3f);
  CHECK(t.coat[0] == 0);
  CHECK(t.coat[1] == 0);
  CHECK(t.coat[3] == t.coat.back());
  CHECK(t.coat_transmittance.size() % kCoatTableSize == 0);
  const CoatTable expected = ComputeCoatTable(0.2, 1.5, 0.01);
  CHECK(t.coat_internal[1] == expected.internal_reflectance);
  for (int i = 0; i < kCoatTableSize; ++i) {
    CHECK(t.coat_transmittance[static_cast<std::size_t>(i)] == expected.transmittance[i]);
  }
  CHECK(t.coat[3] % kCoatTableSize == 0);
  const double alpha = std::sqrt(0.8 * 0.05);
  CHECK(t.coat_internal[3] == ComputeCoatTable(alpha, 1.7, 0.01).internal_reflectance);
  CHECK(t.coat_thickness[0] == 0.01f);
  CHECK(t.coat_depth[0] == 10);
}

TEST_CASE("compile: coats with a scattering medium have their own kinds", "[compile]") {
  Material m = OfKind(MaterialKind::kCoatedDiffuse);
  m.coat_albedo.constant = {0.1, 0, 2};
  m.coat_g.constant = 0.3;
  m.uroughness.constant = m.vroughness.constant = 0.25;
  MaterialTable t = Compile(m);
  CHECK(KindOf(t, 0) == ShadeKind::kCoatedDiffuseMedium);
  CHECK(t.coat_albedo_r[0] == 0.1f);
  CHECK(t.coat_albedo_b[0] == 1.0f);
  CHECK(t.coat_g[0] == 0.3f);
  CHECK(t.alpha_x[0] == 0.5f);
  m.kind = MaterialKind::kCoatedConductor;
  t = Compile(m);
  CHECK(KindOf(t, 0) == ShadeKind::kCoatedConductorMedium);
  CHECK(t.coat_albedo_r[0] == 0.1f);
  CHECK(t.coat_albedo_b[0] == 1.0f);
  m.interface_eta = 1;  // no interface, hence none that is rough
  CHECK(Compile(m).alpha_x[0] < 1e-3f);
  m.coat_albedo.constant = {};
  CHECK(KindOf(Compile(m), 0) == ShadeKind::kCoatedConductor);
}

TEST_CASE("compile: constant textures become constants", "[scene][compile]") {
  SceneDescription d;
  const Index red = AddTexture(d, Constant({1, 0, 0}));
  const Index blue = AddTexture(d, Constant({0, 0, 1}));
  Texture mix;
  mix.kind = TextureKind::kMix;
  mix.tex1.texture = red;
  mix.tex2.texture = blue;
  mix.amount.constant = 0.25;
  const Index mixed = AddTexture(d, mix);
  Texture scale;
  scale.kind = TextureKind::kScale;
  scale.tex1.texture = mixed;
  scale.amount.texture = AddTexture(d, Constant({0.5, 0.5, 0.5}));
  const Index scaled = AddTexture(d, scale);
  Material m;
  m.reflectance.texture = scaled;
  AddMaterial(d, m);
  const CompiledMaterials c = CompileMaterials(d, {0}, {});
  CHECK(c.table.color0_r[0] == 0.375f);
  CHECK(c.table.color0_g[0] == 0.0f);
  CHECK(c.table.color0_b[0] == 0.125f);
  CHECK(c.table.color0_texture[0] == -1);
  CHECK(c.textures.empty());
  // One image or checkerboard anywhere below makes it a texture.
  d.textures[static_cast<std::size_t>(blue)] = Checker();
  const CompiledMaterials t = CompileMaterials(d, {0}, {});
  CHECK(t.table.color0_texture[0] == scaled);
  CHECK(t.textures == std::vector<Index>{scaled});
}

TEST_CASE("compile: mixes", "[scene][compile]") {
  SceneDescription d;
  Material grey;
  AddMaterial(d, grey);                               // 0
  AddMaterial(d, OfKind(MaterialKind::kDielectric));  // 1
  AddMaterial(d, grey);                               // 2: unused
  Material mix = OfKind(MaterialKind::kMix);
  mix.mix[0] = 0;
  mix.mix[1] = 1;
  mix.mix_amount.constant = 0.3;
  AddMaterial(d, mix);  // 3
  const CompiledMaterials c = CompileMaterials(d, {3}, {});
  REQUIRE(c.table.size() == 3);
  CHECK(c.index[2] == -1);
  const auto at = static_cast<std::size_t>(c.index[3]);
  CHECK(KindOf(c.table, at) == ShadeKind::kMix);
  CHECK(c.table.alpha_x[at] == 0.3f);
  CHECK(c.table.mix0[at] == c.index[0]);
  CHECK(c.table.mix1[at] == c.index[1]);
  CHECK(c.table.names[at] == "m3");
  // A weight of 0 or 1 is no mix.
  d.materials[3].mix_amount.constant = 1;
  const CompiledMaterials one = CompileMaterials(d, {3}, {});
  CHECK(one.table.size() == 1);
  CHECK(KindOf(one.table) == ShadeKind::kDielectricSmooth);
  CHECK(one.index[3] == one.index[1]);
  d.materials[1].kind = MaterialKind::kInterface;
  CHECK_THROWS_WITH(CompileMaterials(d, {3}, {}), Catch::Contains("interface"));
}

TEST_CASE("compile: textured layers of coats", "[scene][compile]") {
  SceneDescription d;
  AddTexture(d, Checker());
  Material m = OfKind(MaterialKind::kCoatedDiffuse);
  m.remap_roughness = false;
  m.uroughness.texture = m.vroughness.texture = 0;
  AddMaterial(d, m);  // 0
  m.thickness_texture = 0;
  AddMaterial(d, m);  // 1
  m.uroughness = m.vroughness = {0.3, kNone};
  AddMaterial(d, m);  // 2
  m.reflectance.texture = 0;
  AddMaterial(d, m);  // 3
  const CompiledMaterials c = CompileMaterials(d, {0, 1, 2, 3}, {});
  const MaterialTable& t = c.table;
  const auto grid = [&](std::size_t i) {
    return std::pair{int(t.coat_alphas[i]), int(t.coat_depths[i])};
  };
  CHECK(grid(0) == std::pair{kCoatAlphas, 1});
  CHECK(grid(1) == std::pair{kCoatAlphas, kCoatDepths});
  CHECK(grid(2) == std::pair{1, kCoatDepths});
  CHECK(t.coat[2] == t.coat[3]);
  const std::size_t tables = kCoatAlphas * (1 + kCoatDepths) + kCoatDepths;
  CHECK(t.coat_internals.size() == tables);
  CHECK(t.coat_transmittance.size() == tables * kCoatTableSize);
  // alpha / (1 + alpha) = 6/24.
  const CoatTable third = ComputeCoatTable(1 / 3.0, 1.5, 0.01);
  const auto first = static_cast<std::size_t>(t.coat[0]) / kCoatTableSize;
  CHECK(t.coat_internals[first + 6] == Approx(third.internal_reflectance));
  // The clear one is the first of those over the thickness.
  const CoatTable clear = ComputeCoatTable(0.3, 1.5, 0);
  const auto second = static_cast<std::size_t>(t.coat[2]) / kCoatTableSize;
  CHECK(t.coat_internals[second] == clear.internal_reflectance);
  REQUIRE(c.derived.size() == 1);  // the colour of the base of 3
  CHECK(c.derived[0].kind == TextureKind::kCoatedBase);
  CHECK(c.derived[0].octaves == 5);
  CHECK(t.color0_texture[3] == 1);
}

}  // namespace
}  // namespace lanelight
