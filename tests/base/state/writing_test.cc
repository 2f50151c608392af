// There is a whole state at any time, also when it cannot be written.
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "src/base/core/error.h"
#include "src/base/core/input_file.h"
#include "tests/base/image/file_size_limit.h"
#include "tests/base/image/temporary_folder.h"
#include "tests/base/state/random_film.h"

namespace lanelight {
namespace {

using Catch::Contains;

StateCopy State(unsigned seed) {
  const RandomFilm film = RandomFilm::Make({0, 0, 33, 31}, seed);
  return StateCopy(film.Content({film.window}));
}

std::string BytesOfState(unsigned seed) {
  const RandomFilm film = RandomFilm::Make({0, 0, 33, 31}, seed);
  return StateBytes(film.Content({film.window}));
}

// While this lives, permissions hold for root too; `folder` becomes that user's.
class WithoutPrivileges {
 public:
  explicit WithoutPrivileges(const std::string& folder) {
    if (root_)
      REQUIRE((chown(folder.c_str(), kUnprivilegedUser, kUnprivilegedUser) == 0 &&
               seteuid(kUnprivilegedUser) == 0));
  }
  ~WithoutPrivileges() {
    if (root_) CHECK(seteuid(0) == 0);
  }
  WithoutPrivileges(const WithoutPrivileges&) = delete;
  WithoutPrivileges& operator=(const WithoutPrivileges&) = delete;

 private:
  static constexpr uid_t kUnprivilegedUser = 65534;
  const bool root_ = geteuid() == 0;
};

}  // namespace

TEST_CASE("a full disk keeps the old state and leaves no other file", "[state]") {
  const TemporaryFolder folder;
  const std::string path = folder.File("state");
  const std::string first = BytesOfState(1), second = BytesOfState(2);
  State(1).Write(path);
  const rlim_t size = second.size();
  for (rlim_t room : {rlim_t{0}, rlim_t{1}, rlim_t{511}, rlim_t{512}, rlim_t{4096},
                      size / 2, size - 4097, size - 1}) {
    INFO(room);
    const std::string error = [&] {
      const FileSizeLimit limit(room);
      try {
        State(2).Write(path);
      } catch (const InputError& e) {
        return std::string(e.what());
      }
      return std::string("written");
    }();
    CHECK_THAT(error, Contains(path) && Contains("File too large"));
    CHECK(ReadWholeFile(path) == first);
    CHECK(folder.Count() == 1);
  }
  const FileSizeLimit enough(size);
  State(2).Write(path);
  CHECK(ReadWholeFile(path) == second);
}

TEST_CASE("paths that cannot be written are input errors with the reason", "[state]") {
  const TemporaryFolder folder;
  const StateCopy state = State(1);
  CHECK_THROWS_WITH(state.Write(folder.File("gone/state")),
                    Contains("gone/state") && Contains("No such file or directory"));
  std::filesystem::create_directory(folder.File("directory"));
  CHECK_THROWS_WITH(state.Write(folder.File("directory")), Contains("directory"));
  CHECK_THROWS_WITH(state.Write("/dev/full"), Contains("No space left on device"));
  CHECK(folder.Count() == 1);
}

TEST_CASE("a folder needs write permission but no read permission", "[state]") {
  const TemporaryFolder folder;
  const std::string inner = folder.File("inner"), path = inner + "/state";
  std::filesystem::create_directory(inner);
  const StateCopy state = State(1);
  std::string refused;
  {
    const WithoutPrivileges user(inner);
    std::filesystem::permissions(inner, std::filesystem::perms(0500));
    try {
      state.Write(path);
    } catch (const InputError& error) {
      refused = error.what();
    }
    std::filesystem::permissions(inner, std::filesystem::perms(0300));
    CHECK_NOTHROW(state.Write(path));
    std::filesystem::permissions(inner, std::filesystem::perms(0700));
  }
  CHECK_THAT(refused, Contains(path) && Contains("Permission denied"));
  CHECK(ReadWholeFile(path) == BytesOfState(1));
}

TEST_CASE("two processes may write a path that a third reads", "[state]") {
  const TemporaryFolder folder;
  const std::string path = folder.File("state");
  const StateCopy states[] = {State(1), State(2)};
  states[0].Write(path);
  pid_t writers[2];
  for (int i = 0; i < 2; ++i) {
    writers[i] = fork();
    if (writers[i] != 0) continue;
    try {
      for (int k = 0; k < 50; ++k) states[i].Write(path);
    } catch (...) {
      _exit(1);
    }
    _exit(0);
  }
  int running = 2, failed = 0, reads = 0;
  while (running > 0) {
    const StateFile file(path);  // whole at any time
    ++reads;
    int status = 0;
    if (waitpid(-1, &status, WNOHANG) > 0) {
      --running;
      failed += status != 0;
    }
  }
  CHECK(failed == 0);
  CHECK(reads > 2);
  CHECK(folder.Count() == 1);
}

}  // namespace lanelight
