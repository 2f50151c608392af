// Claims: at most one owner, and none that is dead.
#include "src/sweep/claims.h"

#include <catch2/catch.hpp>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "src/core/error.h"
#include "tests/image/temporary_folder.h"

namespace lanelight {

TEST_CASE("claims: one owner at a time", "[sweep]") {
  const TemporaryFolder folder;
  // Two objects are like two processes: locks belong to open files.
  const Claims a(folder.File("claims")), b(folder.File("claims"));
  CHECK(a.locking());
  {
    const auto x = a.Take("x");
    REQUIRE(x);
    CHECK_FALSE(b.Take("x"));
    CHECK(b.Take("y"));
    const auto z = b.Take("z");
    CHECK(z);
    CHECK_FALSE(a.Take("z"));
  }
  CHECK(b.Take("x"));
  CHECK(a.Take("z"));
}

TEST_CASE("claims: those of a killed process are free at once", "[sweep]") {
  const TemporaryFolder folder;
  const Claims claims(folder.File("claims"));
  int ready[2];
  REQUIRE(pipe(ready) == 0);
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    const Claims mine(folder.File("claims"));
    const auto claim = mine.Take("x");
    const char answer = claim ? 'y' : 'n';
    if (write(ready[1], &answer, 1) != 1) _exit(1);
    pause();
    _exit(0);
  }
  char answer = '?';
  REQUIRE(read(ready[0], &answer, 1) == 1);
  CHECK(answer == 'y');
  CHECK_FALSE(claims.Take("x"));
  kill(child, SIGKILL);
  // Waits until the kernel has closed the child's files.
  const auto taken_over = claims.Wait("x");
  REQUIRE(taken_over);
  CHECK(waitpid(child, nullptr, 0) == child);
  const Claims other(folder.File("claims"));
  CHECK_FALSE(other.Take("x"));
  close(ready[0]);
  close(ready[1]);
}

TEST_CASE("claims: ten thousand at once", "[sweep]") {
  const TemporaryFolder folder;
  const Claims a(folder.File("claims")), b(folder.File("claims"));
  std::vector<Claims::Claim> taken;
  for (int i = 0; i < 10000; ++i) {
    auto claim = a.Take("cell " + std::to_string(i));
    REQUIRE(claim);
    taken.push_back(std::move(*claim));
  }
  CHECK_FALSE(b.Take("cell 0"));
  CHECK_FALSE(b.Take("cell 9999"));
  CHECK(b.Take("cell 10000"));
  CHECK(folder.Count() == 1);
}

TEST_CASE("claims: a file that cannot be made is an error", "[sweep]") {
  CHECK_THROWS_WITH(Claims("/nowhere/claims"), Catch::Contains("/nowhere/claims") &&
                                                   Catch::Contains("No such file"));
  CHECK_THROWS_AS(Claims("/nowhere/claims", true), InputError);
}

}  // namespace lanelight
