// Completion for fish: one line for each flag and word.
#include <fmt/format.h>

#include "src/cli/completion.h"

namespace lanelight {
namespace {

using Kind = CompletionValue::Kind;

// What says of a value whether it is a file, and which words it can be.
std::string ValueArguments(const CompletionValue& value) {
  switch (value.kind) {
    case Kind::kNone:
      return "";
    case Kind::kFile:
      return value.extension.empty()
                 ? " -F"
                 : fmt::format(" -k -a '(__fish_complete_suffix {})'", value.extension);
    case Kind::kFolder:
      return " -a '(__fish_complete_directories)'";
    case Kind::kChoices:
      return " -a " + ShellQuoted(fmt::format("{}", fmt::join(value.choices, " ")));
    case Kind::kOther:
      break;
  }
  return "";
}

// `start`: the command with the condition under which the line counts.
std::string FlagLine(const std::string& start, const CompletionFlag& flag) {
  std::string text = start;
  for (const std::string& name : flag.names) {
    const bool is_long = name.rfind("--", 0) == 0;
    text += is_long ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  // A value that must follow: a file (-r), or never one (-x).
  if (flag.value.kind != Kind::kNone && !flag.value.optional) {
    text += flag.value.kind == Kind::kFile ? " -r" : " -x";
  }
  return text + ValueArguments(flag.value) + " -d " + ShellQuoted(flag.meaning) + "\n";
}

}  // namespace

std::string FishCompletion(const CompletionProgram& program) {
  const std::string start = "complete -c " + program.name;
  std::string text = fmt::format(
      "# fish completion for {0}; written by `{0} completion fish`\n"
      "{1} -f\n",
      program.name, start);
  const std::string first = start + " -n __fish_use_subcommand";
  for (const CompletionFlag& flag : program.flags) text += FlagLine(first, flag);
  for (const CompletionCommand& command : program.commands) {
    text += first + " -a " + command.name + " -d " + ShellQuoted(command.meaning) + "\n";
  }
  for (const CompletionCommand& command : program.commands) {
    const std::string inside =
        fmt::format("{} -n '__fish_seen_subcommand_from {}'", start, command.name);
    text += "\n";
    for (const CompletionFlag& flag : command.flags) text += FlagLine(inside, flag);
    if (!command.words.empty()) {
      text += inside + ValueArguments(command.words.front()) + "\n";
    }
  }
  return text;
}

}  // namespace lanelight
