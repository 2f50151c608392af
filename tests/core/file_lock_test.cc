// Locks exclude others range by range, and end with whoever has them.
#include "src/core/file_lock.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "src/core/error.h"
#include "tests/image/temporary_folder.h"

namespace lanelight {

TEST_CASE("ranges that touch no byte twice are locked side by side", "[core][lock]") {
  const TemporaryFolder folder;
  const std::string path = folder.File("a");
  LockFile one(path), other(path);
  CHECK(one.TryLock(10, 5) == LockOutcome::kTaken);
  CHECK(other.TryLock(10, 1) == LockOutcome::kBusy);
  CHECK(other.TryLock(14, 10) == LockOutcome::kBusy);
  CHECK(other.TryLock(0, 11) == LockOutcome::kBusy);
  CHECK(other.TryLock(0, 10) == LockOutcome::kTaken);
  CHECK(other.TryLock(15, 1) == LockOutcome::kTaken);
  one.Unlock(10, 3);
  CHECK(other.TryLock(10, 3) == LockOutcome::kTaken);
  CHECK(other.TryLock(13, 1) == LockOutcome::kBusy);
}

TEST_CASE("a lock goes away with its object, however often the file was opened",
          "[core][lock]") {
  const TemporaryFolder folder;
  const std::string path = folder.File("a");
  LockFile one(path);
  {
    LockFile other(path);
    CHECK(other.TryLock(0, 1) == LockOutcome::kTaken);
    CHECK(one.TryLock(0, 1) == LockOutcome::kBusy);
    const LockFile third(path);  // whose end frees nothing of the second one's
  }
  CHECK(one.TryLock(0, 1) == LockOutcome::kTaken);
}

TEST_CASE("a lock goes away with a process that is killed", "[core][lock]") {
  const TemporaryFolder folder;
  const std::string path = folder.File("a");
  int ready[2];
  REQUIRE(pipe(ready) == 0);
  const pid_t child = fork();
  if (child == 0) {
    LockFile lock(path);
    const char taken = lock.TryLock(0, 1) == LockOutcome::kTaken ? 'y' : 'n';
    if (write(ready[1], &taken, 1) == 1) pause();
    _exit(1);
  }
  char taken = 0;
  REQUIRE(read(ready[0], &taken, 1) == 1);
  CHECK(taken == 'y');
  LockFile own(path);
  CHECK(own.TryLock(0, 1) == LockOutcome::kBusy);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  CHECK(own.TryLock(0, 1) == LockOutcome::kTaken);
  close(ready[0]);
  close(ready[1]);
}

TEST_CASE("a lock file knows whether its path still names it", "[core][lock]") {
  const TemporaryFolder folder;
  const std::string path = folder.File("a");
  LockFile one(path);
  CHECK(one.IsNamed());
  unlink(path.c_str());
  CHECK_FALSE(one.IsNamed());
  const LockFile other(path);
  CHECK_FALSE(one.IsNamed());
  CHECK(other.IsNamed());
  CHECK_THROWS_WITH(LockFile(folder.File("none/a")),
                    Catch::Contains("none/a") && Catch::Contains("No such file"));
}

TEST_CASE("a note is replaced as a whole", "[core][lock]") {
  const TemporaryFolder folder;
  LockFile file(folder.File("a"));
  CHECK(file.Note().empty());
  file.SetNote("something long");
  file.SetNote("short");
  CHECK(LockFile(file.path()).Note() == "short");
}

}  // namespace lanelight
