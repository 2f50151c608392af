#include "src/cli/console.h"

#include <sys/ioctl.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <iostream>
#include <string_view>

#include "src/base/core/text_layout.h"
#include "src/base/core/value_types.h"

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

constexpr std::size_t kDefaultColumns = 80, kMinColumns = 20;

int DescriptorOf(Stream stream) {
  return stream == Stream::kOutput ? STDOUT_FILENO : STDERR_FILENO;
}

std::string_view VariableOf(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

const char* CodeOf(TextStyle ink) {
  switch (ink) {
    case TextStyle::kBold:
      return "\x1b[1m";
    case TextStyle::kDim:
      return "\x1b[2m";
    case TextStyle::kRed:
      return "\x1b[31m";
    case TextStyle::kYellow:
      return "\x1b[33m";
  }
  return "";
}

// Paints the word of kind ("error:", "warning:", "note:") of a message.
std::string PaintedMessage(const std::string& line) {
  struct Kind {
    const char* word;
    TextStyle ink;
  };
  for (const Kind& kind :
       {Kind{"error:", TextStyle::kRed}, Kind{"warning:", TextStyle::kYellow},
        Kind{"note:", TextStyle::kDim}}) {
    const std::size_t at = line.find(kind.word);
    // Behind a place, "scene.pbrt:3:1: ", and not in the middle of a sentence.
    if (at == line.npos || (at > 0 && !line.substr(0, at).ends_with(": "))) continue;
    const std::string word = kind.word;
    return line.substr(0, at) + Painted(kind.ink, word, Stream::kError) +
           line.substr(at + word.size());
  }
  return line;
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

std::size_t TerminalColumns(Stream stream) {
  std::size_t columns = ParseNumber<std::size_t>(VariableOf("COLUMNS")).value_or(0);
  winsize size = {};
  if (columns == 0 && ioctl(DescriptorOf(stream), TIOCGWINSZ, &size) == 0) {
    columns = size.ws_col;
  }
  return std::max(columns > 0 ? columns : kDefaultColumns, kMinColumns);
}

bool IsTerminal(Stream stream) {
  return isatty(DescriptorOf(stream)) != 0 && VariableOf("TERM") != "dumb";
}

std::string Painted(TextStyle ink, const std::string& text, Stream stream) {
  if (!IsTerminal(stream) || !VariableOf("NO_COLOR").empty()) return text;
  return CodeOf(ink) + text + "\x1b[0m";
}

std::string SummaryRow(const std::string& label, const std::string& text) {
  std::string row = LabelledRow(label, text, TerminalColumns(Stream::kOutput));
  return Painted(TextStyle::kDim, label, Stream::kOutput) + row.substr(label.size());
}

std::size_t ReadersColumns() {
  const bool piped = isatty(STDOUT_FILENO) == 0 && VariableOf("COLUMNS").empty();
  return piped ? std::string::npos : TerminalColumns(Stream::kOutput);
}

std::string FactRow(const std::string& label, const std::string& text,
                    std::size_t label_columns) {
  return LabelledRow(label, text, ReadersColumns(), label_columns);
}

}  // namespace lanelight
