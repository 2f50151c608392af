// Locks exclude others name by name, and end with whoever has them.
#include "src/base/core/file_lock.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <vector>

#include "src/base/core/error.h"
#include "tests/base/image/temporary_folder.h"

namespace lanelight {

TEST_CASE("a lock has one owner at a time", "[core][lock]") {
  const TemporaryFolder folder;
  // Two objects are like two processes: locks belong to open files.
  const LockFile a(folder.File("a")), b(folder.File("a"));
  CHECK(a.supports_locks());
  {
    const auto x = a.TryLock("x");
    REQUIRE(x);
    CHECK_FALSE(b.TryLock("x"));
    CHECK(b.TryLock("y"));
    const auto z = b.TryLock("z");
    CHECK(z);
    CHECK_FALSE(a.TryLock("z"));
  }
  CHECK(b.TryLock("x"));
  CHECK(a.TryLock("z"));
}

TEST_CASE("a moved lock has the new owner", "[core][lock]") {
  const TemporaryFolder folder;
  const LockFile a(folder.File("a")), b(folder.File("a"));
  std::optional<ScopedLock> kept;
  {
    auto x = a.TryLock("x");
    REQUIRE(x);
    kept = std::move(x);
  }
  CHECK_FALSE(b.TryLock("x"));
  kept = a.TryLock("y");
  CHECK(b.TryLock("x"));
  CHECK_FALSE(b.TryLock("y"));
  kept.reset();
  CHECK(b.TryLock("y"));
}

TEST_CASE("a lock is released with its object, however often the file is open",
          "[core][lock]") {
  const TemporaryFolder folder;
  const std::string path = folder.File("a");
  const LockFile one(path);
  {
    const LockFile other(path);
    const auto claim = other.TryLock("x");
    CHECK(claim);
    CHECK_FALSE(one.TryLock("x"));
    {
      const LockFile third(path);
    }  // whose end frees nothing of the second one's
    CHECK_FALSE(one.TryLock("x"));
  }
  CHECK(one.TryLock("x"));
}

TEST_CASE("locks of a killed process are released immediately", "[core][lock]") {
  const TemporaryFolder folder;
  const std::string path = folder.File("a");
  int ready[2];
  REQUIRE(pipe(ready) == 0);
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    const LockFile file(path);
    const auto claim = file.TryLock("x");
    const char is_locked = claim ? 'y' : 'n';
    if (write(ready[1], &is_locked, 1) == 1) pause();
    _exit(1);
  }
  char is_locked = 0;
  REQUIRE(read(ready[0], &is_locked, 1) == 1);
  CHECK(is_locked == 'y');
  const LockFile own(path), other(path);
  CHECK_FALSE(own.TryLock("x"));
  kill(child, SIGKILL);
  // Until the kernel has closed the child's files.
  const auto takeover = own.Wait("x", [](double) { return true; });
  CHECK(takeover);
  CHECK(waitpid(child, nullptr, 0) == child);
  CHECK_FALSE(other.TryLock("x"));
  close(ready[0]);
  close(ready[1]);
}

TEST_CASE("waiting for a lock can be cancelled", "[core][lock]") {
  const TemporaryFolder folder;
  const LockFile a(folder.File("a")), b(folder.File("a"));
  const auto claim = a.TryLock("x");
  std::vector<double> waited;
  const auto keep_waiting = [&](double seconds) {
    waited.push_back(seconds);
    return waited.size() < 4;
  };
  CHECK_FALSE(b.Wait("x", keep_waiting));
  REQUIRE(waited.size() == 4);
  CHECK(waited[0] < waited[1]);
  CHECK(waited[3] >= 0.007);  // pauses of 1, 2 and 4 ms
  CHECK(b.Wait("y", keep_waiting));
  CHECK(waited.size() == 4);
}

TEST_CASE("ten thousand locks use one file", "[core][lock]") {
  const TemporaryFolder folder;
  const LockFile a(folder.File("a")), b(folder.File("a"));
  std::vector<ScopedLock> locks;
  for (int i = 0; i < 10000; ++i) {
    auto lock = a.TryLock("cell " + std::to_string(i));
    REQUIRE(lock);
    locks.push_back(std::move(*lock));
  }
  CHECK_FALSE(b.TryLock("cell 0"));
  CHECK_FALSE(b.TryLock("cell 9999"));
  CHECK(b.TryLock("cell 10000"));
  CHECK(folder.Count() == 1);
}

TEST_CASE("a lock file detects that its path was replaced", "[core][lock]") {
  const TemporaryFolder folder;
  const std::string path = folder.File("a");
  const LockFile one(path);
  CHECK(one.IsNamed());
  unlink(path.c_str());
  CHECK_FALSE(one.IsNamed());
  const LockFile other(path);
  CHECK_FALSE(one.IsNamed());
  CHECK(other.IsNamed());
  CHECK_THROWS_WITH(LockFile(folder.File("none/a")),
                    Catch::Contains("none/a") && Catch::Contains("No such file"));
}

TEST_CASE("a note in a lock file is replaced completely", "[core][lock]") {
  const TemporaryFolder folder;
  LockFile file(folder.File("a"));
  CHECK(file.Note().empty());
  file.SetNote("something long");
  file.SetNote("short");
  CHECK(LockFile(file.path()).Note() == "short");
}

}  // namespace lanelight
