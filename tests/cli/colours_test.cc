// The program on a terminal: colours, the line that is redrawn, and who does not want
// them.
#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <thread>

#include "src/cli/exit_codes.h"
#include "tests/cli/process.h"

namespace lanelight {
namespace {

using Catch::Contains;

// Renders with this variable set and both streams at a terminal of 60 columns; returns
// what it has shown.
std::string OnTerminal(const char* variable, const char* value) {
  const int master = posix_openpt(O_RDWR | O_NOCTTY);
  REQUIRE(master >= 0);
  REQUIRE((grantpt(master) == 0 && unlockpt(master) == 0));
  const std::string name = ptsname(master);
  const int terminal = open(name.c_str(), O_RDWR | O_NOCTTY);
  const winsize size = {24, 60, 0, 0};
  ioctl(terminal, TIOCSWINSZ, &size);
  std::string shown;
  std::thread reader([&] {
    char buffer[4096];
    // Fails once no process has the terminal open.
    for (ssize_t n; (n = read(master, buffer, sizeof(buffer))) > 0;) {
      shown.append(buffer, static_cast<std::size_t>(n));
    }
  });
  TempDirectory directory;
  ProcessOptions options;
  options.prepare = [&] {
    dup2(terminal, STDOUT_FILENO);
    dup2(terminal, STDERR_FILENO);
    close(terminal);
    close(master);
    unsetenv("COLUMNS");
    unsetenv("NO_COLOR");
    setenv("TERM", "xterm", 1);
    setenv(variable, value, 1);
  };
  const ProcessResult r = RunLanelight(
      {"render", WriteSphereScene(directory), "-o", directory / "a.exr", "--spp", "2k"},
      options);
  close(terminal);
  reader.join();
  close(master);
  INFO(shown);
  CHECK(r.exit_code == kExitGood);
  CHECK_THAT(shown, Contains("32x24 pixels"));
  return shown;
}

}  // namespace

TEST_CASE("a terminal gets colours and one line that is redrawn", "[cli]") {
  const std::string shown = OnTerminal("TERM", "xterm");
  CHECK_THAT(shown, Contains("\x1b[1m") && Contains("\x1b[2mimage\x1b[0m"));
  CHECK_THAT(shown, Contains("\r\x1b[K"));
  CHECK_THAT(shown, !Contains("rendering "));
  // The error so far: this image is small, so it is soon told.
  CHECK_THAT(shown, Contains("error ") && Contains("samples/s"));
}

TEST_CASE("NO_COLOR is respected, and a dumb terminal gets plain lines", "[cli]") {
  const std::string plain = OnTerminal("NO_COLOR", "1");
  CHECK_THAT(plain, !Contains("\x1b[1m") && !Contains("\x1b[2m") && Contains("\x1b[K"));
  const std::string dumb = OnTerminal("TERM", "dumb");
  CHECK(dumb.find('\x1b') == std::string::npos);
  CHECK_THAT(OnTerminal("NO_COLOR", ""), Contains("\x1b[1m"));
}

}  // namespace lanelight
