// Completion for bash 4 and newer; it needs nothing of the package bash-completion.
#include <fmt/format.h>

#include "src/cli/completion.h"

namespace lanelight {
namespace {

using Kind = CompletionValue::Kind;

// `cur` is the word under the cursor, `prev` the one before it. Bash takes "--flag=value"
// apart at the "=", so that is looked through.
constexpr const char* kBashOpening =
    R"(# bash completion for {0}; written by `{0} completion bash`

# Words of the first argument that go on as `cur` does.
_{0}_words() {{
  mapfile -t COMPREPLY < <(compgen -W "$1" -- "$cur")
}}

# Files that end in $1, and folders on the way to them.
_{0}_files() {{
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(
    [[ -z $1 ]] || compgen -d -- "$cur"
    compgen -f ${{1:+-X "!*$1"}} -- "$cur")
}}

_{0}_folders() {{
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -d -- "$cur")
}}

_{0}() {{
  local cur=${{COMP_WORDS[COMP_CWORD]}} prev=${{COMP_WORDS[COMP_CWORD - 1]}}
  if [[ $cur == = ]]; then
    cur=
  elif [[ $prev == = && $COMP_CWORD -gt 1 ]]; then
    prev=${{COMP_WORDS[COMP_CWORD - 2]}}
  fi
  COMPREPLY=()
  if [[ $COMP_CWORD -eq 1 ]]; then
    _{0}_words {1}
    return
  fi
  case ${{COMP_WORDS[1]}} in
)";

std::string Joined(const std::vector<std::string>& words, const char* separator) {
  return fmt::format("{}", fmt::join(words, separator));
}

std::string FlagNames(const std::vector<CompletionFlag>& flags) {
  std::string names;
  for (const CompletionFlag& flag : flags) {
    names += (names.empty() ? "" : " ") + Joined(flag.names, " ");
  }
  return names;
}

// The command that completes such a value.
std::string Action(const std::string& program, const CompletionValue& value) {
  switch (value.kind) {
    case Kind::kFile:
      return fmt::format("_{}_files {}", program, ShellQuoted(value.extension));
    case Kind::kFolder:
      return fmt::format("_{}_folders", program);
    case Kind::kChoices:
      return fmt::format("_{}_words {}", program,
                         ShellQuoted(Joined(value.choices, " ")));
    default:
      return ":";
  }
}

// After a flag with a value stands the value; one that may be left out can be another
// flag as well.
std::string FlagCase(const std::string& program, const CompletionFlag& flag) {
  const std::string names = Joined(flag.names, " | ");
  const std::string action = Action(program, flag.value);
  if (flag.value.optional) {
    return fmt::format("        {}) [[ $cur == -* ]] || {{ {}; return; }} ;;\n", names,
                       action);
  }
  return fmt::format("        {}) {}; return ;;\n", names, action);
}

// All of a command's flags with values; those that cannot be completed in one line.
std::string FlagCases(const std::string& program, const CompletionCommand& command) {
  std::string cases, others;
  for (const CompletionFlag& flag : command.flags) {
    if (flag.value.kind == Kind::kNone) continue;
    if (flag.value.kind == Kind::kOther) {
      others += (others.empty() ? "" : " | ") + Joined(flag.names, " | ");
    } else {
      cases += FlagCase(program, flag);
    }
  }
  if (!others.empty()) cases += "        " + others + ") return ;;\n";
  return cases.empty() ? "" : "      case $prev in\n" + cases + "      esac\n";
}

std::string CommandCase(const std::string& program, const CompletionCommand& command) {
  const std::string start =
      fmt::format("    {})\n", command.name) + FlagCases(program, command);
  // Which of several words it is does not matter: those of one command are of one kind.
  const std::string word =
      command.words.empty() ? ":" : Action(program, command.words.front());
  return start + fmt::format(
                     "      if [[ $cur == -* ]]; then\n"
                     "        _{}_words {}\n"
                     "      else\n"
                     "        {}\n"
                     "      fi\n"
                     "      ;;\n",
                     program, ShellQuoted(FlagNames(command.flags)), word);
}

}  // namespace

std::string BashCompletion(const CompletionProgram& program) {
  std::string first;
  for (const CompletionCommand& command : program.commands) first += command.name + " ";
  first += FlagNames(program.flags);
  std::string text = fmt::format(kBashOpening, program.name, ShellQuoted(first));
  for (const CompletionCommand& command : program.commands) {
    text += CommandCase(program.name, command);
  }
  return text + fmt::format("  esac\n}}\n\ncomplete -F _{0} {0}\n", program.name);
}

}  // namespace lanelight
