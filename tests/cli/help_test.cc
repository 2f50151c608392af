// `lanelight help`, and what help texts must say: every flag what happens without it.
#include <catch2/catch.hpp>

#include <regex>
#include <sstream>

#include "src/base/core/text_layout.h"
#include "src/cli/exit_codes.h"
#include "tests/cli/process.h"

namespace lanelight {
namespace {

using Catch::Contains;

constexpr std::size_t kTextColumn = 30;  // of CLI11

struct HelpEntry {
  std::string head;  // "--every SECONDS"
  std::string text;
};

// Positionals and options of a help text. What is too long for its column has its
// text in the line below.
std::vector<HelpEntry> EntriesOf(const std::string& help) {
  std::vector<HelpEntry> entries;
  std::istringstream lines(help);
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line == "Positionals:" || line == "Options:") {
      inside = true;
    } else if (line.empty()) {
      inside = false;
    } else if (inside && line.rfind(std::string(kTextColumn, ' '), 0) == 0) {
      entries.back().text += line.substr(kTextColumn);
    } else if (inside) {
      const bool whole = line.size() > kTextColumn && line[kTextColumn - 1] == ' ' &&
                         line[kTextColumn - 2] == ' ';
      entries.push_back({line.substr(2, whole ? kTextColumn - 2 : line.npos),
                         whole ? line.substr(kTextColumn) : ""});
      std::string& head = entries.back().head;
      head.erase(head.find_last_not_of(' ') + 1);
    }
  }
  return entries;
}

// "--aov" and "--all Excludes: --strategies" take none.
bool TakesValue(const std::string& head) {
  static const std::regex flag("-[^ ]+( (Needs|Excludes):.*)?");
  return !std::regex_match(head, flag);
}

// A text that begins with what the flag does, which is not done without it.
bool SaysWhatItDoes(const std::string& text) {
  static const std::regex verb(
      "(Write|Also write|Save|Resume|Stop|Render|Run|Exit|Compare)\\b.*");
  return std::regex_match(text, verb);
}

/// The entries that take a value, may be left out, and do not say what happens then.
std::string WithoutDefault(const std::string& help) {
  static const std::regex said(".*(\\bdefault: ).*");
  std::string missing;
  for (const HelpEntry& entry : EntriesOf(help)) {
    if (!TakesValue(entry.head) || Contains("REQUIRED").match(entry.head)) continue;
    // A head that fills its column is not told from one that is too long for it.
    if (std::regex_match(entry.head + entry.text, said)) continue;
    if (SaysWhatItDoes(entry.text)) continue;
    missing += entry.head + ": " + entry.text + "\n";
  }
  return missing;
}

std::vector<std::string> Commands() {
  std::vector<std::string> names;
  const std::string help = RunLanelight({"help"}).out;
  std::istringstream lines(help.substr(help.find("Subcommands:")));
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line) && !line.empty()) {
    names.push_back(line.substr(2, line.find(' ', 2) - 2));
  }
  return names;
}

}  // namespace

TEST_CASE("help prints what --help does", "[cli]") {
  const ProcessResult all = RunLanelight({"help"});
  CHECK(all.exit_code == kExitGood);
  CHECK(all.err.empty());
  CHECK(all.out == RunLanelight({"--help"}).out);
  const std::vector<std::string> commands = Commands();
  CHECK(commands.size() >= 13);
  for (const std::string& command : commands) {
    INFO(command);
    const ProcessResult help = RunLanelight({"help", command});
    CHECK(help.exit_code == kExitGood);
    CHECK(help.err.empty());
    CHECK(help.out == RunLanelight({command, "--help"}).out);
    CHECK_THAT(help.out, Contains("Usage: lanelight " + command));
  }
  ProcessOptions full;
  full.stdout_path = "/dev/full";
  CHECK(RunLanelight({"help", "render"}, full).exit_code == kExitBadInput);
}

TEST_CASE("help fits the terminal", "[cli]") {
  ProcessOptions narrow;
  narrow.columns = "80";
  for (const std::string& command : Commands()) {
    std::istringstream help(RunLanelight({"help", command}, narrow).out);
    for (std::string line; std::getline(help, line);) {
      // Words above and below the flags have lines of their own.
      if (line.rfind("  -", 0) != 0 && line.rfind(std::string(kTextColumn, ' '), 0) != 0)
        continue;
      INFO(command << ": " << line);
      CHECK(TextWidth(line) <= 80);
    }
  }
}

TEST_CASE("unknown arguments are reported in order", "[cli]") {
  const ProcessResult r = RunLanelight({"render", "a.pbrt", "--sp", "3"});
  CHECK(r.exit_code == kExitUsage);
  CHECK_THAT(r.err, Contains("not expected: --sp 3\n") && Contains("mean --spp?"));
}

TEST_CASE("help for an unknown command lists all commands", "[cli]") {
  const ProcessResult unknown = RunLanelight({"help", "rendr"});
  CHECK(unknown.exit_code == kExitUsage);
  CHECK(unknown.out.empty());
  CHECK(unknown.err ==
        "error: unknown command 'rendr'; commands are render, plan, "
        "live, profile, bench, info, strategies, merge, compare, study, sweep, plot, "
        "stress, completion, help; did you mean 'render'?\n");
  CHECK(RunLanelight({"help", "render", "merge"}).exit_code == kExitUsage);
}

TEST_CASE("every flag with a value documents its default", "[cli]") {
  std::size_t entries = 0;
  for (const std::string& command : Commands()) {
    INFO(command);
    const std::string help = RunLanelight({"help", command}).out;
    CHECK(WithoutDefault(help) == "");
    entries += EntriesOf(help).size();
  }
  CHECK(entries > 180);
}

TEST_CASE("a flag without a documented default is detected", "[cli]") {
  const std::string help =
      "Usage: x\n\nPositionals:\n  SCENE REQUIRED              Scene\n"
      "  CASE TEXT ...               Cases\n\nOptions:\n"
      "  -h,--help                   Print this\n"
      "  --spp N                     Samples; default: 16\n"
      "  --seed S                    Seed of the random numbers\n"
      "  --pilots N Needs: --dry-run\n"
      "                              Most short renders\n"
      "  --all Excludes: --list      Every choice\n"
      "  --json [FILE]               Write a report\n"
      "  --writer NAME               Writer of the report\n"
      "  -o,--output FILE REQUIRED   The picture\n\n  --not N   an example\n";
  CHECK(EntriesOf(help).size() == 10);
  CHECK(WithoutDefault(help) ==
        "CASE TEXT ...: Cases\n"
        "--seed S: Seed of the random numbers\n"
        "--pilots N Needs: --dry-run: Most short renders\n"
        "--writer NAME: Writer of the report\n");
}

}  // namespace lanelight
