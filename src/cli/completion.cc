#include "src/cli/completion.h"

#include <algorithm>
#include <sstream>

namespace lanelight {
namespace {

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

// Lines for those that go on as `typed` does.
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
