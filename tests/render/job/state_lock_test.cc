// One keeps a state; what killed ones have left goes away, and nothing else does.
#include "src/render/job/checkpoint.h"

#include <fmt/format.h>

#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <optional>

#include "src/base/core/error.h"
#include "tests/base/image/temporary_folder.h"

namespace lanelight {
namespace {

const auto kNoProblem = [](const std::string& problem) { FAIL(problem); };

}  // namespace

TEST_CASE("a checkpoint has one writer, and its lock file is removed",
          "[render][state]") {
  const TemporaryFolder folder;
  const std::string state = folder.File("s");
  {
    const StateLock lock(state, kNoProblem);
    CHECK_THROWS_WITH(StateLock(state, kNoProblem),
                      Catch::Contains(state) && Catch::Contains("is in use by") &&
                          Catch::Contains(fmt::format("process {} on ", getpid())));
    const StateLock other(folder.File("t"), kNoProblem);
    CHECK(folder.Count() == 2);
  }
  CHECK(folder.Count() == 0);
}

TEST_CASE("a lock file left by a killed process is ignored", "[render][state]") {
  const TemporaryFolder folder;
  folder.Write("s.lock", "process 1 on another machine, of a longer text than the next");
  const StateLock lock(folder.File("s"), kNoProblem);
  CHECK(LockFile(folder.File("s.lock")).Note().starts_with("process "));
  CHECK_THROWS_WITH(StateLock(folder.File("s"), kNoProblem),
                    !Catch::Contains("another machine"));
}

TEST_CASE("a lock removes the state's temporary files only", "[render][state]") {
  const TemporaryFolder folder;
  const char* const stale[] = {"s.12.0.tmp", "s.4294967295.17.tmp"};
  const char* const others[] = {"s",           "s.tmp",      "s..tmp",
                                "s.12.tmp",    "s.12..tmp",  "s..0.tmp",
                                "s.1.2.3.tmp", "s.x.0.tmp",  "s.12.0.tmp2",
                                "s2.12.0.tmp", "t.12.0.tmp", "s.12.0x.tmp"};
  for (const char* name : stale) folder.Write(name, "torn");
  for (const char* name : others) folder.Write(name, "somebody's");
  {
    const StateLock lock(folder.File("s"), kNoProblem);
  }
  for (const char* name : stale) {
    CAPTURE(name);
    CHECK_FALSE(std::filesystem::exists(folder.File(name)));
  }
  for (const char* name : others) {
    CAPTURE(name);
    CHECK(std::filesystem::exists(folder.File(name)));
  }
}

TEST_CASE("a refused process removes no files of the active one", "[render][state]") {
  const TemporaryFolder folder;
  std::optional<StateLock> lock;
  lock.emplace(folder.File("s"), kNoProblem);
  folder.Write("s.12.0.tmp", "being written");
  CHECK_THROWS_AS(StateLock(folder.File("s"), kNoProblem), InputError);
  CHECK(std::filesystem::exists(folder.File("s.12.0.tmp")));
}

}  // namespace lanelight
