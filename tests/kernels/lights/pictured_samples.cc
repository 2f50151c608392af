#include "tests/kernels/lights/pictured_samples.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "kernels/stages.h"
#include "src/scene/prepare/parameters.h"
#include "src/scene/prepare/prepared_scene.h"

namespace lanelight::test {
namespace {

// What samples a shape, meets it and adds its emission.
struct StagesOfShape {
  StageOn sample, intersect, emission;
};
StagesOfShape StagesOf(LightShape shape) {
  switch (shape) {
    case LightShape::kTriangle:
      return {SampleTriangleLightStage, IntersectTrianglesStage, EmissionTriangleStage};
    case LightShape::kRectangle:
      return {SampleRectangleLightStage, IntersectTrianglesStage, EmissionRectangleStage};
    case LightShape::kSphere:
      return {SampleSphereLightStage, IntersectSpheresStage, EmissionSphereStage};
    default:
      REQUIRE(shape == LightShape::kDisk);
      return {SampleDiskLightStage, IntersectDisksStage, EmissionDiskStage};
  }
}

// The light of the scene that has a shape.
struct Emitter {
  std::uint32_t index = 0;
  StagesOfShape stages;

  explicit Emitter(const PreparedScene& scene) {
    const auto& lights = scene.compiled->lights.lights;
    while (lights[index].primitive == 0xffffffffu) ++index;
    stages = StagesOf(static_cast<LightShape>(lights[index].shape));
  }
};

PreparedScene SampledScene(const PicturedShape& shape) {
  PreparedScene scene = PrepareScene(shape.scene);
  if (!shape.solid_angle) return scene;
  auto by_angle = std::make_shared<CompiledScene>(*scene.compiled);
  by_angle->features.Add(Feature::kSolidAngleLights);
  scene.compiled = by_angle;
  return scene;
}

}  // namespace

PictureSamples::PictureSamples(const PicturedShape& shape, Vec3d place, double power)
    : scene_(SampledScene(shape)),
      from_(place),
      fixture_(scene_.Parts(), kPictureSamples) {
  const Emitter emitter(scene_);
  const FeatureSet& features = scene_.compiled->features;
  fixture_.run.features = features;
  PathColumns& p = fixture_.wave.path;
  p.light_pmf = nullptr;
  const Vec3d at = (from_ - scene_.compiled->center) * scene_.compiled->scale;
  std::mt19937 engine(19);
  for (std::uint32_t i = 0; i < kPictureSamples; ++i) {
    p.p_x[i] = float(at.x), p.p_y[i] = float(at.y), p.p_z[i] = float(at.z);
    p.p_error[i] = 1e-7f;
    for (float* u : {p.u_light_0, p.u_light_1}) {
      u[i] = float(std::pow(double(engine() >> 8) * 0x1p-24, power));
    }
    p.ls_light[i] = emitter.index;
  }
  fixture_.QueueAll(QueueId::kLit, kPictureSamples);
  fixture_.Run(emitter.stages.sample, features);
  fixture_.Run(EmissionImageSamplesStage, features);
}

double PictureSamples::Pmf() const { return scene_.chances->pmf[Emitter(scene_).index]; }

std::vector<Vec3d> PictureSamples::Directions() const {
  const PathColumns& p = fixture_.wave.path;
  std::vector<Vec3d> directions;
  for (std::uint32_t i = 0; i < kPictureSamples; ++i) {
    directions.push_back(Normalize(Vec3d{p.ls_x[i], p.ls_y[i], p.ls_z[i]}));
  }
  return directions;
}

Rgb PictureSamples::Radiance(std::uint32_t i) const {
  const PathColumns& p = fixture_.wave.path;
  return Rgb{p.ls_r[i], p.ls_g[i], p.ls_b[i]} * Pdf(i);
}

std::vector<Rgb> SeenAlong(const PreparedScene& scene, Vec3d from,
                           const std::vector<Vec3d>& directions, float bsdf_pdf) {
  const auto n = static_cast<std::uint32_t>(directions.size());
  WaveFixture fixture(scene.Parts(), n);
  FeatureSet features = scene.compiled->features;
  features.Add(Feature::kMis);
  fixture.run.mis = MakeMisParameters(Strategy{});
  PathColumns& p = fixture.wave.path;
  p.light_pmf = nullptr;
  std::vector<TestRay> rays;
  for (std::uint32_t i = 0; i < n; ++i) {
    rays.push_back(
        {VecCast<float>((from - scene.compiled->center) * scene.compiled->scale),
         VecCast<float>(directions[i])});
    rays.back().from = kNoPrimitive;
    p.beta_r[i] = p.beta_g[i] = p.beta_b[i] = 1;
    p.l_r[i] = p.l_g[i] = p.l_b[i] = 0;
    p.bsdf_pdf[i] = bsdf_pdf;
  }
  fixture.SetRays(rays);
  const Emitter emitter(scene);
  fixture.Run(emitter.stages.intersect, features);
  Queue& hit = fixture.wave.queue(QueueId::kHit);
  hit.size = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    if (!std::isinf(p.t[i])) hit.items[hit.size++] = i;
  }
  fixture.Run(emitter.stages.emission, features);
  std::vector<Rgb> seen;
  for (std::uint32_t i = 0; i < n; ++i) seen.push_back({p.l_r[i], p.l_g[i], p.l_b[i]});
  return seen;
}

std::vector<double> DensitiesAlong(const PreparedScene& scene, Vec3d from,
                                   const std::vector<Vec3d>& directions) {
  // A material's density of 1 makes that of the heuristic of powers 1 / (1 + pdf^2).
  const std::vector<Rgb> weighed = SeenAlong(scene, from, directions, 1);
  const std::vector<Rgb> whole = SeenAlong(scene, from, directions, kLargePdf);
  std::vector<double> pdf;
  bool same = true;  // what is seen at all
  for (std::size_t i = 0; i < weighed.size(); ++i) {
    same &= (weighed[i].x > 0) == (whole[i].x > 0);
    const double fraction = weighed[i].x > 0 ? whole[i].x / weighed[i].x : 1;
    pdf.push_back(std::sqrt(std::max(0.0, fraction - 1)));
  }
  CHECK(same);
  return pdf;
}

}  // namespace lanelight::test
