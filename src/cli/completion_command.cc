// `lanelight completion SHELL`: prints what makes a shell complete the command line.
#include <memory>

#include "src/cli/commands.h"
#include "src/cli/completion.h"
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

}  // namespace

std::string CompletionScript(const std::string& shell) {
  return shell == "bash" ? kBash : shell == "zsh" ? kZsh : kFish;
}

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
  command->callback([shell, &chosen] {
    chosen = [shell] {
      Print(CompletionScript(*shell));
      return kExitGood;
    };
  });
}

}  // namespace lanelight
