#include "src/cli/console.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <iostream>

#include "src/cli/terminal.h"

namespace lanelight {
namespace {

// The first reason for which a write failed; the stream itself does not keep it.
int failure = 0;
bool silent = false;

void NoteFailure() {
  if (!std::cout.good() && failure == 0) failure = errno ? errno : EIO;
}

// Messages quote what files say: control characters would reach the terminal.
std::string WithoutControls(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool control = (byte < 0x20 && c != '\n' && c != '\t') || byte == 0x7f;
    out += control ? fmt::format("\\x{:02x}", byte) : std::string(1, c);
  }
  return out;
}

}  // namespace

void SilenceConsole() { silent = true; }

void Print(const std::string& text) {
  if (silent) return;
  errno = 0;
  std::cout << text;
  NoteFailure();
}

void PrintError(const std::string& line) {
  if (silent) return;
  // Standard error flushes standard output first; a failure of that is not to be missed.
  errno = 0;
  std::cout.flush();
  NoteFailure();
  std::cerr << PaintedMessage(WithoutControls(line)) << '\n' << std::flush;
}

void PrintWarning(const std::string& error) {
  const std::string prefix = "error: ";
  PrintError("warning: " +
             (error.starts_with(prefix) ? error.substr(prefix.size()) : error));
}

bool FlushOutput() {
  errno = 0;
  std::cout.flush();
  NoteFailure();
  if (failure == 0 || failure == EPIPE) return true;
  PrintError(std::string("error: cannot write to standard output: ") +
             std::strerror(failure));
  return false;
}

}  // namespace lanelight
