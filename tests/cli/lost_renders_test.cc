// What would lose a render, or what it was made from, is seen before the first sample,
// and what ends a render early leaves its image.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <filesystem>

#include "src/base/image/exr.h"
#include "src/cli/exit_codes.h"
#include "tests/cli/process.h"
#include "tests/kernels/texture/texture_files.h"

namespace lanelight {
namespace {

using Catch::Contains;
namespace fs = std::filesystem;

std::function<void()> Limit(int resource, rlim_t soft, rlim_t hard) {
  return [=] {
    const rlimit limit = {soft, hard};
    setrlimit(static_cast<__rlimit_resource>(resource), &limit);
  };
}

// A scene of several files; the mesh has enough triangles for a tree.
std::string WriteSceneOfFiles(const TempDirectory& directory) {
  std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 600\nproperty float x\nproperty float y\n"
      "property float z\nelement face 200\nproperty list uchar int vertex_indices\n"
      "end_header\n";
  for (int i = 0; i < 200; ++i) {
    const int x = i % 20 - 10, y = i / 20 - 5, z = i % 7;
    ply += fmt::format("{0} {1} {2}\n{3} {1} {2}\n{0} {4} {2}\n", x, y, z, x + 1, y + 1);
  }
  for (int i = 0; i < 200; ++i) {
    ply += fmt::format("3 {} {} {}\n", 3 * i, 3 * i + 1, 3 * i + 2);
  }
  WriteText(directory / "mesh.ply", ply);
  WriteText(directory / "part.pbrt",
            "LightSource \"point\" \"point3 from\" [ 0 0 -9 ]\n");
  WriteRandomExr(directory / "color.exr", 2, 2, false);
  WriteRandomExr(directory / "sky.exr", 2, 2, false);
  return WriteText(directory / "scene.pbrt", R"(
LookAt 0 0 -20  0 0 0  0 1 0
Camera "perspective" "float fov" 60
Film "rgb" "integer xresolution" 32 "integer yresolution" 24
  "string filename" "film.exr"
Sampler "independent" "integer pixelsamples" 2
WorldBegin
Include "part.pbrt"
LightSource "infinite" "string filename" "sky.exr"
Texture "color" "spectrum" "imagemap" "string filename" "color.exr"
Material "diffuse" "texture reflectance" "color"
Shape "plymesh" "string filename" "mesh.ply"
)");
}

}  // namespace

TEST_CASE("no output overwrites a file that the scene reads", "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteSceneOfFiles(directory), exr = directory / "out.exr";
  fs::create_symlink(directory / "color.exr", directory / "link.exr");
  fs::create_symlink(directory / "color.exr", directory / "link.png");
  fs::create_symlink(directory / "color.exr", directory / "link.html");
  fs::create_hard_link(directory / "sky.exr", directory / "hard.exr");
  const auto refused = [&](std::vector<std::string> arguments, const std::string& file) {
    INFO(arguments.back());
    const std::uintmax_t size = fs::file_size(directory / file);
    const ProcessResult r = RunLanelight(arguments);
    CHECK(r.exit_code == kExitBadInput);
    CHECK_THAT(r.err,
               Contains("would overwrite") && Contains(file) && !Contains("rendering"));
    CHECK(fs::file_size(directory / file) == size);
  };
  for (const char* output : {"color.exr", "link.exr"}) {
    refused({"render", scene, "-o", directory / output}, "color.exr");
  }
  refused({"render", scene, "-o", directory / "hard.exr"}, "sky.exr");
  refused({"render", scene, "-o", exr, "--json", directory / "mesh.ply"}, "mesh.ply");
  refused({"render", scene, "-o", exr, "--checkpoint", directory / "part.pbrt"},
          "part.pbrt");
  refused({"render", scene, "-o", exr, "--watch", directory / "color.exr"}, "color.exr");
  refused({"profile", scene, "--trace", directory / "mesh.ply"}, "mesh.ply");
  refused({"render", scene, "-o", exr, "--png", directory / "link.png"}, "color.exr");
  refused({"profile", scene, "--html", directory / "link.html"}, "color.exr");
  refused({"profile", scene, "--json", directory / "part.pbrt"}, "part.pbrt");
  for (const char* read : {"scene.pbrt", "part.pbrt", "mesh.ply", "sky.exr"}) {
    refused({"profile", scene, "--json", directory / read}, read);
  }
  // The film's name decides where the output goes.
  const std::string film = directory / "film.exr";
  REQUIRE(RunLanelight({"render", scene, "-o", film}).exit_code == kExitGood);
  CHECK(RunLanelight({"render", scene, "-o", film}).exit_code == kExitGood);
}

TEST_CASE("no results folder may contain an input file", "[cli]") {
  TempDirectory directory;
  const std::string scene = directory / "box.pbrt", out = directory / "out";
  fs::rename(WriteSceneOfFiles(directory), scene);
  fs::create_directories(out + "/cells/old");
  fs::create_directories(out + "/box");
  const auto refused = [&](const std::vector<std::string>& arguments,
                           const std::string& file) {
    const ProcessResult r = RunLanelight(arguments);
    INFO(arguments[0] << " " << file << ": " << r.err);
    CHECK(r.exit_code == kExitBadInput);
    CHECK_THAT(r.err, Contains(file) && Contains("which is an input"));
  };
  const std::string sweep =
      WriteText(directory / "sweep.toml", "[grid]\nscene = \"box.pbrt\"\nspp = 1\n");
  for (const char* kept : {"out/cells/old/sky.exr", "out/report.html"}) {
    fs::rename(directory / "sky.exr", directory / kept);
    fs::create_symlink(directory / kept, directory / "sky.exr");
    refused({"sweep", sweep, "--out", out}, "sky.exr");
    fs::rename(directory / kept, directory / "sky.exr");
  }
  for (const char* kept : {"out/box/sky.exr", "out/study.csv"}) {
    fs::rename(directory / "sky.exr", directory / kept);
    fs::create_symlink(directory / kept, directory / "sky.exr");
    refused({"study", scene, "--out", out, "--spp", "1", "--resume"}, "sky.exr");
    fs::rename(directory / kept, directory / "sky.exr");
  }
  fs::rename(scene, out + "/box/box.pbrt");
  refused({"study", out + "/box/box.pbrt", "--out", out, "--resume"}, "box.pbrt");
}

TEST_CASE("impossible or duplicate outputs are refused before rendering", "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteSceneOfFiles(directory), state = directory / "a.state";
  const std::string exr = directory / "a.exr", none = directory / "none/a";
  REQUIRE(RunLanelight({"render", scene, "-o", exr, "--checkpoint", state}).exit_code ==
          kExitGood);
  const std::vector<std::vector<std::string>> commands = {
      {"render", scene, "-o", exr, "--json"},
      {"render", scene, "-o", exr, "--png", exr + ".png", "--checkpoint"},
      {"profile", scene, "--trace", exr, "--json"},
      {"merge", state, "-o", exr, "--json"},
      {"merge", state, "-o", exr, "--state"},
      {"stress", "units", "--json"},
      {"stress", "units", "--out", directory / "results", "--json"}};
  for (const std::vector<std::string>& command : commands) {
    const auto refused = [&](const std::string& output, const char* why) {
      std::vector<std::string> arguments = command;
      arguments.push_back(output);
      const ProcessResult r = RunLanelight(arguments);
      INFO(command[0] << " " << output << ": " << r.err);
      CHECK(r.exit_code == kExitBadInput);
      CHECK_THAT(r.err, Contains(why) && !Contains("rendering"));
    };
    refused(none, "no directory");
    refused(directory.path(), "directory");
    refused("/dev/full", "not a regular file");
    if (command[0] != "stress") refused(exr, "two outputs");
    if (command.size() == 5 && command[0] == "stress") {
      refused(directory / "results/stress.json", "two outputs");
    }
  }
  if (geteuid() == 0) return;  // who may write everywhere
  fs::create_directory(directory / "closed");
  fs::permissions(directory / "closed", fs::perms::owner_read | fs::perms::owner_exec);
  CHECK_THAT(RunLanelight({"render", scene, "-o", directory / "closed/o.exr"}).err,
             Contains("Permission denied"));
}

TEST_CASE("a scene whose film names the output can be resumed", "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteSceneOfFiles(directory), film = directory / "film.exr";
  const std::string state = directory / "film.state";
  const auto render = [&](const char* spp) {
    return RunLanelight(
        {"render", scene, "-o", film, "--checkpoint", state, "--resume", "--spp", spp});
  };
  REQUIRE(render("2").exit_code == kExitGood);
  const ProcessResult r = render("4");
  INFO(r.err);
  CHECK(r.exit_code == kExitGood);
}

TEST_CASE("only the next checkpoint may overwrite a checkpoint", "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteSphereScene(directory), state = directory / "a.state";
  const std::string exr = directory / "a.exr";
  REQUIRE(RunLanelight({"render", scene, "-o", exr, "--checkpoint", state}).exit_code ==
          kExitGood);
  const ProcessResult r =
      RunLanelight({"render", scene, "-o", exr, "--resume", state, "--checkpoint",
                    directory / "b.state", "--json", state, "--spp", "32"});
  CHECK(r.exit_code == kExitBadInput);
  CHECK_THAT(r.err, Contains("would overwrite") && Contains("a.state"));
  const std::string other = directory / "other.state";
  fs::copy_file(state, other);
  const ProcessResult replaced = RunLanelight(
      {"render", scene, "-o", exr, "--resume", state, "--checkpoint", other});
  CHECK(replaced.exit_code == kExitBadInput);
  CHECK_THAT(replaced.err, Contains("other.state' exists"));
  for (const char* flag : {"--json", "--state"}) {
    const ProcessResult merge = RunLanelight({"merge", state, "-o", exr, flag, state});
    CHECK(merge.exit_code == kExitBadInput);
    CHECK_THAT(merge.err, Contains("would overwrite"));
  }
}

TEST_CASE("a name that is too long is refused before rendering", "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteSphereScene(directory);
  const std::string name = directory / (std::string(250, 'n') + ".exr");
  const ProcessResult r = RunLanelight({"render", scene, "-o", name + "x.exr"});
  CHECK(r.exit_code == kExitBadInput);
  CHECK_THAT(r.err, Contains("too long") && !Contains("rendering"));
  // As long as a name can be.
  CHECK(RunLanelight({"render", scene, "-o", name}).exit_code == kExitGood);
  CHECK(fs::exists(name));
}

TEST_CASE("terminating signals leave an image", "[cli]") {
  for (const int number : {SIGHUP, SIGTERM, SIGXCPU}) {
    INFO(number);
    TempDirectory directory;
    const std::string scene = WriteSphereScene(directory), exr = directory / "i.exr";
    ProcessOptions options;
    options.trigger = "rendering";
    options.action = [=](int child) { kill(child, number); };
    options.prepare = [=] { signal(number, SIG_DFL); };
    const ProcessResult r = RunLanelight(
        {"render", scene, "-o", exr, "--time", "20", "--strategy", "decide=none"},
        options);
    INFO(r.err);
    CHECK(r.exit_code == kExitGood);
    CHECK_THAT(r.out, Contains("stopped early"));
    CHECK(ReadExr(exr).width == 32);
  }
}

TEST_CASE("a limit of processor time leaves an image", "[cli]") {
  // The soft limit sends a signal, and again every second; at the hard one the kernel
  // kills, and it is what `ulimit -t` sets.
  for (const rlim_t soft : {1, 2}) {
    INFO(soft);
    TempDirectory directory;
    const std::string scene = WriteSphereScene(directory), exr = directory / "i.exr";
    ProcessOptions options;
    options.prepare = Limit(RLIMIT_CPU, soft, 2);
    const ProcessResult r = RunLanelight(
        {"render", scene, "-o", exr, "--time", "50", "--threads", "1"}, options);
    INFO(r.err);
    CHECK(r.exit_code == kExitGood);
    CHECK_THAT(r.out, Contains("stopped early"));
    CHECK(ReadExr(exr).width == 32);
  }
}

TEST_CASE("a small stack is enough", "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteSceneOfFiles(directory), exr = directory / "i.exr";
  for (const char* threads : {"1", "2"}) {
    ProcessOptions options;
    options.prepare = Limit(RLIMIT_STACK, 512 * 1024, 512 * 1024);
    const ProcessResult r =
        RunLanelight({"render", scene, "-o", exr, "--threads", threads}, options);
    INFO(r.err);
    CHECK(r.exit_code == kExitGood);
    CHECK(r.signal == 0);
  }
}

TEST_CASE("running out of memory reports the available memory", "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteSphereScene(directory), exr = directory / "i.exr";
  ProcessOptions options;
  options.prepare = Limit(RLIMIT_AS, rlim_t{1} << 30, rlim_t{1} << 30);
  const ProcessResult film = RunLanelight(
      {"render", scene, "-o", exr, "--resolution", "8000x8000", "--spp", "1"}, options);
  CHECK(film.exit_code == kExitBadInput);
  CHECK_THAT(film.err, Contains("GiB of memory") && Contains("1.0 GiB"));
  const ProcessResult wavefront =
      RunLanelight({"render", scene, "-o", exr, "--resolution", "2000x1500", "--spp", "1",
                    "--wavefront", "1048576", "--threads", "8"},
                   options);
  if (wavefront.exit_code == kExitGood) return;  // it has got by with that
  CHECK_THAT(wavefront.err, Contains("out of memory") && Contains("GiB"));
}

}  // namespace lanelight
