// Names are bytes. Directories, scenes, meshes, materials and outputs whose names are not
// UTF-8 are read, rendered and written like all others; JSON has U+FFFD for such bytes.
#include <catch2/catch.hpp>
#include <filesystem>

#include "src/base/image/exr.h"
#include "src/cli/exit_codes.h"
#include "tests/cli/process.h"
#include "tests/support/json.h"

namespace lanelight::strange_names {
namespace {

using Catch::Contains;
namespace fs = std::filesystem;

constexpr const char* kReplaced = "\xef\xbf\xbd";

// A folder "d<ff>" with a scene "s<ff>.pbrt", whose mesh "m<ff>.ply" has a triangle that
// is noted, and whose material has such a name too.
struct Strange {
  const TempDirectory& directory;

  explicit Strange(const TempDirectory& d) : directory(d) {
    fs::create_directory(File(""));
    WriteText(File("m\xff.ply"),
              "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
              "property float y\nproperty float z\nelement face 2\n"
              "property list uchar int vertex_indices\nend_header\n"
              "-1 -1 5\n1 -1 5\n0 1 5\n3 0 1 2\n3 0 0 1\n");
    WriteText(Scene(), R"(
Camera "perspective"
Film "rgb" "integer xresolution" 16 "integer yresolution" 12
Sampler "independent" "integer pixelsamples" 4
WorldBegin
MakeNamedMaterial "mat)"
                       "\xff"
                       R"(" "string type" "diffuse"
NamedMaterial "mat)"
                       "\xff"
                       R"("
LightSource "point"
Shape "plymesh" "string filename" "m)"
                       "\xff"
                       R"(.ply"
)");
  }

  std::string File(const std::string& name) const {
    return directory / ("d\xff" + ("/" + name));
  }
  std::string Scene() const { return File("s\xff.pbrt"); }
};

// It ends well, and says nothing that is meant for programmers.
std::string Run(const std::vector<std::string>& arguments) {
  const ProcessResult r = RunLanelight(arguments);
  INFO(arguments[0] << ": " << r.err);
  CHECK(r.exit_code == kExitGood);
  CHECK_THAT(r.err, !Contains("exception") && !Contains("UTF-8"));
  return r.out;
}

void CheckSays(const nlohmann::json& report) {
  CHECK_THAT(report.at("scene").get<std::string>(),
             Contains(std::string("/s") + kReplaced + ".pbrt"));
}

}  // namespace

TEST_CASE("a render with names that are not UTF-8", "[cli][names]") {
  const TempDirectory directory;
  const Strange strange(directory);
  const std::string exr = strange.File("o\xff.exr"), json = strange.File("r\xff.json");
  const std::string state = strange.File("st\xff");
  Run({"render", strange.Scene(), "-o", exr, "--png", "--json", json});
  CHECK(fs::exists(strange.File("o\xff.png")));
  CHECK_FALSE(ReadExr(exr).attributes.empty());
  const nlohmann::json report = test::ReadJson(json);
  CheckSays(report);
  CHECK_THAT(report.at("notes").dump(), Contains(kReplaced) && Contains("degenerate"));
  Run({"render", strange.Scene(), "-o", exr, "--checkpoint", state});
  Run({"render", strange.Scene(), "-o", exr, "--resume", state, "--spp", "8"});
  CheckSays(nlohmann::json::parse(
      Run({"merge", state, "-o", exr, "--json", "-", "--state", strange.File("n\xff")})));
}

TEST_CASE("reports on scenes with names that are not UTF-8", "[cli][names]") {
  const TempDirectory directory;
  const Strange strange(directory);
  CheckSays(nlohmann::json::parse(Run({"plan", strange.Scene(), "--json"})));
  Run({"profile", strange.Scene(), "--spp", "1", "--json", strange.File("p\xff"),
       "--trace", strange.File("t\xff")});
  CHECK_THAT(test::ReadJson(strange.File("t\xff")).dump(), Contains("profile"));
  Run({"stress", "unit-of-length", "--out", strange.File("x\xff"), "--quiet"});
  CHECK(fs::exists(strange.File("x\xff/stress.json")));
}

TEST_CASE("studies and sweeps with names that are not UTF-8", "[cli][names]") {
  const TempDirectory directory;
  const Strange strange(directory);
  const std::string reference = strange.File("ref\xff.exr");
  Run({"render", strange.Scene(), "-o", reference, "--spp", "64", "--quiet"});
  const std::vector<std::string> study = {"study",         strange.Scene(),
                                          "--out",         strange.File("st\xff"),
                                          "--spp",         "1",
                                          "--strategies",  "default",
                                          "--repetitions", "2",
                                          "--reference",   reference,
                                          "--resume",      "--quiet"};
  for (int run = 0; run < 2; ++run) Run(study);  // the second goes on
  const nlohmann::json report = test::ReadJson(strange.File("st\xff/study.json"));
  CHECK_THAT(report.at("scenes").at(0).at("name").get<std::string>(),
             Contains(kReplaced));
  fs::copy_file(strange.Scene(), strange.File("s.pbrt"));
  const std::string sweep =
      WriteText(strange.File("w\xff.toml"), "[grid]\nscene = \"s.pbrt\"\nspp = [1, 2]\n");
  for (int run = 0; run < 2; ++run) {
    Run({"sweep", sweep, "--out", strange.File("sw\xff"), "--quiet"});
  }
  CHECK(fs::file_size(strange.File("sw\xff/sweep.csv")) > 0);
}

}  // namespace lanelight::strange_names
