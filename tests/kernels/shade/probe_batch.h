// Materials for tests of the shading kernels: the same one as a row of a MaterialTable
// and as a LocalMaterial of the scalar reference, and batches that run the probes on it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/kernels/probe/bsdf_probe.h"
#include "tests/reference/bsdf.h"
#include "tests/support/test_target.h"

namespace lanelight::test {

struct TestMaterial {
  std::string name;
  ShadeKind kind;
  reference::LocalMaterial local;
  MaterialTable table;                   // one row
  AlignedVector<float> uv_v;             // of fibres: across
  AlignedVector<float> wavelength = {};  // of spectra: number of all paths; else empty
};

/// `local` as a row of a table.
TestMaterial MakeTestMaterial(const std::string& name, ShadeKind kind,
                              const reference::LocalMaterial& local);

/// At least one of each kind, smooth and rough, isotropic and not.
const std::vector<TestMaterial>& TestMaterials();

bool IsSpecular(ShadeKind kind);

/// Directions and results of n evaluations.
struct ProbeBatch {
  std::uint32_t n;
  std::vector<float> wo[3], u[3], wi[3], value[3], pdf, eta_scale;

  explicit ProbeBatch(std::uint32_t count);
  void SetWo(Vec3d w);  // for all
  void RandomPoints(std::uint64_t seed);
  void SetWi(std::uint32_t i, Vec3d w);
  Vec3d Wo(std::uint32_t i) const { return {wo[0][i], wo[1][i], wo[2][i]}; }
  Vec3d Wi(std::uint32_t i) const { return {wi[0][i], wi[1][i], wi[2][i]}; }
  Rgb Value(std::uint32_t i) const { return {value[0][i], value[1][i], value[2][i]}; }

  /// Run the probes of the current target.
  void Sample(const TestMaterial& material, std::uint32_t seed = 0);
  void Eval(const TestMaterial& material, std::uint32_t seed = 0);

 private:
  BsdfBatch View(const TestMaterial& material, std::uint32_t seed);
};

/// Directions of incidence, on both sides, up to 82 degrees.
std::vector<Vec3d> TestDirections();
/// The same, but only one for the emulation: it runs the same code, thirty times slower.
std::vector<Vec3d> TestDirections(const std::string& target);
/// Uniform over the sphere.
Vec3d RandomDirection(reference::Random& random);

}  // namespace lanelight::test
