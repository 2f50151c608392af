// Measured reflectance: tables made of known models give these back.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <sstream>

#include "src/base/core/error.h"
#include "src/base/image/wavelengths.h"
#include "src/scene/compile/materials.h"
#include "tests/base/image/temporary_folder.h"
#include "tests/kernels/shade/probe_batch.h"
#include "tests/reference/measured.h"

namespace lanelight::test {
namespace {

TestMaterial MaterialOf(const reference::MeasuredModel& model) {
  reference::LocalMaterial m;
  m.kind = MaterialKind::kMeasured;
  std::istringstream file(reference::MeasuredFile(model));
  m.measured = ReadMeasuredReflectance(file, "test.bsdf");
  return MakeTestMaterial("measured", ShadeKind::kMeasured, m);
}

Vec3d Upwards(double z, double phi = 0.7) {
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

// Number of all paths that carry a triple of wavelengths.
AlignedVector<float> WavelengthOf(int triple) {
  return {static_cast<float>((triple + 0.5) / kTriples / 3)};
}

// The same by wavelength, of one triple.
TestMaterial SpectralMaterialOf(const reference::MeasuredModel& model, int triple) {
  const TemporaryFolder folder;
  TestMaterial m = MaterialOf(model);
  const std::string path = folder.Write("m.bsdf", reference::MeasuredFile(model));
  MaterialRow row;
  row.measured = m.local.measured = ReadMeasuredReflectance(path);
  m.table.measured = {};
  AddMeasured({row}, m.table.measured, Transport::kSpectral);
  m.wavelength = WavelengthOf(triple);
  return m;
}

// Means over the hemisphere of Eval and of its distance from the model, of a channel that
// is at this wavelength.
double DistanceFrom(const TestMaterial& m, const reference::MeasuredModel& model,
                    Vec3d wo, int channel = 1, double nm = 550) {
  ProbeBatch batch(8192);
  batch.SetWo(wo);
  reference::Random random(5);
  for (std::uint32_t i = 0; i < batch.n; ++i) {
    const Vec3d w = RandomDirection(random);
    batch.SetWi(i, {w.x, w.y, std::abs(w.z)});
  }
  batch.Eval(m);
  double off = 0, sum = 0;
  for (std::uint32_t i = 0; i < batch.n; ++i) {
    const double want = model.f_cos(nm, wo, Normalize(batch.Wi(i)));
    off += std::abs(batch.value[channel][i] - want), sum += want;
  }
  return off / sum;
}

Rgb Albedo(const TestMaterial& m, Vec3d wo) {
  ProbeBatch batch(1 << 16);
  batch.SetWo(wo);
  batch.RandomPoints(9);
  batch.Sample(m);
  Rgb sum;
  for (std::uint32_t i = 0; i < batch.n; ++i) sum += batch.Value(i);
  return sum / double(batch.n);
}

}  // namespace

TEST_CASE("measured chalk and metal agree with the models that generated them",
          "[shade][measured]") {
  const auto chalk = reference::ChalkModel(0.5);
  const auto metal = reference::MetalModel(0.35, 0.35, 0.6, 0.6);
  auto brushed = reference::MetalModel(0.5, 0.25, 0.6, 0.6);
  brushed.phis = 9, brushed.parts = 4;
  const TestMaterial chalk_table = MaterialOf(chalk), metal_table = MaterialOf(metal);
  const TestMaterial brushed_table = MaterialOf(brushed);
  for (const double z : {1.0, 0.9, 0.6, 0.35}) {
    INFO("z " << z);
    CHECK(DistanceFrom(chalk_table, chalk, Upwards(z)) < 0.05);
    CHECK(DistanceFrom(metal_table, metal, Upwards(z)) < 0.06);
    for (const double phi : {0.3, 2.0, -1.0}) {
      CHECK(DistanceFrom(brushed_table, brushed, Upwards(z, phi)) < 0.12);
    }
    CHECK(Albedo(chalk_table, Upwards(z)).y == Approx(0.5).epsilon(0.03));
  }
  // Another roughness is further away than that.
  CHECK(DistanceFrom(metal_table, reference::MetalModel(0.42, 0.42, 0.6, 0.6),
                     Upwards(0.6)) > 0.1);
}

TEST_CASE("measured: each wavelength has its own value", "[shade][measured][spectral]") {
  for (const bool is_anisotropic : {false, true}) {
    // Linear between the wavelengths of the file.
    auto model = reference::MetalModel(0.5, is_anisotropic ? 0.25 : 0.5, 0.2, 0.9);
    if (is_anisotropic) model.phis = 9, model.parts = 4;
    TestMaterial m = SpectralMaterialOf(model, 0);
    for (const int triple : {0, 40, 100, kTriples - 1}) {
      m.wavelength = WavelengthOf(triple);
      for (int c = 0; c < 3; ++c) {
        const auto bin = static_cast<std::size_t>((2 - c) * kTriples + triple);
        const double nm = CarriedWavelengths().centre[bin];
        INFO("turns " << is_anisotropic << ", " << nm << " nm");
        CHECK(DistanceFrom(m, model, Upwards(0.6), c, nm) < 0.12);
        // Power: the value of another wavelength is not that near.
        if (c != 1) CHECK(DistanceFrom(m, model, Upwards(0.6), 1, nm) > 0.14);
      }
    }
  }
}

TEST_CASE("measured: grey materials are equal at all wavelengths",
          "[shade][measured][spectral]") {
  const auto model = reference::ChalkModel(0.5);
  const TestMaterial rgb = MaterialOf(model), spectral = SpectralMaterialOf(model, 17);
  ProbeBatch a(4096), b(4096);
  for (ProbeBatch* batch : {&a, &b}) batch->SetWo(Upwards(0.6)), batch->RandomPoints(2);
  a.Sample(rgb), b.Sample(spectral);
  for (std::uint32_t i = 0; i < a.n; ++i) {
    for (int c = 0; c < 3; ++c) {
      if (!(std::abs(a.value[c][i] - b.value[c][i]) <= 2e-5f * a.value[c][i])) {
        FAIL("sample " << i << ": " << a.value[c][i] << ", " << b.value[c][i]);
      }
    }
  }
}

TEST_CASE("measured: a missing file is an error in spectral mode",
          "[compile][measured][spectral]") {
  MaterialRow row;
  row.measured = MaterialOf(reference::ChalkModel(0.5)).local.measured;
  MeasuredTable table;
  CHECK_THROWS_AS(AddMeasured({row}, table, Transport::kSpectral), InputError);
}

TEST_CASE("measured: files in scenes/ equal the generated models", "[shade][measured]") {
  const auto same = [](const std::string& name, const reference::MeasuredModel& model) {
    const std::string path = std::string(LANELIGHT_SOURCE_DIR) + "/scenes/" + name;
    const auto stored = ReadMeasuredReflectance(path);
    const auto made = MaterialOf(model).local.measured;
    REQUIRE(stored->theta == made->theta);
    REQUIRE(stored->phi == made->phi);
    REQUIRE(stored->reflectance.values.size() == made->reflectance.values.size());
    double off = 0, sum = 0;
    for (std::size_t i = 0; i < made->reflectance.values.size(); ++i) {
      off += std::abs(stored->reflectance.values[i] - made->reflectance.values[i]);
      sum += made->reflectance.values[i];
    }
    CHECK(off < 1e-5 * sum);
  };
  same("measured.bsdf", reference::VarnishModel());
  same("measured-brass.bsdf", reference::BrassModel());
}

TEST_CASE("measured: the albedo head-on is in the table", "[shade][measured]") {
  for (const TestMaterial& m : TestMaterials()) {
    if (m.kind != ShadeKind::kMeasured) continue;
    const Rgb table = HeadOnAlbedo(*m.local.measured);
    const Rgb found = Albedo(m, {0, 0, 1});
    INFO(m.name);
    for (int c = 0; c < 3; ++c) CHECK(found[c] == Approx(table[c]).epsilon(0.02));
  }
}

TEST_CASE("measured: slices of different directions are distinct", "[shade][measured]") {
  const auto model = reference::MetalModel(0.35, 0.35, 0.6, 0.6);
  TestMaterial wrong = MaterialOf(model);
  const MeasuredRecord& record = wrong.table.measured.records[0];
  float* v = wrong.table.measured.values.data();
  const auto size = record.vndf.grid.width * record.vndf.grid.height;
  for (int i = size; i < size * record.thetas; ++i) {
    v[record.vndf.grid.at + i] = v[record.vndf.grid.at + i % size];
    v[record.vndf.along + i] = v[record.vndf.along + i % size];
  }
  CHECK(DistanceFrom(wrong, model, Upwards(0.35)) > 0.1);
}

TEST_CASE("measured: materials of one file share its tables", "[compile][measured]") {
  const TestMaterial m = MaterialOf(reference::ChalkModel(0.5));
  MaterialRow row, other;
  row.measured = m.local.measured;
  MeasuredTable table;
  AddMeasured({other, row, other, row}, table);
  CHECK(table.records.size() == 1);
  CHECK(table.of_material[1] == 0);
  CHECK(table.of_material[3] == 0);
  CHECK(table.of_material[2] == -1);
  CHECK_FALSE(table.any_anisotropic);
  MeasuredTable empty;
  AddMeasured({other}, empty);
  CHECK(empty.of_material.empty());
  CHECK(empty.values.empty());
}

}  // namespace lanelight::test
