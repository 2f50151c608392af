// Every material, sampled with random numbers at the ends of their range from directions
// down to grazing.
#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "kernels/probe/bsdf_probe.h"
#include "src/measure/stress/cases/cases.h"
#include "src/measure/stress/cases/points.h"
#include "src/measure/stress/cases/scene_text.h"

namespace lanelight::stress {
namespace {

// One shape of each material, so that all are compiled.
std::shared_ptr<const CompiledScene> Materials(double alpha) {
  const std::string rough = Alphas(alpha, alpha);
  std::string text = ViewOfPlane() + Sky(1);
  for (const std::string& material : std::vector<std::string>{
           Diffuse(0.5), "\"diffuse\" \"string scattering\" \"uniform\"",
           "\"diffuse\" \"string scattering\" \"insphere\"", "\"conductor\"" + rough,
           Glass(1.5, alpha), Glass(1.0001, alpha), Glass(100, alpha),
           "\"thindielectric\"", "\"coateddiffuse\"" + rough,
           "\"coatedconductor\" \"float interface.roughness\" 0.1 \"float "
           "conductor.roughness\" 0.1",
           "\"diffusetransmission\"", "\"hair\" \"float beta_m\" 0.05"}) {
    text += Sphere({0, 0, 0}, 1, material);
  }
  return PrepareText({text, {}}).scene.compiled;
}

bool Sane(float v) { return v >= 0 && std::isfinite(v); }

// All triples of numbers at the ends, from one direction.
struct Ends {
  static constexpr float kValues[] = {0, 0x1p-24f, 0.25f, 0.5f, 0.75f, 1 - 0x1p-24f};
  static constexpr std::uint32_t kSide = std::size(kValues),
                                 kCount = kSide * kSide * kSide;
  std::vector<float> wo[3], u[3], wi[3], value[3], pdf, eta_scale;

  explicit Ends(Vec3d from) {
    for (int c = 0; c < 3; ++c) {
      const double w = c == 0 ? from.x : c == 1 ? from.y : from.z;
      wo[c].assign(kCount + kProbePadding, static_cast<float>(w));
      for (auto* column : {&u[c], &wi[c], &value[c]})
        column->resize(kCount + kProbePadding);
    }
    pdf.resize(kCount + kProbePadding);
    eta_scale.resize(kCount + kProbePadding);
    for (std::uint32_t i = 0; i < kCount; ++i) {
      u[0][i] = kValues[i % kSide];
      u[1][i] = kValues[i / kSide % kSide];
      u[2][i] = kValues[i / (kSide * kSide)];
    }
  }

  BsdfBatch Batch(const MaterialTable& table, std::uint32_t row) {
    BsdfBatch batch = {&table, row, kCount, 1};
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

  // What is not absorbed has a unit direction, a finite weight and a density.
  bool GoodSample(std::uint32_t i) const {
    const bool weights = Sane(value[0][i]) && Sane(value[1][i]) && Sane(value[2][i]);
    if (weights && value[0][i] + value[1][i] + value[2][i] == 0) return true;
    const double length = std::hypot(double(wi[0][i]), wi[1][i], wi[2][i]);
    return weights && Sane(pdf[i]) && Sane(eta_scale[i]) && std::abs(length - 1) < 1e-3;
  }
  bool GoodValue(std::uint32_t i) const {
    return Sane(pdf[i]) && Sane(value[0][i]) && Sane(value[1][i]) && Sane(value[2][i]);
  }
};

Point Material(SimdTarget target, const MaterialTable& table, std::uint32_t row) {
  const auto kind = static_cast<ShadeKind>(table.kind[row]);
  const BsdfProbe probe = GetBsdfProbe(target, kind);
  std::uint64_t failures = 0, trials = 0;
  for (double z : {1.0, 0.5, 0.01, 1e-4, 1e-7, -1e-7, -0.5, -1.0}) {
    Ends ends({std::sqrt((1 - z) * (1 + z)), 0, z});
    const BsdfBatch batch = ends.Batch(table, row);
    probe.sample(batch);
    for (std::uint32_t i = 0; i < Ends::kCount; ++i) failures += !ends.GoodSample(i);
    trials += Ends::kCount;
    if (probe.eval == nullptr) continue;
    probe.eval(batch);  // of the directions just found
    for (std::uint32_t i = 0; i < Ends::kCount; ++i) failures += !ends.GoodValue(i);
    trials += Ends::kCount;
  }
  return NoFailures(failures, trials);
}

std::vector<Point> ByAlpha(double alpha, const Effort& effort) {
  const auto scene = Materials(alpha);
  const MaterialTable& materials = scene->materials;
  static constexpr const char* kNames[] = {
#define X(name, traits, meaning) meaning,
      LANELIGHT_SHADE_KINDS(X)
#undef X
  };
  std::vector<Point> points;
  for (std::uint32_t row = 0; row < materials.size(); ++row) {
    points.push_back(Named(fmt::format("{} {}", row, kNames[materials.kind[row]]),
                           Material(effort.target, materials, row)));
  }
  return points;
}

}  // namespace

void AddBsdfEndCases(std::vector<Case>& cases) {
  const CaseAdder add{cases, "sampling", Truth::kRate};
  add({"materials-at-ends",
       "random numbers 0 and 1 - 2^-24 in the sampling of every material, alpha "
       "from 1e-4 to 1, cosines to 1e-7",
       "finite directions, weights and densities, none negative",
       LogAxis("GGX alpha", "", {1e-4, 1}, {1e-4, 1e-3, 0.1, 1}, Decades(-4, 0, 0.25)),
       ByAlpha});
}

}  // namespace lanelight::stress
