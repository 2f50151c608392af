// The plan: what a scene does not need is not planned, not allocated, not run.
#include "src/render/plan/plan.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "src/base/core/check.h"
#include "src/render/wave/wavefront.h"
#include "src/scene/prepare/prepared_scene.h"
#include "tests/render/run/render_fixture.h"

namespace lanelight {
namespace {

const std::string kHead =
    "Camera \"perspective\"\nFilm \"rgb\" \"integer xresolution\" 16 \"integer "
    "yresolution\" "
    "16\nPixelFilter \"box\" \"float xradius\" 0.5 \"float yradius\" 0.5\n";
const std::string kTriangle =
    "Shape \"trianglemesh\" \"point3 P\" [ -9 -9 5  9 -9 5  0 9 5 ] "
    "\"integer indices\" [ 0 1 2 ]\n";
const std::string kPointLight = "LightSource \"point\" \"rgb I\" [ 1 1 1 ]\n";

Plan PlanOf(const std::string& world, std::uint32_t max_depth = 5,
            const std::string& strategy = "") {
  SceneDescription description =
      ParseSceneText(kHead + "WorldBegin\n" + world, "test.pbrt", ".");
  if (!strategy.empty()) ApplyStrategy(strategy, {}, description.strategy);
  description.strategy.sampler = SampleSequence::kIndependent;
  const PreparedScene scene = PrepareScene(description);
  PlanOptions options;
  options.max_depth = max_depth;
  return MakePlan(scene, options);
}

std::set<std::string> StageNames(const Phase& phase) {
  std::set<std::string> names;
  for (const PlannedStage& s : phase.stages) names.insert(s.stage.name);
  return names;
}
std::set<std::string> StageNames(const Plan& plan) { return StageNames(plan.paths()); }

bool IsLive(const Plan& plan, Field field) {
  return std::count(plan.live_fields.begin(), plan.live_fields.end(), field) > 0;
}

std::string Reason(const Plan& plan, const std::string& stage) {
  for (const OmittedStage& omitted : plan.omitted) {
    if (omitted.stage.name == stage) return omitted.reason;
  }
  return "planned";
}

}  // namespace

TEST_CASE("plan: a triangle under a point light gets the minimum", "[plan]") {
  const Plan plan = PlanOf(kPointLight + kTriangle);
  CHECK(StageNames(plan) ==
        std::set<std::string>{"generate", "points_camera_independent",
                              "camera_perspective", "intersect_triangles", "hits",
                              "max_depth", "surface_triangle",
                              "points_bounce_independent", "route", "light_point",
                              "shade_diffuse", "shadow_triangles", "connect",
                              "roulette_throughput", "accumulate", "compact"});
  CHECK(Reason(plan, "intersect_spheres") == "no spheres");
  CHECK(Reason(plan, "light_select_table") == "no more than one light");
  for (Field absent :
       {Field::inst, Field::uv_u, Field::ns_x, Field::tg_x, Field::bsdf_pdf,
        Field::u_select, Field::u_lobe, Field::ls_light, Field::eta_scale,
        Field::color0_r, Field::u_lens_0, Field::weight, Field::aov_depth}) {
    INFO(FieldName(absent));
    CHECK_FALSE(IsLive(plan, absent));
  }
  CHECK(plan.bytes_per_path == 4 * plan.live_fields.size());
}

TEST_CASE("plan: an absent column has no memory", "[plan]") {
  const PreparedScene scene = PrepareScene(
      ParseSceneText(kHead + "WorldBegin\n" + kPointLight + kTriangle, "test.pbrt", "."));
  const Plan plan = MakePlan(scene, {});
  const RunParameters run;
  Wavefront wavefront(scene, plan, run);
  const PathColumns& path = wavefront.wave().path;
  std::size_t allocated = 0;
#define X(type, name, ...)                                    \
  CHECK((path.name != nullptr) == IsLive(plan, Field::name)); \
  allocated += path.name != nullptr;
  LANELIGHT_PATH_FIELDS(X)
#undef X
  CHECK(allocated == plan.live_fields.size());
  // Columns and queues, each padded by less than three cache lines.
  CHECK(wavefront.bytes() <= (allocated + kNumQueues) * (plan.wavefront * 4 + 192));
}

TEST_CASE("plan: each scene feature adds its stages and columns", "[plan]") {
  const std::string base = kPointLight + kTriangle;
  CHECK(StageNames(PlanOf(base + "Shape \"sphere\"")).count("intersect_spheres"));
  CHECK(StageNames(PlanOf(base + kPointLight)).count("light_select_table"));
  const Plan area = PlanOf(base + "AreaLightSource \"diffuse\"\n" + kTriangle);
  CHECK(StageNames(area).count("emission_triangle"));
  CHECK(IsLive(area, Field::bsdf_pdf));
  CHECK(StageNames(PlanOf("LightSource \"infinite\"\n" + kTriangle)).count("escape"));
  CHECK(IsLive(PlanOf("Material \"dielectric\"\n" + base), Field::eta_scale));
}

TEST_CASE("plan: hits need a light normal only for projected light samples", "[plan]") {
  const auto has = [](const std::string& world, const char* strategy) {
    return IsLive(PlanOf(world + kTriangle, 5, strategy), Field::start_n_x);
  };
  const std::string lamp = "AreaLightSource \"diffuse\"\n";
  CHECK(has(lamp, "light-points=projected"));
  CHECK_FALSE(has(lamp, "light-points=projected,directions=light"));
  CHECK_FALSE(has(lamp, "light-points=projected,directions=bsdf"));
  CHECK_FALSE(has(lamp, "light-points=solid-angle"));
  CHECK_FALSE(has(kPointLight, "light-points=projected"));
}

TEST_CASE("plan: small depths need neither roulette nor shading", "[plan]") {
  const std::string scene = kPointLight + kTriangle;
  CHECK(StageNames(PlanOf(scene, 2)).count("roulette_throughput"));
  CHECK_FALSE(StageNames(PlanOf(scene, 1)).count("roulette_throughput"));
  const Plan emission_only = PlanOf(scene, 0);
  for (const std::string& name : StageNames(emission_only)) {
    CHECK(name.rfind("shade", 0) != 0);
    CHECK(name.rfind("light", 0) != 0);
    CHECK(name.rfind("surface", 0) != 0);
  }
  CHECK_FALSE(IsLive(emission_only, Field::p_x));
}

TEST_CASE("plan: light subpaths end by roulette as camera paths do", "[plan]") {
  const std::string scene = "AreaLightSource \"diffuse\"\n" + kTriangle;
  const auto names = [&](const char* roulette) {
    const Plan plan =
        PlanOf(scene, 5, std::string("light-paths=splats,roulette=") + roulette);
    return StageNames(*plan.Find(PhaseId::kLightPaths));
  };
  CHECK(names("throughput").count("roulette_throughput"));
  CHECK(names("constant").count("roulette_throughput"));
  CHECK_FALSE(names("none").count("roulette_throughput"));
}

TEST_CASE("plan: stages that are left out are never called", "[plan]") {
  TestRender options;
  const Rendered r =
      RenderText(kHead + "WorldBegin\n" + kPointLight + kTriangle, options);
  CHECK(r.result.stages.size() == r.plan.paths().stages.size());
  for (const StageProfile& stage : r.result.stages) {
    INFO(stage.name);
    CHECK(stage.calls > 0);  // and every planned stage of this scene is needed
  }
}

}  // namespace lanelight
