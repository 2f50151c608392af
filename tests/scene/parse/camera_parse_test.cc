// Camera, film, filter, sampler, integrator, options.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "src/base/image/color_spaces.h"
#include "src/scene/description/note.h"
#include "tests/scene/parse/parse_text.h"

namespace lanelight {
namespace {

SceneDescription ParseOptionsBlock(const std::string& text) {
  return ParseText(text + "\nWorldBegin");
}

// A realistic camera reads its lenses from a file.
SceneDescription ParseWithFiles(const std::string& text) {
  return ParseSceneText(text + "\nWorldBegin", "test.pbrt", ".", {});
}

TEST_CASE("defaults are those of pbrt", "[parse]") {
  const SceneDescription scene = ParseText("WorldBegin");
  CHECK(scene.camera.kind == CameraKind::kPerspective);
  CHECK(scene.camera.fov == 90);
  CHECK(scene.film.width == 1280);
  CHECK(scene.film.height == 720);
  CHECK(scene.film.imaging_ratio == 1);
  CHECK(scene.filter.kind == FilterKind::kGaussian);
  CHECK(scene.filter.x_radius == 1.5);
  CHECK(scene.strategy.sampler == SampleSequence::kSobol);
  CHECK(scene.sampler.spp == 16);
  CHECK(scene.integrator.max_depth == 5);
}

TEST_CASE("cameras", "[parse]") {
  const SceneDescription scene = ParseOptionsBlock(R"(
    Camera "perspective" "float fov" 40 "float lensradius" 0.1 "float focaldistance" 3
      "float frameaspectratio" 2 "float screenwindow" [ -1 1 -0.5 0.5 ]
      "float shutteropen" 1 "float shutterclose" 1.5
    Film "rgb" "float iso" 400)");
  CHECK(scene.camera.fov == 40);
  CHECK(scene.camera.lens_radius == 0.1);
  CHECK(scene.camera.focal_distance == 3);
  CHECK(scene.camera.frame_aspect == 2);
  CHECK(scene.camera.screen_window[2] == -0.5);
  CHECK(scene.film.imaging_ratio == Approx(0.5 * 400 / 100));
  CHECK(ParseOptionsBlock("Camera \"orthographic\"").camera.kind ==
        CameraKind::kOrthographic);
  CHECK_THROWS_AS(ParseOptionsBlock("Camera \"orthographic\" \"float fov\" 30"),
                  InputError);
}

TEST_CASE("spherical and realistic cameras", "[parse]") {
  const Camera sphere =
      ParseOptionsBlock("Camera \"spherical\" \"string mapping\" \"equirectangular\"")
          .camera;
  CHECK(sphere.kind == CameraKind::kSpherical);
  CHECK(sphere.mapping == SphericalMapping::kEquirectangular);
  CHECK(ParseOptionsBlock("Camera \"spherical\"").camera.mapping ==
        SphericalMapping::kEqualArea);
  const std::string lenses = std::string("Camera \"realistic\" \"string lensfile\" \"") +
                             LANELIGHT_SOURCE_DIR + "/scenes/lenses/doublet.dat\" ";
  const std::string film = " Film \"rgb\" \"float diagonal\" 28 ";
  for (const std::string& text :
       {film + lenses + "\"float aperturediameter\" 12", lenses + film}) {
    const Camera camera = ParseWithFiles(text).camera;
    CHECK(camera.kind == CameraKind::kRealistic);
    CHECK(camera.lens.size() == 16);
    CHECK(camera.lens[5] == 3);
    CHECK(camera.film_diagonal == 28);
    CHECK(camera.focal_distance == 10);
  }
  CHECK(ParseWithFiles(lenses + "\"string aperture\" \"star\"").camera.aperture ==
        "star");
  const SceneDescription wide = ParseWithFiles(lenses + "\"float aperturediameter\" 60");
  CHECK(HasNote(wide, "larger than the stop"));
}

TEST_CASE("film size, crop and ignored sensor", "[parse]") {
  const SceneDescription scene = ParseOptionsBlock(R"(
    Film "rgb" "integer xresolution" 101 "integer yresolution" 50
      "string filename" "out.exr" "float cropwindow" [ 0.25 0.5 0 1 ]
      "bool savefp16" false "string sensor" "canon_eos_100d"
      "float maxcomponentvalue" 10)");
  CHECK(scene.film.width == 101);
  CHECK(scene.film.filename == "out.exr");
  CHECK(scene.film.crop[0] == 26);  // ceil(25.25)
  CHECK(scene.film.crop[1] == 51);
  CHECK(scene.film.crop[3] == 50);
  CHECK(scene.notes.size() == 2);
  CHECK(HasNote(scene, "\"savefp16\" of film \"rgb\" has no effect"));
  const SceneDescription bounds = ParseOptionsBlock(R"(
    Film "gbuffer" "integer pixelbounds" [ 3 9 4 8 ])");
  CHECK(bounds.film.crop[0] == 3);
  CHECK(bounds.film.crop[3] == 8);
  CHECK(bounds.notes.empty());
  CHECK(bounds.film.gbuffer == Gbuffer::kCamera);
  const SceneDescription world = ParseOptionsBlock(R"(
    Film "gbuffer" "string coordinatesystem" "world")");
  CHECK(world.film.gbuffer == Gbuffer::kWorld);
  CHECK(ParseOptionsBlock("Film \"rgb\"").film.gbuffer == Gbuffer::kNone);
}

TEST_CASE("pixel filters have their own default radii", "[parse]") {
  struct Case {
    const char* name;
    FilterKind kind;
    double radius;
  };
  for (const Case& c :
       {Case{"box", FilterKind::kBox, 0.5}, Case{"triangle", FilterKind::kTriangle, 2},
        Case{"gaussian", FilterKind::kGaussian, 1.5},
        Case{"mitchell", FilterKind::kMitchell, 2},
        Case{"sinc", FilterKind::kLanczos, 4}}) {
    CAPTURE(c.name);
    const auto scene = ParseOptionsBlock(std::string("PixelFilter \"") + c.name + '"');
    CHECK(scene.filter.kind == c.kind);
    CHECK(scene.filter.x_radius == c.radius);
    CHECK(scene.filter.y_radius == c.radius);
  }
  const auto mitchell =
      ParseOptionsBlock("PixelFilter \"mitchell\" \"float B\" 0.5 \"float xradius\" 3");
  CHECK(mitchell.filter.b == 0.5);
  CHECK(mitchell.filter.c == Approx(1. / 3));
  CHECK(mitchell.filter.x_radius == 3);
}

TEST_CASE("samplers", "[parse]") {
  const auto independent = ParseOptionsBlock(
      "Sampler \"independent\" \"integer pixelsamples\" 7 \"integer seed\" 9");
  CHECK(independent.strategy.sampler == SampleSequence::kIndependent);
  CHECK(independent.sampler.spp == 7);
  CHECK(independent.sampler.seed == 9);
  CHECK(independent.notes.empty());
  const auto sobol = ParseOptionsBlock("Sampler \"sobol\"");
  CHECK(sobol.strategy.sampler == SampleSequence::kSobol);
  CHECK(sobol.notes.empty());
  const auto stratified = ParseOptionsBlock(
      "Sampler \"stratified\" \"integer xsamples\" 3 \"bool jitter\" true");
  CHECK(stratified.sampler.spp == 12);
  CHECK(stratified.strategy.sampler == SampleSequence::kStratified);
  const auto seeded = ParseOptionsBlock("Option \"integer seed\" 5 Sampler \"halton\"");
  CHECK(seeded.sampler.seed == 5);
  CHECK(seeded.strategy.sampler == SampleSequence::kHalton);
  CHECK(seeded.notes.empty());
  const auto pmj02 = ParseOptionsBlock("Sampler \"pmj02bn\" \"integer pixelsamples\" 8");
  CHECK(pmj02.strategy.sampler == SampleSequence::kSobol);
  CHECK(pmj02.sampler.spp == 8);
  CHECK(HasNote(pmj02, "sampler \"pmj02bn\" is replaced by \"sobol\""));
}

TEST_CASE("integrators", "[parse]") {
  const auto path = ParseOptionsBlock("Integrator \"path\" \"integer maxdepth\" 65");
  CHECK(path.integrator.max_depth == 65);
  CHECK(path.notes.empty());
  CHECK(ParseOptionsBlock("Integrator \"volpath\"").notes.empty());
  for (const char* name : {"simplevolpath", "simplepath", "bdpt", "mlt", "sppm"}) {
    CHECK(HasNote(ParseOptionsBlock(std::string("Integrator \"") + name + '"'),
                  "replaced by \"path\""));
  }
  CHECK(ParseOptionsBlock("Integrator \"bdpt\"").integrator.from_lights);
  CHECK_FALSE(ParseOptionsBlock("Integrator \"mlt\"").integrator.from_lights);
}

TEST_CASE("accelerator, options and color space are noted", "[parse]") {
  const auto scene = ParseOptionsBlock(R"(
    Accelerator "bvh" "string splitmethod" "sah"
    Option "forcediffuse" true
    Option "string rendercoordsys" "world")");
  CHECK(HasNote(scene, "accelerator \"bvh\" has no effect"));
  CHECK(scene.integrator.force_diffuse);
  CHECK(HasNote(scene, "option \"rendercoordsys\" has no effect"));
  CHECK(CountImageChanges(scene.notes) == 0);
}

TEST_CASE("integrators regularize where the file says so", "[parse]") {
  for (const char* type : {"path", "volpath", "bdpt", "mlt", "sppm"}) {
    CAPTURE(type);
    const auto parse = [&](const char* parameter) {
      return ParseText(fmt::format("Integrator \"{}\" {} WorldBegin", type, parameter));
    };
    CHECK_FALSE(parse("").integrator.regularize);
    CHECK(parse("\"bool regularize\" true").integrator.regularize);
    CHECK_FALSE(HasNote(parse("\"bool regularize\" true"), "regularize"));
  }
}

TEST_CASE("disabletexturefiltering looks images up in the finest level", "[parse]") {
  for (const bool disabled : {false, true}) {
    const SceneDescription scene =
        ParseSceneText(std::string("Option \"disabletexturefiltering\" ") +
                           (disabled ? "true" : "false") + R"(
          WorldBegin
          Texture "a" "spectrum" "imagemap" "string filename" "x.png" "string filter" "ewa"
          Texture "b" "spectrum" "imagemap" "string filename" "x.png" "string filter" "point"
          Texture "c" "float" "checkerboard"
          Shape "sphere")",
                       "test.pbrt", ".");
    CHECK(scene.textures[2].filter ==
          (disabled ? ImageFilter::kBilinear : ImageFilter::kTrilinear));
    CHECK(scene.textures[0].filter ==
          (disabled ? ImageFilter::kBilinear : ImageFilter::kEwa));
    CHECK(scene.textures[0].bilinear);
    CHECK(scene.textures[1].filter == ImageFilter::kPoint);
    CHECK_FALSE(HasNote(scene, "disabletexturefiltering"));
  }
}

TEST_CASE("disablepixeljitter looks through the centres of pixels", "[parse]") {
  const auto scene = ParseOptionsBlock(R"(
    Camera "perspective" "float lensradius" 0.1
    PixelFilter "gaussian"
    Option "bool disablepixeljitter" [ true ])");
  CHECK(scene.notes.empty());
  CHECK(scene.filter.kind == FilterKind::kBox);
  CHECK(scene.filter.x_radius <= 1e-6);
  CHECK(scene.camera.lens_radius == 0);
  CHECK(ParseOptionsBlock("Option \"disablepixeljitter\" false").filter.kind ==
        FilterKind::kGaussian);
}

TEST_CASE("a film has a color space, a white balance and a sample limit", "[parse]") {
  const Film plain = ParseOptionsBlock("Film \"rgb\" \"string sensor\" \"cie1931\"").film;
  CHECK(plain.response.IsIdentity());
  const auto scene = ParseOptionsBlock(R"(
    ColorSpace "rec2020"
    Film "rgb" "float whitebalance" 4500 "float maxcomponentvalue" 7)");
  CHECK(scene.notes.empty());
  CHECK(scene.film.color_space == "rec2020");
  CHECK(scene.film.response.max_component == 7);
  // Light of the balance's white is grey.
  const Vec3d light = Inverse(XyzFromSrgb()) * WhiteOfTemperature(4500).Xyz();
  const Vec3d seen = scene.film.response.matrix * light;
  CHECK(seen.x == Approx(1));
  CHECK(seen.y == Approx(1));
  CHECK(seen.z == Approx(1));
  // A named camera is balanced anyway.
  const auto camera = ParseOptionsBlock("Film \"rgb\" \"string sensor\" \"nikon_d850\"");
  CHECK(HasNote(camera, "sensor \"nikon_d850\" is taken as \"cie1931\""));
  CHECK(CountImageChanges(camera.notes) == 0);
  const Vec3d grey = camera.film.response.matrix * Vec3d{1, 1, 1};
  CHECK(grey.x == Approx(1).margin(5e-3));
  CHECK(grey.z == Approx(1).margin(5e-3));
  CHECK_THROWS_WITH(ParseOptionsBlock("Film \"rgb\" \"string sensor\" \"nikon_d580\""),
                    Catch::Contains("did you mean \"nikon_d850\""));
  CHECK_THROWS_WITH(ParseOptionsBlock("Film \"rgb\" \"float whitebalance\" 500"),
                    Catch::Contains("2000 to 25000"));
}

}  // namespace
}  // namespace lanelight
