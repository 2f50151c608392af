// Special files in every place where a file is read: a FIFO without a writer, an endless
// device, a directory. The program waits for none of them.
#include <catch2/catch.hpp>
#include <filesystem>
#include <sys/stat.h>

#include "src/cli/exit_codes.h"
#include "tests/cli/process.h"

namespace lanelight::special_files {
namespace {

using Catch::Contains;
namespace fs = std::filesystem;

struct Kind {
  const char *name, *said;
};
constexpr Kind kKinds[] = {
    {"fifo", "a FIFO"}, {"device", "a device"}, {"folder", "a directory"}};

std::string Make(const TempDirectory& directory, const std::string& name,
                 const Kind& kind) {
  const std::string path = directory / name, what = kind.name;
  fs::remove_all(path);
  if (what == "fifo") REQUIRE(mkfifo(path.c_str(), 0600) == 0);
  if (what == "device") fs::create_symlink("/dev/zero", path);
  if (what == "folder") fs::create_directory(path);
  return path;
}

// It ends by itself, at once, and says which file is what.
void CheckRefused(const std::vector<std::string>& arguments, const std::string& file,
                  const Kind& kind) {
  const ProcessResult r = RunLanelight(arguments);
  INFO(arguments[0] << " " << file << ", " << kind.name << ": " << r.err);
  CHECK(r.exit_code == kExitBadInput);
  CHECK_THAT(r.err, Contains(fs::path(file).filename().string()) && Contains(kind.said));
}

// Parts of a scene, before and in its world, that read the file.
struct Reader {
  const char *file, *before, *world;
};
constexpr Reader kReaders[] = {
    {"x.pbrt", "", "Include \"x.pbrt\""},
    {"x.pbrt", "", "Import \"x.pbrt\""},
    {"x.ply", "", "Shape \"plymesh\" \"string filename\" \"x.ply\""},
    {"x.nvdb", "",
     "MakeNamedMedium \"m\" \"string type\" \"nanovdb\" \"string filename\" \"x.nvdb\"\n"
     "MediumInterface \"m\" \"\"\nShape \"sphere\""},
    {"x.dat", "Camera \"realistic\" \"string lensfile\" \"x.dat\"", ""},
    {"x.png",
     "Camera \"realistic\" \"string lensfile\" \"lens.dat\" \"string aperture\" "
     "\"x.png\"",
     ""},
    {"x.spd", "", "LightSource \"point\" \"spectrum I\" \"x.spd\""},
    {"x.exr", "", "LightSource \"infinite\" \"string filename\" \"x.exr\""},
    {"x.png", "", "LightSource \"goniometric\" \"string filename\" \"x.png\""},
    {"x.pfm", "",
     "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"x.pfm\"\n"
     "Material \"diffuse\" \"texture reflectance\" \"t\"\nShape \"sphere\""},
    {"x.png", "",
     "Material \"diffuse\" \"string normalmap\" \"x.png\"\nShape \"sphere\""},
};

}  // namespace

TEST_CASE("scenes and their inputs must be regular files", "[cli][special_files]") {
  const TempDirectory directory;
  WriteText(directory / "lens.dat", "20 5 1.5 10\n-20 10 0 10\n");
  for (const Kind& kind : kKinds) {
    const std::string scene = Make(directory, "scene.pbrt", kind);
    CheckRefused({"plan", scene}, scene, kind);
  }
  for (const Reader& reader : kReaders) {
    fs::remove(directory / "scene.pbrt");
    const std::string scene =
        WriteText(directory / "scene.pbrt", std::string(reader.before) +
                                                "\nWorldBegin\nLightSource \"point\"\n" +
                                                reader.world + "\nShape \"sphere\"\n");
    for (const Kind& kind : kKinds) {
      const std::string file = Make(directory, reader.file, kind);
      CheckRefused({"render", scene, "-o", directory / "o.exr"}, file, kind);
    }
    fs::remove_all(directory / reader.file);
  }
}

TEST_CASE("images, checkpoints and sweeps must be regular files",
          "[cli][special_files]") {
  const TempDirectory directory;
  const std::string scene = WriteSphereScene(directory), image = directory / "image.exr";
  REQUIRE(RunLanelight({"render", scene, "-o", image, "--quiet"}).exit_code == kExitGood);
  for (const Kind& kind : kKinds) {
    for (const char* name : {"x.exr", "x.png", "x.pfm"}) {
      const std::string file = Make(directory, name, kind);
      CheckRefused({"compare", file, image}, file, kind);
      CheckRefused({"compare", image, file}, file, kind);
    }
    const std::string state = Make(directory, "state", kind);
    CheckRefused({"merge", state, "-o", directory / "o.exr"}, state, kind);
    CheckRefused({"render", scene, "-o", directory / "o.exr", "--resume", state}, state,
                 kind);
    const std::string sweep = Make(directory, "sweep.toml", kind);
    CheckRefused({"sweep", sweep, "--out", directory / "sweep"}, sweep, kind);
    const std::string study = directory / "study";
    fs::create_directories(study + "/sphere/cells");
    Make(directory, "study/sphere/cells/scene.json", kind);
    CheckRefused({"study", scene, "--out", study, "--resume"}, "scene.json", kind);
  }
}

}  // namespace lanelight::special_files
