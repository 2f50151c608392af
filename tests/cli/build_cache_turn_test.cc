// Processes that want the trees of one --build-cache at once, and folders where they
// cannot agree.
#include <fcntl.h>
#include <signal.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <filesystem>
#include <memory>
#include <thread>

#include "src/cli/exit_codes.h"
#include "src/core/file_descriptor.h"
#include "tests/cli/process.h"
#include "tests/support/json.h"

namespace lanelight {
namespace {

using Catch::Contains;
namespace fs = std::filesystem;

// A scene, and a folder for its trees.
struct SharedCache {
  TempDirectory directory;
  std::string scene = WriteSphereScene(directory), cache = directory / "cache";

  std::vector<std::string> Arguments(const std::string& name) const {
    return {"render",
            scene,
            "-o",
            directory / (name + ".exr"),
            "--json",
            Report(name),
            "--spp",
            "1",
            "--resolution",
            "16x12",
            "--build-cache",
            cache};
  }
  std::string Report(const std::string& name) const {
    return directory / (name + ".json");
  }
  // "built" or "mapped".
  std::string Origin(const std::string& name) const {
    return test::ReadJson(Report(name)).at("trees").at("origin");
  }
  // As another process would that builds, whatever the tree.
  std::unique_ptr<FileDescriptor> Occupy() const {
    fs::create_directories(cache);
    auto file = std::make_unique<FileDescriptor>(
        open((cache + "/locks").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
    struct flock all = {};  // bytes, to the last one there may be
    all.l_type = F_WRLCK;
    REQUIRE(fcntl(file->get(), F_OFD_SETLK, &all) == 0);
    return file;
  }
};

constexpr const char* kWaits = "waiting for another process to build";

int CountOf(const std::string& text, const std::string& part) {
  int n = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) {
    ++n;
  }
  return n;
}

}  // namespace

TEST_CASE("of processes that start at once one builds", "[cli]") {
  const SharedCache shared;
  constexpr int kProcesses = 3;
  auto other = shared.Occupy();  // until all of them wait, so that they want it at once
  std::atomic<int> waiting{0};
  ProcessOptions options;
  options.trigger = kWaits;
  options.action = [&](int) {
    if (++waiting == kProcesses) other.reset();
  };
  std::vector<ProcessResult> results(kProcesses);
  std::vector<std::thread> threads;
  for (int i = 0; i < kProcesses; ++i) {
    threads.emplace_back([&, i] {
      results[i] = RunLanelight(shared.Arguments(std::to_string(i)), options);
    });
  }
  for (std::thread& thread : threads) thread.join();
  std::map<std::string, int> origins;
  for (int i = 0; i < kProcesses; ++i) {
    INFO(results[i].err);
    CHECK(results[i].exit_code == kExitGood);
    CHECK(CountOf(results[i].err, kWaits) == 1);
    CHECK_THAT(results[i].err, !Contains("note"));
    ++origins[shared.Origin(std::to_string(i))];
  }
  CHECK(origins == std::map<std::string, int>{{"built", 1}, {"mapped", kProcesses - 1}});
}

TEST_CASE("Ctrl-C ends waiting for trees", "[cli][sweep]") {
  const SharedCache shared;
  const auto other = shared.Occupy();
  ProcessOptions options;
  options.trigger = kWaits;
  options.action = [](int child) { kill(child, SIGINT); };
  CHECK(RunLanelight(shared.Arguments("a"), options).signal == SIGINT);
  const std::string file =
      WriteText(shared.directory / "sweep.toml",
                "[grid]\nscene = \"sphere.pbrt\"\nresolution = \"16x12\"\nspp = 2\n");
  const std::string out = shared.directory / "out";
  const ProcessResult sweep =
      RunLanelight({"sweep", file, "--out", out, "--build-cache", shared.cache}, options);
  INFO(sweep.err);
  CHECK(sweep.exit_code == kExitInterrupted);
  CHECK_THAT(sweep.err, !Contains("failed"));
  for (const auto& cell : fs::directory_iterator(out + "/cells")) {
    CHECK(fs::is_empty(cell));
  }
  const ProcessResult study = RunLanelight(
      {"study", shared.scene, "--out", shared.directory / "study", "--spp", "1",
       "--strategies", "default", "--repetitions", "2", "--build-cache", shared.cache},
      options);
  CHECK(study.exit_code == kExitBadInput);
  CHECK_THAT(study.err, Contains("stopped while another process was building"));
}

TEST_CASE("a file system without locks costs a note", "[cli]") {
  const SharedCache shared;
  ProcessOptions options;
  options.prepare = ForbidLocks;
  const ProcessResult cold = RunLanelight(shared.Arguments("a"), options);
  INFO(cold.err);
  CHECK(cold.exit_code == kExitGood);
  CHECK(CountOf(cold.err, "--build-cache: note: ") == 1);
  CHECK_THAT(cold.err, Contains("/locks: this file system knows no locks"));
  CHECK(shared.Origin("a") == "built");
  const ProcessResult warm = RunLanelight(shared.Arguments("a"), options);
  CHECK_THAT(warm.err, !Contains("--build-cache"));
  CHECK(shared.Origin("a") == "mapped");
}

TEST_CASE("a folder that can only be read is mapped from, or costs a note", "[cli]") {
  const SharedCache shared;
  REQUIRE(RunLanelight(shared.Arguments("a")).exit_code == kExitGood);
  fs::permissions(shared.directory.path(), fs::perms::all);
  fs::remove(shared.Report("a"));
  fs::remove(shared.directory / "a.exr");
  fs::permissions(shared.cache, fs::perms{0555});
  ProcessOptions options;
  // The superuser may write anywhere.
  if (geteuid() == 0) options.prepare = [] { [[maybe_unused]] int r = setuid(65534); };
  const ProcessResult mapped = RunLanelight(shared.Arguments("a"), options);
  INFO(mapped.err);
  CHECK(shared.Origin("a") == "mapped");
  CHECK_THAT(mapped.err, !Contains("--build-cache"));
  std::vector<std::string> arguments = shared.Arguments("b");
  for (const char* more : {"--build", "fast"}) arguments.emplace_back(more);
  const ProcessResult built = RunLanelight(arguments, options);
  fs::permissions(shared.cache, fs::perms::owner_all);
  INFO(built.err);
  CHECK(shared.Origin("b") == "built");
  CHECK(CountOf(built.err, "--build-cache: note: ") == 1);
  CHECK_THAT(built.err, Contains("Permission denied; the trees are not kept"));
}

}  // namespace lanelight
