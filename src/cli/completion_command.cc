// `lanelight completion SHELL`: prints what makes a shell complete the command line.
#include <memory>

#include "src/cli/commands.h"
#include "src/cli/completion.h"
#include "src/cli/console.h"
#include "src/cli/exit_codes.h"

namespace lanelight {
namespace {

std::vector<std::string> Split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

// The type names are the description: FILE, DIR, SCENE, half|float; in brackets if the
// flag may stand alone. A positional without one is named like its type, or is a file.
CompletionValue ValueOf(const CLI::Option& option) {
  using Kind = CompletionValue::Kind;
  CompletionValue value;
  if (option.get_items_expected_max() == 0) return value;
  std::string type = option.get_type_name();
  if (type.size() > 2 && type.front() == '[' && type.back() == ']') {
    type = type.substr(1, type.size() - 2);
  }
  const bool alone = option.get_positional();
  value.optional = option.get_items_expected_min() == 0;
  value.name = alone ? option.get_name(true) : type;
  const bool file = type == "FILE" || (alone && type.empty());
  value.kind = file ? Kind::kFile : Kind::kOther;
  if (value.name == "SCENE") value.extension = ".pbrt";
  if (value.name == "SWEEP") value.extension = ".toml";
  if (type == "DIR") value.kind = Kind::kFolder;
  if (type.find('|') != std::string::npos) {
    value.kind = Kind::kChoices;
    value.choices = Split(type, '|');
  }
  return value;
}

bool Repeats(const CLI::Option& option) { return option.get_expected_max() > 1; }

CompletionFlag FlagOf(const CLI::Option& option) {
  CompletionFlag flag;
  for (const std::string& name : option.get_snames()) flag.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) flag.names.push_back("--" + name);
  flag.meaning = option.get_description();
  flag.value = ValueOf(option);
  flag.repeats = Repeats(option);
  return flag;
}

CompletionCommand CommandOf(const CLI::App& app) {
  CompletionCommand command;
  command.name = app.get_name();
  command.meaning = app.get_description();
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_positional()) {
      command.words.push_back(ValueOf(*option));
      command.last_repeats = Repeats(*option);
    } else {
      command.flags.push_back(FlagOf(*option));
    }
  }
  return command;
}

CompletionProgram ProgramOf(const CLI::App& root) {
  CompletionProgram program;
  program.name = root.get_name();
  program.flags = CommandOf(root).flags;
  for (const CLI::App* command : root.get_subcommands(nullptr)) {
    program.commands.push_back(CommandOf(*command));
  }
  return program;
}

}  // namespace

void AddCompletionCommand(CLI::App& root, Command& chosen) {
  CLI::App* command = root.add_subcommand(
      "completion", "Print what makes bash, zsh or fish complete this command line");
  auto shell = std::make_shared<std::string>();
  command->add_option("SHELL", *shell, "Which shell")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}).description(""))
      ->type_name("bash|zsh|fish");
  command->footer(
      "\nExamples:\n"
      "  source <(lanelight completion bash)     # also with zsh\n"
      "  lanelight completion fish | source");
  command->callback([shell, &root, &chosen] {
    chosen = [shell, &root] {
      const CompletionProgram program = ProgramOf(root);
      Print(*shell == "bash"  ? BashCompletion(program)
            : *shell == "zsh" ? ZshCompletion(program)
                              : FishCompletion(program));
      return kExitGood;
    };
  });
}

}  // namespace lanelight
