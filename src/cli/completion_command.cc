// `lanelight completion SHELL`: prints what makes a shell complete the command line.

#include <algorithm>
#include <memory>
#include <sstream>

#include "src/cli/commands.h"
#include "src/cli/console.h"
#include "src/cli/exit_codes.h"

namespace lanelight {
namespace {

constexpr const char* kBash =
    R"(# bash completion for lanelight; written by `lanelight completion bash`
_lanelight() {
  local cur=${COMP_WORDS[COMP_CWORD]} kind
  mapfile -t COMPREPLY < <("${COMP_WORDS[0]}" __complete \
    "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null)
  COMPREPLY=("${COMPREPLY[@]%%$'\t'*}") kind=${COMPREPLY[0]-}
  [[ $kind == :* ]] || return 0
  [[ $cur != = ]] || cur=
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(
    [[ $kind == :files ]] || compgen -d -- "$cur"
    [[ $kind == :folders ]] || compgen -f -X "!*${kind#:files}" -- "$cur")
}
complete -F _lanelight lanelight
)";

// A function to be autoloaded, or a file to be sourced.
constexpr const char* kZsh = R"(#compdef lanelight
# zsh completion for lanelight; written by `lanelight completion zsh`
_lanelight() {
  local -a lines
  lines=("${(@f)$("${(Q)words[1]}" __complete "${(@Q)words[2,CURRENT-1]}" \
    "${(Q)PREFIX}" 2>/dev/null)}")
  case $lines[1] in
    :*) compset -P '--*=' ;|
    :folders) _files -/ ;;
    :files*) _files -g "*${lines[1]#:files}" ;;
    ?*)
      lines=("${(@)lines//:/\\:}")
      lines=("${(@)lines/$'\t'/:}")
      _describe value lines
      ;;
  esac
}
if [[ $funcstack[1] == _lanelight ]]; then
  _lanelight "$@"
else
  compdef _lanelight lanelight
fi
)";

constexpr const char* kFish =
    R"(# fish completion for lanelight; written by `lanelight completion fish`
function __lanelight_complete
  set -l words (commandline -opc)
  set -l program $words[1]
  set -e words[1]
  set -l typed (commandline -ct)
  set -l lines ($program __complete $words "$typed" 2>/dev/null)
  switch "$lines[1]"
    case ':files'
      __fish_complete_path "$typed"
    case ':files*'
      __fish_complete_suffix (string replace ':files' '' -- $lines[1])
    case ':folders'
      __fish_complete_directories
    case '*'
      printf '%s\n' $lines
  end
end
complete -c lanelight -f -k -a '(__lanelight_complete)'
)";

// A word that may stand there, and what it means.
struct Candidate {
  std::string word, meaning;
};

std::vector<std::string> NamesOf(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

// Flags that are not there already, or may be there several times.
std::vector<Candidate> Flags(const CLI::App& command,
                             const std::vector<std::string>& words) {
  std::vector<Candidate> flags;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_positional()) continue;
    const std::vector<std::string> names = NamesOf(*option);
    const bool there = std::find_first_of(words.begin(), words.end(), names.begin(),
                                          names.end()) != words.end();
    if (there && option->get_expected_max() <= 1) continue;
    for (const std::string& name : names) {
      flags.push_back({name, option->get_description()});
    }
  }
  return flags;
}

std::vector<Candidate> Commands(const CLI::App& root) {
  std::vector<Candidate> commands;
  for (const CLI::App* command : root.get_subcommands(nullptr)) {
    commands.push_back({command->get_name(), command->get_description()});
  }
  return commands;
}

// Returns the lines of candidates that begin with `typed`.
std::string Lines(const std::vector<Candidate>& candidates, const std::string& typed,
                  const std::string& before = "") {
  std::string text;
  for (const auto& [word, meaning] : candidates) {
    if (!word.starts_with(typed)) continue;
    text += before + word + "\t" + meaning + "\n";
  }
  return text;
}

// The type names say what a value is: FILE, DIR, half|float; in brackets if the flag may
// stand alone. A positional without one is named like its type, or is a file.
std::string Values(const CLI::Option& option, const std::string& typed,
                   const std::string& before = "") {
  std::string type = option.get_type_name();
  if (type.starts_with('[') && type.ends_with(']'))
    type = type.substr(1, type.size() - 2);
  const std::string name = option.get_positional() ? option.get_name(true) : type;
  if (type == "DIR") return ":folders\n";
  if (type == "FILE" || (option.get_positional() && type.empty())) {
    return name == "SCENE"   ? ":files.pbrt\n"
           : name == "SWEEP" ? ":files.toml\n"
                             : ":files\n";
  }
  if (type.find('|') == type.npos) return "";
  std::vector<Candidate> choices;
  std::istringstream list(type);
  for (std::string choice; std::getline(list, choice, '|');)
    choices.push_back({choice, ""});
  return Lines(choices, typed, before);
}

}  // namespace

void AddCompletionCommand(CLI::App& root, Command& chosen) {
  CLI::App* command = root.add_subcommand(
      "completion", "Print the completion script for bash, zsh or fish");
  auto shell = std::make_shared<std::string>();
  AddOption(*command, "SHELL bash|zsh|fish", *shell, "Which shell")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}).description(""));
  command->footer(
      "\nExamples:\n"
      "  source <(lanelight completion bash)     # also with zsh\n"
      "  lanelight completion fish | source");
  command->callback([shell, &chosen] {
    chosen = [shell] {
      Print(*shell == "bash" ? kBash : *shell == "zsh" ? kZsh : kFish);
      return kExitGood;
    };
  });
}

std::string Completions(const CLI::App& root, std::vector<std::string> words) {
  if (words.empty()) return "";
  // Bash takes "--flag=value" apart at the "=".
  if (words.back() == "=") words.emplace_back();
  std::erase(words, "=");
  const std::string typed = words.back();
  words.pop_back();
  if (words.empty()) return Lines(Commands(root), typed) + Lines(Flags(root, {}), typed);
  const auto commands = root.get_subcommands(
      [&](const CLI::App* app) { return app->get_name() == words.front(); });
  if (commands.empty()) return "";
  const CLI::App* command = commands.front();
  const auto flag_named = [&](const std::string& name) {
    const CLI::Option* option =
        name.starts_with('-') ? command->get_option_no_throw(name) : nullptr;
    return option != nullptr && option->get_items_expected_max() > 0 ? option : nullptr;
  };
  if (const CLI::Option* flag = flag_named(words.back())) {
    const bool may_stand_alone = flag->get_items_expected_min() == 0;
    if (!may_stand_alone || !typed.starts_with('-')) return Values(*flag, typed);
  }
  if (const std::size_t equals = typed.find('=');
      typed.starts_with("--") && equals != typed.npos) {
    const CLI::Option* flag = flag_named(typed.substr(0, equals));
    if (flag == nullptr) return "";
    return Values(*flag, typed.substr(equals + 1), typed.substr(0, equals + 1));
  }
  if (typed.starts_with('-')) return Lines(Flags(*command, words), typed);
  // Which of several words it is does not matter: those of one command are of one kind.
  for (const CLI::Option* option : command->get_options()) {
    if (option->get_positional()) return Values(*option, typed);
  }
  return "";
}

}  // namespace lanelight
