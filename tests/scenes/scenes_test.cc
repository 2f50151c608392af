// Our own scenes say what they are for, load without a note of anything unused, and
// compile; scenes/generate writes what the parser reads.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "src/scene/compile/compile.h"
#include "src/scene/compiled/scene.h"
#include "src/scene/parse/parse.h"
#include "src/scene/prepare/prepared_scene.h"

namespace lanelight {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> OwnScenes() {
  const fs::path root = fs::path(LANELIGHT_SOURCE_DIR) / "scenes";
  std::vector<fs::path> scenes;
  for (const fs::path& folder : {root, root / "stiff"}) {
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (entry.path().extension() == ".pbrt") scenes.push_back(entry.path());
    }
  }
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

std::string ReadText(const fs::path& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("own scenes: headers state purpose, features and closed form", "[scenes]") {
  const auto scenes = OwnScenes();
  CHECK(scenes.size() >= 28);
  for (const fs::path& path : scenes) {
    const std::string text = ReadText(path);
    INFO(path);
    for (const char* word : {"# Purpose: ", "# Needs: ", "# Closed form: "}) {
      CHECK(text.find(word) != std::string::npos);
    }
  }
}

TEST_CASE("own scenes: all parse and compile", "[scenes]") {
  for (const fs::path& path : OwnScenes()) {
    INFO(path);
    SceneDescription scene;
    REQUIRE_NOTHROW(scene = ParseScene(path.string()));
    for (const Note& note : scene.notes) {
      // Wanted by pbrt, so that its images can be compared with ours.
      if (note.message.find("savefp16") != std::string::npos) continue;
      // Says what is done instead of what pbrt does.
      if (note.message.find("pbrt-v4 uses a tabulated profile") != std::string::npos)
        continue;
      INFO(note.where.ToString() << ": " << note.message);
      CHECK(false);
    }
    CHECK(scene.film.width <= 512);
    CHECK(scene.film.height <= 512);
    CHECK(scene.sampler.spp == 64);
    CHECK(scene.strategy.sampler == SampleSequence::kSobol);
    REQUIRE_NOTHROW(PrepareScene(scene));
  }
}

TEST_CASE("own scenes: features stated in headers are used", "[scenes]") {
  const fs::path root = fs::path(LANELIGHT_SOURCE_DIR) / "scenes";
  const auto features = [&](const char* name) {
    return PrepareScene(ParseScene((root / name).string())).compiled->features;
  };
  const FeatureSet paper = features("paper.pbrt");
  CHECK(paper.HasAll({Feature::kPlanes, Feature::kSpheres, Feature::kPointLights,
                      Feature::kConductorSmooth, Feature::kDielectricSmooth}));
  CHECK_FALSE(paper.HasAny({Feature::kTriangles, Feature::kMis, Feature::kManyLights}));
  CHECK(features("furnace.pbrt")
            .HasAll({Feature::kDiffuseUniform, Feature::kDiffuseInSphere,
                     Feature::kThinDielectric, Feature::kDiffuseTransmission}));
  CHECK(features("closed-room.pbrt")
            .HasAll({Feature::kSphereLights, Feature::kRectangleLights,
                     Feature::kDiskLights}));
  CHECK(
      features("relief.pbrt")
          .HasAll({Feature::kBumps, Feature::kNormalMaps, Feature::kTextureFootprints}));
  CHECK(features("instances.pbrt").Has(Feature::kInstances));
  CHECK(
      features("sun-sky.pbrt")
          .HasAll({Feature::kDistantLights, Feature::kInfiniteConstant, Feature::kLens}));
  CHECK(
      features("many-lights.pbrt").HasAll({Feature::kSpotLights, Feature::kManyLights}));
  CHECK(features("glass.pbrt").HasAll({Feature::kDielectricRough, Feature::kTextures}));
  CHECK(features("shaded-lamp.pbrt")
            .HasAll({Feature::kSphereLights, Feature::kDiffuseTransmission,
                     Feature::kDielectricSmooth, Feature::kDisks}));
  CHECK(features("blinds.pbrt")
            .HasAll({Feature::kInstances, Feature::kDiskLights,
                     Feature::kInfiniteConstant, Feature::kPlanes}));
  CHECK(features("corridor.pbrt")
            .HasAll({Feature::kSphereLights, Feature::kDielectricSmooth}));
  CHECK(features("mirror-wall.pbrt")
            .HasAll({Feature::kDiskLights, Feature::kConductorSmooth,
                     Feature::kConductorRough}));
  CHECK(features("shapes.pbrt")
            .HasAll({Feature::kTriangles, Feature::kVertexNormals, Feature::kUv,
                     Feature::kTriangleLights, Feature::kDielectricSmooth}));
  CHECK_FALSE(features("shapes.pbrt").HasAny({Feature::kSpheres, Feature::kDisks}));
  CHECK(features("hair.pbrt").HasAll({Feature::kCurves, Feature::kHair}));
  CHECK(features("patterns.pbrt")
            .HasAll({Feature::kTexturePlaces, Feature::kTexturedRoughness,
                     Feature::kCoatedDiffuseSmooth}));
  CHECK(features("textured-layers.pbrt")
            .HasAll({Feature::kTexturedColor1, Feature::kTexturedCoat,
                     Feature::kCoatedConductor, Feature::kDiffuseTransmission}));
  CHECK(features("hazy-coats.pbrt")
            .HasAll({Feature::kCoatedDiffuseMedium, Feature::kCoatedConductorMedium,
                     Feature::kTexturedCoatMedium}));
  CHECK(features("subsurface.pbrt")
            .HasAll({Feature::kSubsurface, Feature::kSubsurfaceTextures,
                     Feature::kDielectricSmooth, Feature::kDielectricRough}));
  CHECK(features("measured.pbrt").HasAll({Feature::kMeasured, Feature::kTangents}));
  CHECK(features("image-lights.pbrt")
            .HasAll({Feature::kImageLights, Feature::kEmissionImages}));
  CHECK(features("portal.pbrt").Has(Feature::kPortals));
  CHECK(features("panorama.pbrt").Has(Feature::kSphericalCamera));
  CHECK(features("lens-system.pbrt").Has(Feature::kRealisticCamera));
  CHECK(features("stiff/roughness-1e-4.pbrt")
            .HasAll({Feature::kConductorRough, Feature::kConductorSmooth}));
}

namespace {

// False, with a warning, where there is no Python.
bool HasPython() {
  const bool has = std::system("python3 --version > /dev/null 2>&1") == 0;
  if (!has) WARN("skipped: no python3");
  return has;
}

// Starts scenes/generate; its exit status.
int Generate(const std::string& what, const fs::path& out) {
  return std::system(("python3 " LANELIGHT_SOURCE_DIR "/scenes/generate " + what +
                      " --out " + out.string() + " > /dev/null 2>&1")
                         .c_str());
}

}  // namespace

TEST_CASE("own scenes: generated meshes can be read", "[scenes]") {
  if (!HasPython()) return;
  const fs::path folder = fs::temp_directory_path() / "lanelight_generate_test";
  fs::remove_all(folder);
  REQUIRE(Generate("all --size 300", folder) == 0);
  for (const char* name : {"terrain", "soup", "flake", "needles", "sticks", "stadium"}) {
    const SceneDescription scene = ParseScene((folder / name).string() + ".pbrt");
    INFO(name);
    REQUIRE(scene.shapes.size() == 1);
    CHECK(scene.shapes[0].mesh->indices.size() >= 3 * 288);
    REQUIRE_NOTHROW(PrepareScene(scene));
    CHECK(ReadText((folder / name).string() + ".cam").starts_with("eye "));
  }
  // The same arguments give the same bytes; bad ones a usage error.
  const std::string first = ReadText(folder / "soup.ply");
  REQUIRE(Generate("soup --size 300", folder) == 0);
  CHECK(ReadText(folder / "soup.ply") == first);
  CHECK(Generate("soup --size 2", folder) != 0);
  fs::remove_all(folder);
}

TEST_CASE("own scenes: the generated kitchen is many meshes, the same each time",
          "[scenes]") {
  if (!HasPython()) return;
  const fs::path folder = fs::temp_directory_path() / "lanelight_kitchen_test";
  fs::remove_all(folder);
  for (const char* out : {"first", "second"}) {
    REQUIRE(Generate("kitchen", folder / out) == 0);
  }
  const fs::path first = folder / "first" / "kitchen";
  const fs::path second = folder / "second" / "kitchen";
  for (const auto& entry : fs::recursive_directory_iterator(first)) {
    if (!entry.is_regular_file()) continue;
    INFO(entry.path());
    CHECK(ReadText(entry.path()) == ReadText(second / fs::relative(entry.path(), first)));
  }
  const SceneDescription scene = ParseScene((first / "kitchen.pbrt").string());
  for (const Note& note : scene.notes) {
    INFO(note.where.ToString() << ": " << note.message);
    CHECK(note.message.find("savefp16") != std::string::npos);
  }
  // 400 meshes; the bulb, the strip and the door are the other shapes.
  CHECK(scene.shapes.size() == 403);
  const FeatureSet features = CompileScene(scene).features;
  CHECK(features.HasAll({Feature::kVertexNormals, Feature::kPortals,
                         Feature::kDistantLights, Feature::kRectangleLights,
                         Feature::kSphereLights, Feature::kConductorRough,
                         Feature::kDielectricSmooth, Feature::kDiffuseTransmission}));
  CHECK_FALSE(features.Has(Feature::kInstances));
  CHECK(Generate("kitchen --size 300", folder) != 0);
  fs::remove_all(folder);
}

TEST_CASE("own scenes: the generated herd is one mesh, 250 times", "[scenes]") {
  if (!HasPython()) return;
  const fs::path folder = fs::temp_directory_path() / "lanelight_herd_test";
  fs::remove_all(folder);
  REQUIRE(Generate("herd --size 4000", folder) == 0);
  const SceneDescription scene = ParseScene((folder / "herd" / "herd.pbrt").string());
  CHECK(scene.instances.size() == 250);
  CHECK(CompileScene(scene).features.Has(Feature::kInstances));
  CHECK(Generate("herd --size 2", folder) != 0);
  fs::remove_all(folder);
}

TEST_CASE("own scenes: images equal the output of scenes/parts/maps", "[scenes]") {
  if (!HasPython()) return;
  const fs::path parts = fs::path(LANELIGHT_SOURCE_DIR) / "scenes" / "parts";
  const fs::path folder = fs::temp_directory_path() / "lanelight_maps_test";
  fs::remove_all(folder);
  REQUIRE(
      std::system(("python3 " + (parts / "maps").string() + " --out " + folder.string())
                      .c_str()) == 0);
  for (const char* name : {"ripples.tga", "dents.tga", "tiles.tga"}) {
    CHECK(ReadText(folder / name) == ReadText(parts / name));
  }
  fs::remove_all(folder);
}

TEST_CASE("own scenes: turned parts equal the output of scenes/parts/turn", "[scenes]") {
  if (!HasPython()) return;
  const fs::path parts = fs::path(LANELIGHT_SOURCE_DIR) / "scenes" / "parts";
  const fs::path folder = fs::temp_directory_path() / "lanelight_turn_test";
  fs::remove_all(folder);
  REQUIRE(
      std::system(("python3 " + (parts / "turn").string() + " --out " + folder.string())
                      .c_str()) == 0);
  int written = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    INFO(entry.path());
    CHECK(ReadText(entry.path()) == ReadText(parts / entry.path().filename()));
    ++written;
  }
  CHECK(written == 4);
  fs::remove_all(folder);
}

TEST_CASE("own scenes: hair equals the output of scenes/parts/comb", "[scenes]") {
  if (!HasPython()) return;
  const fs::path parts = fs::path(LANELIGHT_SOURCE_DIR) / "scenes" / "parts";
  const fs::path folder = fs::temp_directory_path() / "lanelight_comb_test";
  fs::remove_all(folder);
  REQUIRE(
      std::system(("python3 " + (parts / "comb").string() + " --out " + folder.string())
                      .c_str()) == 0);
  CHECK(ReadText(folder / "tuft.pbrt") == ReadText(parts / "tuft.pbrt"));
  fs::remove_all(folder);
}

}  // namespace lanelight
