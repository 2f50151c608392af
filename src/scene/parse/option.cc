// `Option "name" value` or `Option "type name" value`.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "src/base/core/suggest.h"
#include "src/scene/parse/directives.h"

namespace lanelight {
namespace {

struct OptionStatement {
  std::string name;
  SourceLocation where;
  Token value;
  SourceLocation value_where;
};

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

template <bool ParseState::* kFlag>
void SetFlag(ParseState& state, const OptionStatement& option) {
  state.*kFlag = option.value.text == "true";
}

struct OptionInfo {
  const char *type, *name;
  void (*set)(ParseState&, const OptionStatement&);  // null: it has no effect ...
  const char* why = "";                              // ... and why
};

constexpr OptionInfo kOptions[] = {
    {"integer", "seed", SetSeed},
    {"bool", "disablepixeljitter", SetFlag<&ParseState::pixel_centers>},
    {"bool", "disabletexturefiltering", SetFlag<&ParseState::unfiltered_images>},
    {"bool", "disablewavelengthjitter", nullptr, "there are no wavelengths"},
    {"float", "displacementedgescale", SetEdgeScale},
    {"bool", "forcediffuse", SetFlag<&ParseState::force_diffuse>},
    {"string", "msereferenceimage", nullptr, "`lanelight compare` does it"},
    {"string", "msereferenceout", nullptr, "`lanelight compare` does it"},
    {"bool", "pixelstats", nullptr, "`lanelight profile` does it"},
    {"string", "rendercoordsys", nullptr, "lanelight chooses its own value"},
    {"bool", "stats", nullptr, "`--json` writes them"},
    {"bool", "wavefront", nullptr, "lanelight always renders wavefronts"}};

[[noreturn]] void Misfit(const OptionStatement& option, std::string_view takes) {
  throw InputError(option.value_where, "found {} as the value of option {}; it takes {}",
                   option.value.Describe(), Quoted(option.name), takes);
}

const OptionInfo& FindOption(const OptionStatement& option) {
  std::vector<std::string> names;
  for (const OptionInfo& info : kOptions) {
    names.emplace_back(info.name);
    if (option.name == info.name) return info;
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

OptionStatement ReadOption(Statement& statement) {
  const auto [typed, where] = statement.Name();
  OptionStatement option;
  option.where = where;
  // As pbrt-v4, ignores the case of letters, - and _.
  for (const char c : typed.substr(typed.find_last_of(' ') + 1)) {
    if (c == '-' || c == '_') continue;
    option.name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  const bool bracket = statement.lexer.Peek().kind == TokenKind::kOpen;
  if (bracket) statement.lexer.Next();
  option.value = statement.lexer.Next();
  option.value_where = statement.lexer.Where(option.value);
  if (!bracket) return option;
  const Token close = statement.lexer.Next();
  if (close.kind != TokenKind::kClose) {
    throw InputError(statement.lexer.Where(close),
                     "found {}, but option {} needs ] after one value", close.Describe(),
                     Quoted(option.name));
  }
  return option;
}

}  // namespace

void RunOption(ParseState& state, Statement& statement) {
  const OptionStatement option = ReadOption(statement);
  const OptionInfo& info = FindOption(option);
  CheckType(option, info.type);
  if (info.set != nullptr) return info.set(state, option);
  if (option.value.text == "false") return;  // what is the case anyway
  state.AddNote(option.where, "option {} has no effect: {}", Quoted(option.name),
                info.why);
}

}  // namespace lanelight
