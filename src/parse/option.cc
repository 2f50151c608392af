// `Option "name" value` or `Option "type name" value`.
#include <algorithm>

#include "src/core/suggest.h"
#include "src/parse/directives.h"
#include "src/parse/format.h"

namespace lanelight {
namespace {

struct OptionStatement {
  std::string name;
  SourceLocation where;
  Token value;
  SourceLocation value_where;
};

[[noreturn]] void Misfit(const OptionStatement& option, std::string_view takes) {
  throw InputError(option.value_where,
                   fmt::format("found {} as the value of option {}; it takes {}",
                               option.value.Describe(), Quoted(option.name), takes));
}

// The options are those of the table of the format.
const std::vector<FormatLine>& Options() {
  static const std::vector<FormatLine> kOptions = [] {
    for (const FormatObject& object : PbrtFormat()) {
      if (object.directive == std::string_view("Option")) return object.lines;
    }
    return std::vector<FormatLine>();
  }();
  return kOptions;
}

const FormatLine& FindOption(const OptionStatement& option) {
  std::vector<std::string> names;
  for (const FormatLine& line : Options()) {
    const std::string_view parameter = line.parameter;
    names.emplace_back(parameter.substr(parameter.rfind(' ') + 1));
    if (names.back() == option.name) return line;
  }
  ThrowUnknown(option.where, "option", option.name, names);
}

void CheckType(const OptionStatement& option, std::string_view type) {
  const Token& value = option.value;
  if (type == "bool" && value.text != "true" && value.text != "false") {
    Misfit(option, "true or false");
  }
  if (type == "string" && value.kind != TokenKind::kString) Misfit(option, "a string");
  if ((type == "float" || type == "integer") && value.kind != TokenKind::kNumber) {
    Misfit(option, "a number");
  }
}

// A value may stand in brackets, as that of a parameter.
OptionStatement ReadOption(Statement& statement) {
  OptionStatement option;
  option.where = statement.lexer.Where(statement.lexer.Peek());
  option.name = statement.String();
  option.name = option.name.substr(option.name.find_last_of(' ') + 1);
  const bool bracket = statement.lexer.Peek().kind == TokenKind::kOpen;
  if (bracket) statement.lexer.Next();
  option.value = statement.lexer.Next();
  option.value_where = statement.lexer.Where(option.value);
  if (!bracket) return option;
  const Token close = statement.lexer.Next();
  if (close.kind != TokenKind::kClose) {
    throw InputError(statement.lexer.Where(close),
                     fmt::format("found {} where option {} needs ] after one value",
                                 close.Describe(), Quoted(option.name)));
  }
  return option;
}

void SetSeed(ParseState& state, const OptionStatement& option) {
  const double number = option.value.number;
  if (number < 0 || number > 4294967295.0 ||
      number != static_cast<double>(static_cast<std::uint64_t>(number))) {
    throw InputError(option.value_where,
                     "option \"seed\" takes an integer from 0 to 4294967295");
  }
  state.scene.sampler.seed = static_cast<std::uint64_t>(number);
}

void SetEdgeScale(ParseState& state, const OptionStatement& option) {
  if (!(option.value.number > 0)) {
    throw InputError(option.value_where,
                     "option \"displacementedgescale\" takes a number above 0");
  }
  state.edge_scale = option.value.number;
}

}  // namespace

void RunOption(ParseState& state, Statement& statement) {
  const OptionStatement option = ReadOption(statement);
  const FormatLine& line = FindOption(option);
  const std::string_view parameter = line.parameter;
  CheckType(option, parameter.substr(0, parameter.find(' ')));
  if (option.name == "seed") return SetSeed(state, option);
  if (option.name == "displacementedgescale") return SetEdgeScale(state, option);
  if (option.name == "disablepixeljitter") {
    state.pixel_centers = option.value.text == "true";
    return;
  }
  if (option.name == "disabletexturefiltering") {
    state.unfiltered_images = option.value.text == "true";
    return;
  }
  if (option.name == "forcediffuse") {
    state.force_diffuse = option.value.text == "true";
    return;
  }
  if (option.value.text == "false") return;  // what is the case anyway
  state.AddNote(option.where, fmt::format("option {} has no effect: {}",
                                          Quoted(option.name), line.why));
}

}  // namespace lanelight
