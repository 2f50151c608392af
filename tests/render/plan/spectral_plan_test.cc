// What wavelengths cost: nothing where paths carry none, and what they cannot carry.
#include <catch2/catch.hpp>

#include "src/render/wave/wavefront.h"
#include "src/scene/prepare/prepared_scene.h"
#include "tests/render/run/render_fixture.h"
#include "tests/support/input_error.h"

namespace lanelight {
namespace {

const std::string kSpectralHead =
    "Camera \"perspective\"\nFilm \"rgb\" \"integer xresolution\" 8 \"integer "
    "yresolution\" 8\nWorldBegin\nLightSource \"point\" \"rgb I\" [ 1 2 3 ]\n";
const std::string kSpectralShape = "Shape \"sphere\" \"float radius\" 1\n";

SceneDescription SpectralScene(const std::string& world) {
  SceneDescription scene =
      ParseSceneText(kSpectralHead + world + kSpectralShape, "test.pbrt", ".");
  scene.integrator.transport = Transport::kSpectral;
  return scene;
}

Plan SpectralPlan(const SceneDescription& scene, const std::string& strategy = "") {
  SceneDescription copy = scene;
  ApplyStrategy(strategy, {}, copy.strategy);
  return MakePlan(PrepareScene(copy), PlanOptions{});
}

bool HasStage(const Plan& plan, const std::string& name) {
  return std::any_of(plan.paths().stages.begin(), plan.paths().stages.end(),
                     [&](const auto& planned) { return planned.stage.name == name; });
}

bool HasField(const Plan& plan, Field field) {
  return std::count(plan.live_fields.begin(), plan.live_fields.end(), field) > 0;
}

}  // namespace

TEST_CASE("spectral plan: RGB paths have no spectral stages", "[plan][spectral]") {
  SceneDescription scene =
      SpectralScene("Material \"dielectric\" \"spectrum eta\" \"glass-BK7\"\n");
  scene.integrator.transport = Transport::kRgb;
  const PreparedScene prepared = PrepareScene(scene);
  const CompiledScene& compiled = *prepared.compiled;
  CHECK(compiled.spectra.rows.empty());
  CHECK(compiled.spectra.film[0].empty());
  CHECK(compiled.lights.spectrum.empty());
  CHECK(compiled.materials.color0_spectrum.empty());
  const Plan plan = MakePlan(prepared, PlanOptions{});
  for (const char* name : {"spectra", "texture_spectra", "disperse", "light_spectra"}) {
    CHECK_FALSE(HasStage(plan, name));
  }
  CHECK_FALSE(HasField(plan, Field::wavelength));
  CHECK_FALSE(HasField(plan, Field::eta));
  CHECK_FALSE(HasField(plan, Field::color0_r));
}

TEST_CASE("spectral plan: each stage exists where it is needed", "[plan][spectral]") {
  const Plan diffuse = SpectralPlan(SpectralScene("Material \"diffuse\"\n"));
  CHECK(HasStage(diffuse, "spectra"));
  CHECK(HasStage(diffuse, "light_spectra"));
  CHECK_FALSE(HasStage(diffuse, "texture_spectra"));
  CHECK_FALSE(HasStage(diffuse, "disperse"));
  CHECK(HasField(diffuse, Field::wavelength));
  CHECK(HasField(diffuse, Field::color0_r));
  CHECK_FALSE(HasField(diffuse, Field::color1_r));
  CHECK_FALSE(HasField(diffuse, Field::eta));

  const Plan metal = SpectralPlan(SpectralScene("Material \"conductor\"\n"));
  CHECK(HasField(metal, Field::color1_r));

  const Plan glass = SpectralPlan(SpectralScene("Material \"dielectric\"\n"));
  CHECK_FALSE(HasStage(glass, "disperse"));
  const Plan prism = SpectralPlan(
      SpectralScene("Material \"dielectric\" \"spectrum eta\" \"glass-BK7\"\n"));
  CHECK(HasStage(prism, "disperse"));
  CHECK(HasField(prism, Field::eta));

  const Plan textured = SpectralPlan(
      SpectralScene("Texture \"t\" \"spectrum\" \"checkerboard\" \"rgb tex1\" [ 1 0 0 ]\n"
                    "Material \"diffuse\" \"texture reflectance\" \"t\"\n"));
  CHECK(HasStage(textured, "texture_spectra"));
  CHECK_FALSE(HasStage(textured, "spectra"));
}

TEST_CASE("spectral plan: unsupported features are refused", "[plan][spectral]") {
  const auto compiles = [](const std::string& world) {
    return InputErrorOf([&] { PrepareScene(SpectralScene(world)); });
  };
  const std::string medium =
      "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"rgb sigma_a\" ";
  const std::string inside = "MediumInterface \"m\" \"\"\nMaterial \"interface\"\n";
  CHECK(compiles(medium + "[ 1 2 3 ] \"rgb sigma_s\" [ 1 1 1 ]\n" + inside).empty());
  CHECK(compiles("MakeNamedMedium \"m\" \"string type\" \"rgbgrid\" \"integer nx\" 1 "
                 "\"integer ny\" 1 \"integer nz\" 1 \"rgb sigma_a\" [ 1 2 3 ]\n" +
                 inside)
            .empty());

  const SceneDescription diffuse = SpectralScene("Material \"diffuse\"\n");
  const SceneDescription prism = SpectralScene(
      "Material \"dielectric\" \"spectrum eta\" \"glass-BK7\"\nShape "
      "\"sphere\"\nMaterial \"diffuse\"\n");
  CHECK(InputErrorOf([&] {
          SpectralPlan(prism, "reuse=block");
        }).find("dispersive glass") != std::string::npos);
  CHECK(SpectralPlan(diffuse, "reuse=block").features.Has(Feature::kReuse));
}

TEST_CASE("spectral plan: dispersive glass gets a note in RGB", "[plan][spectral]") {
  SceneDescription scene =
      SpectralScene("Material \"dielectric\" \"spectrum eta\" \"glass-BK7\"\n");
  const auto notes = [](const SceneDescription& s) {
    std::string all;
    for (const Note& note : CompileScene(s).notes) all += note.message + "\n";
    return all;
  };
  CHECK(notes(scene).find("587.6 nm") == std::string::npos);
  scene.integrator.transport = Transport::kRgb;
  CHECK(notes(scene).find("587.6 nm") != std::string::npos);
}

}  // namespace lanelight
