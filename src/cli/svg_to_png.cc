#include "src/cli/svg_to_png.h"

#include <spawn.h>
#include <sys/wait.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "src/core/error.h"

extern char** environ;

namespace lanelight {
namespace {

constexpr char kConverter[] = "rsvg-convert";
constexpr int kNotFound = 127;  // what a child that cannot start exits with

using TemporaryFile = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

TemporaryFile MakeTemporary() {
  TemporaryFile file(std::tmpfile(), &std::fclose);
  if (!file) {
    throw InputError(fmt::format("no temporary file: {}", std::strerror(errno)));
  }
  return file;
}

// Returns the exit status, or kNotFound.
int Convert(std::FILE* in, std::FILE* out) {
  std::string arguments[] = {kConverter, "--format=png", "--zoom=2"};
  char* argv[] = {arguments[0].data(), arguments[1].data(), arguments[2].data(), nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, fileno(in), 0);
  posix_spawn_file_actions_adddup2(&actions, fileno(out), 1);
  pid_t child = 0;
  const int error = posix_spawnp(&child, kConverter, &actions, nullptr, argv, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) return kNotFound;
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

std::string SvgToPng(const std::string& svg) {
  const TemporaryFile in = MakeTemporary(), out = MakeTemporary();
  if (std::fwrite(svg.data(), 1, svg.size(), in.get()) != svg.size() ||
      std::fflush(in.get()) != 0) {
    throw InputError(fmt::format("no temporary file: {}", std::strerror(errno)));
  }
  std::rewind(in.get());
  const int status = Convert(in.get(), out.get());
  if (status == kNotFound) {
    throw InputError(
        fmt::format("a PNG needs the program '{}', which is not there; install "
                    "librsvg2-bin (Debian), "
                    "or write .svg",
                    kConverter));
  }
  if (status != 0) {
    throw InputError(fmt::format("'{}' failed with status {}", kConverter, status));
  }
  std::rewind(out.get());
  std::string png;
  char block[1 << 14];
  while (const std::size_t got = std::fread(block, 1, sizeof block, out.get())) {
    png.append(block, got);
  }
  if (png.compare(0, 4, "\x89PNG") != 0) {
    throw InputError(fmt::format("'{}' wrote no PNG", kConverter));
  }
  return png;
}

}  // namespace lanelight
