// Of those who want one tree at once, one has the turn, and nobody waits for the dead.
#include "src/accel/tree_turn.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <memory>
#include <utility>

#include "src/core/interrupted.h"
#include "tests/image/temporary_folder.h"

namespace lanelight {
namespace {

using Catch::Contains;

constexpr TreeKey kKey = {1, 2}, kOtherKey = {3, 2};
constexpr double kLong = 60;  // seconds, that no test is to wait

struct Turns {
  TemporaryFolder temporary;
  TreeFolder folder = {.path = temporary.File("")};
};

// A process that has the turn and does nothing more.
class Holder {
 public:
  explicit Holder(const TreeFolder& folder) {
    int ready[2];
    REQUIRE(pipe(ready) == 0);
    child_ = fork();
    if (child_ == 0) {
      const TreeTurn turn(folder, kKey, 0);
      const char ours = turn.IsOurs() ? 'y' : 'n';
      if (write(ready[1], &ours, 1) == 1) pause();
      _exit(1);
    }
    char ours = 0;
    REQUIRE(read(ready[0], &ours, 1) == 1);
    CHECK(ours == 'y');
    close(ready[0]);
    close(ready[1]);
  }
  ~Holder() { Kill(); }

  void Stop() { kill(child_, SIGSTOP); }
  void Kill() {
    if (child_ <= 0) return;
    kill(child_, SIGKILL);
    waitpid(std::exchange(child_, 0), nullptr, 0);
  }

 private:
  pid_t child_ = 0;
};

}  // namespace

TEST_CASE("who comes first has the turn at once, for one tree", "[accel][tree-turn]") {
  const Turns t;
  const TreeTurn turn(t.folder, kKey, kLong), other(t.folder, kOtherKey, kLong);
  for (const TreeTurn* each : {&turn, &other}) {
    CHECK(each->IsOurs());
    CHECK_FALSE(each->Waited());
    CHECK(each->problem().empty());
  }
  CHECK(t.temporary.Count() == 1);
}

TEST_CASE("who waits says so once, and has the turn when it is given up",
          "[accel][tree-turn]") {
  Turns t;
  auto holder = std::make_unique<TreeTurn>(t.folder, kKey, kLong);
  std::vector<std::string> said;
  t.folder.on_wait = [&](const std::string& text) {
    said.push_back(text);
    holder.reset();
  };
  const TreeTurn turn(t.folder, kKey, kLong);
  CHECK(turn.IsOurs());
  CHECK(turn.Waited());
  CHECK(turn.problem().empty());
  REQUIRE(said.size() == 1);
  CHECK_THAT(said[0], Contains("another process") && Contains("60 s at most") &&
                          Contains(TreePath(t.folder, kKey)));
  CHECK(t.temporary.Count() == 1);
}

TEST_CASE("the turn of a process that is killed is free", "[accel][tree-turn]") {
  Turns t;
  Holder holder(t.folder);
  t.folder.on_wait = [&](const std::string&) { holder.Kill(); };
  const TreeTurn turn(t.folder, kKey, kLong);
  CHECK(turn.IsOurs());
  CHECK(turn.Waited());
}

TEST_CASE("nobody waits for ever for a process that was stopped", "[accel][tree-turn]") {
  const Turns t;
  Holder holder(t.folder);
  holder.Stop();
  const TreeTurn turn(t.folder, kKey, 0);
  CHECK_FALSE(turn.IsOurs());
  CHECK(turn.Waited());
  CHECK_THAT(turn.problem(), Contains(TreePath(t.folder, kKey) + ": another process"));
}

TEST_CASE("where no trees can be kept, all who wait build at once",
          "[accel][tree-turn]") {
  Turns t;
  TreeTurn holder(t.folder, kKey, kLong);
  t.folder.on_wait = [&](const std::string&) { holder.Abandon(); };
  const TreeTurn turn(t.folder, kKey, kLong);
  CHECK_FALSE(turn.IsOurs());
  CHECK(turn.Waited());
  CHECK(turn.problem().empty());
  CHECK(holder.IsOurs());
  CHECK(t.temporary.Count() == 0);
}

TEST_CASE("a stop ends waiting", "[accel][tree-turn]") {
  Turns t;
  const TreeTurn holder(t.folder, kKey, kLong);
  const std::atomic<bool> stop{true};
  t.folder.stop = &stop;
  CHECK_THROWS_AS(TreeTurn(t.folder, kKey, kLong), Interrupted);
  CHECK(TreeTurn(t.folder, kOtherKey, kLong).IsOurs());
}

TEST_CASE("without a lock file everybody builds, and says why", "[accel][tree-turn]") {
  const Turns t;
  std::filesystem::create_directory(t.temporary.File("locks"));
  const TreeTurn turn(t.folder, kKey, kLong);
  CHECK_FALSE(turn.IsOurs());
  CHECK_FALSE(turn.Waited());
  CHECK_THAT(turn.problem(), Contains("/locks: cannot open: Is a directory") &&
                                 Contains("build the same trees"));
}

}  // namespace lanelight
