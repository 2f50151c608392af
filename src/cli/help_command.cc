// `lanelight help COMMAND`: the text of `lanelight COMMAND --help`.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <sstream>

#include "src/base/core/suggest.h"
#include "src/base/core/text_layout.h"
#include "src/cli/commands.h"
#include "src/cli/console.h"
#include "src/cli/exit_codes.h"

namespace lanelight {
namespace {

std::vector<std::string> CommandNames(const CLI::App& root) {
  std::vector<std::string> names;
  for (const CLI::App* command : root.get_subcommands(nullptr)) {
    names.push_back(command->get_name());
  }
  return names;
}

// (CLI11's App::help() of a program whose command line names a command is that of the
// command, so here always that of `help`.)
void PrintHelp(const CLI::App& root, const std::string& name) {
  if (!name.empty()) {
    Print(root.get_subcommand(name)->help(root.get_name()));
    return;
  }
  const auto formatter = root.get_formatter();
  Print(formatter->make_help(&root, root.get_name(), CLI::AppFormatMode::Normal));
}

class FittedFormatter : public CLI::Formatter {
 public:
  std::string make_option_desc(const CLI::Option* option) const override {
    return Fitted(CLI::Formatter::make_option_desc(option));
  }
  std::string make_subcommand(const CLI::App* command) const override {
    std::ostringstream row;
    CLI::detail::format_help(row, command->get_name(), Fitted(command->get_description()),
                             get_column_width());
    return row.str();
  }

 private:
  // Beside the names of flags; what there is no room for is broken by the terminal.
  std::string Fitted(const std::string& text) const {
    constexpr std::size_t kMinTextColumns = 20;
    const std::size_t columns = ReadersColumns(), names = get_column_width();
    return Wrapped(text, std::max(columns, names + kMinTextColumns) - names);
  }
};

}  // namespace

std::shared_ptr<CLI::FormatterBase> FittedHelp() {
  return std::make_shared<FittedFormatter>();
}

bool CheckCommand(const CLI::App& root, const std::string& word) {
  const std::vector<std::string> names = CommandNames(root);
  if (std::ranges::find(names, word) != names.end()) return true;
  const std::string nearest = NearestName(word, names);
  PrintError(fmt::format("error: unknown command '{}'; commands are {}{}", word,
                         fmt::join(names, ", "),
                         nearest.empty() ? "" : "; did you mean '" + nearest + "'?"));
  return false;
}

void AddHelpCommand(CLI::App& root) {
  CLI::App* command =
      root.add_subcommand("help", "Print what a command does, and its flags");
  auto name = std::make_shared<std::string>();
  command->add_option("COMMAND", *name, "Which command; default: a list of them")
      ->type_name(fmt::format("{}", fmt::join(CommandNames(root), "|")));
  command->footer("\nExample:\n  lanelight help render");
  // While the command line is read, as --help: also where nothing could be rendered.
  command->callback([name, &root] {
    if (!name->empty() && !CheckCommand(root, *name)) {
      throw CLI::RuntimeError(kExitUsage);
    }
    PrintHelp(root, *name);
    throw CLI::Success();
  });
}

}  // namespace lanelight
