// Completion for zsh: lists of flags and words for its function _arguments.
#include <fmt/format.h>

#include "src/cli/completion.h"

namespace lanelight {
namespace {

using Kind = CompletionValue::Kind;

// The script is a function to be autoloaded, or a file to be sourced.
constexpr const char* kZshOpening = R"(#compdef {0}
# zsh completion for {0}; written by `{0} completion zsh`

_{0}() {{
  local curcontext="$curcontext" context state state_descr line
  local -a commands
  typeset -A opt_args
  commands=(
{1}  )
  _arguments -C \
{2}    '1:command:->command' \
    '*::argument:->argument'
  case $state in
    command) _describe -t commands command commands ;;
    argument)
      case $words[1] in
)";

constexpr const char* kEnding = R"(      esac
      ;;
  esac
}}

if [[ $funcstack[1] == _{0} ]]; then
  _{0} "$@"
else
  compdef _{0} {0}
fi
)";

// With a backslash in front of each of `special`.
std::string Escaped(const std::string& text, const char* special) {
  std::string escaped;
  for (char c : text) {
    if (std::string(special).find(c) != std::string::npos) escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string Action(const CompletionValue& value) {
  switch (value.kind) {
    case Kind::kFile:
      return value.extension.empty() ? "_files"
                                     : fmt::format("_files -g \"*{}\"", value.extension);
    case Kind::kFolder:
      return "_files -/";
    case Kind::kChoices:
      return fmt::format("({})", fmt::join(value.choices, " "));
    default:
      return " ";
  }
}

std::string ValueSpec(const CompletionValue& value) {
  if (value.kind == Kind::kNone) return "";
  return (value.optional ? "::" : ":") + Escaped(value.name, ":\\") + ":" + Action(value);
}

// '(--help -h)--help[Print this]': given once, --help excludes its other names as well.
std::string FlagSpecs(const CompletionFlag& flag, const std::string& indent) {
  std::string text;
  for (const std::string& name : flag.names) {
    const bool is_long = name.rfind("--", 0) == 0;
    const std::string ahead =
        flag.repeats ? "*" : fmt::format("({})", fmt::join(flag.names, " "));
    const char* equals = flag.value.kind != Kind::kNone && is_long ? "=" : "";
    text += indent +
            ShellQuoted(ahead + name + equals + "[" + Escaped(flag.meaning, "[]:\\") +
                        "]" + ValueSpec(flag.value)) +
            " \\\n";
  }
  return text;
}

std::string CommandCase(const CompletionCommand& command) {
  const std::string indent(12, ' ');
  std::string text =
      fmt::format("        {})\n          _arguments -s \\\n", command.name);
  for (const CompletionFlag& flag : command.flags) text += FlagSpecs(flag, indent);
  for (std::size_t i = 0; i < command.words.size(); ++i) {
    const bool many = i + 1 == command.words.size() && command.last_repeats;
    text +=
        indent +
        ShellQuoted((many ? "*" : std::to_string(i + 1)) + ValueSpec(command.words[i])) +
        " \\\n";
  }
  // The last line goes on no further.
  return text.substr(0, text.size() - 3) + "\n          ;;\n";
}

}  // namespace

std::string ZshCompletion(const CompletionProgram& program) {
  std::string commands, flags, cases;
  for (const CompletionCommand& command : program.commands) {
    commands +=
        "    " + ShellQuoted(command.name + ":" + Escaped(command.meaning, ":\\")) + "\n";
    cases += CommandCase(command);
  }
  for (const CompletionFlag& flag : program.flags) flags += FlagSpecs(flag, "    ");
  return fmt::format(kZshOpening, program.name, commands, flags) + cases +
         fmt::format(kEnding, program.name);
}

}  // namespace lanelight
