#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/base/core/suggest.h"
#include "src/scene/parse/names.h"
#include "src/scene/parse/params.h"

namespace lanelight {
namespace {

constexpr std::size_t kMaxParams = 1000;  // of one object; no real object has 30

struct TypeInfo {
  const char* name;
  int tuple;  // numbers per value; 0: not made of numbers
};
constexpr TypeInfo kTypes[] = {  // in the order of ParamType
    {"bool", 0},      {"integer", 1}, {"float", 1},  {"point2", 2},   {"vector2", 2},
    {"point3", 3},    {"vector3", 3}, {"normal", 3}, {"spectrum", 0}, {"rgb", 3},
    {"blackbody", 1}, {"string", 0},  {"texture", 0}};
static_assert(std::size(kTypes) == static_cast<std::size_t>(ParamType::kTexture) + 1);

std::vector<std::string> TypeNames() {
  std::vector<std::string> names;
  for (const TypeInfo& info : kTypes) names.emplace_back(info.name);
  return names;
}

// Splits "type name".
void ReadDeclaration(const Lexer& lexer, const Token& token, Param* param) {
  constexpr std::string_view kBlank = " \t";
  const std::string_view text = token.text;
  const auto type_begin = text.find_first_not_of(kBlank);
  const auto type_end = text.find_first_of(kBlank, std::min(type_begin, text.size()));
  const auto name_begin = text.find_first_not_of(kBlank, std::min(type_end, text.size()));
  const auto name_end = text.find_first_of(kBlank, std::min(name_begin, text.size()));
  const auto rest = text.find_first_not_of(kBlank, std::min(name_end, text.size()));
  if (name_begin == text.npos || rest != text.npos) {
    throw InputError(param->where,
                     "found {}, expected a parameter \"type name\" or a directive",
                     Quoted(text));
  }
  const std::string_view type = text.substr(type_begin, type_end - type_begin);
  param->name = text.substr(name_begin, name_end - name_begin);
  for (int i = 0; i < static_cast<int>(std::size(kTypes)); ++i) {
    if (type == kTypes[i].name) {
      param->type = static_cast<ParamType>(i);
      return;
    }
  }
  CheckVersion3(lexer.Where(token), "parameter type", type);
  ThrowUnknown(lexer.Where(token),
               fmt::format("type of parameter {}:", Quoted(param->name)), type,
               TypeNames());
}

[[noreturn]] void ThrowWrongValue(const Lexer& lexer, const Token& token,
                                  const Param& param, std::string_view expected) {
  std::string found = token.Describe();
  if (token.kind == TokenKind::kWord && NearestName(token.text, {"nan", "inf"}) != "") {
    found += " (values must be finite numbers)";
  }
  throw InputError(lexer.Where(token), "found {} as a value of \"{} {}\"; it takes {}",
                   found, ParamTypeName(param.type), param.name, expected);
}

void AddNumber(const Lexer& lexer, const Token& token, Param* param) {
  if (token.kind != TokenKind::kNumber) {
    ThrowWrongValue(lexer, token, *param, "numbers");
  }
  if (param->type == ParamType::kInteger &&
      (token.number != std::floor(token.number) ||
       std::abs(token.number) > std::numeric_limits<int>::max())) {
    ThrowWrongValue(lexer, token, *param, "integers of at most 2147483647");
  }
  param->numbers.push_back(token.number);
}

// True if its strings are names defined by the scene.
bool IsName(const Param& param) {
  return param.type == ParamType::kTexture || param.name == "materials";
}

void AddValue(const Lexer& lexer, const Token& token, Param* param) {
  const bool is_string = token.kind == TokenKind::kString;
  switch (param->type) {
    case ParamType::kBool:
      if (token.text == "true" || token.text == "false") {
        param->bools.push_back(token.text == "true");
        return;
      }
      ThrowWrongValue(lexer, token, *param, "true or false");
    case ParamType::kString:
    case ParamType::kTexture:
      if (!is_string) ThrowWrongValue(lexer, token, *param, "strings");
      param->strings.push_back(IsName(*param) ? NormalizedName(token.text)
                                              : std::string(token.text));
      return;
    case ParamType::kSpectrum:
      if (!is_string) return AddNumber(lexer, token, param);
      param->strings.emplace_back(token.text);
      return;
    default:
      AddNumber(lexer, token, param);
  }
}

void ReadValues(Lexer& lexer, Param* param) {
  Token token = lexer.Next();
  if (token.kind != TokenKind::kOpen) return AddValue(lexer, token, param);
  const Token open = token;
  for (token = lexer.Next(); token.kind != TokenKind::kClose; token = lexer.Next()) {
    if (token.kind == TokenKind::kEnd) {
      throw InputError(lexer.Where(open), "this [ has no matching ]");
    }
    AddValue(lexer, token, param);
  }
}

void CheckCount(const Param& param) {
  const std::size_t n = param.numbers.size();
  const std::size_t values = n + param.strings.size() + param.bools.size();
  const std::string who = fmt::format("\"{} {}\"", ParamTypeName(param.type), param.name);
  if (values == 0) throw InputError(param.where, who + " has no value");
  const int tuple = kTypes[static_cast<int>(param.type)].tuple;
  if (tuple > 1 && n % tuple != 0) {
    throw InputError(param.where, "{} has {} numbers; they come in groups of {}", who, n,
                     tuple);
  }
  // Grids of colours are rgb; ColorOf requires a single colour.
  const bool single =
      param.type == ParamType::kBlackbody || param.type == ParamType::kTexture;
  const std::size_t max_values = single ? std::max(tuple, 1) : values;
  const bool mixed = !param.strings.empty() && (n > 0 || param.strings.size() > 1);
  if (values > max_values || (param.type == ParamType::kSpectrum && mixed)) {
    throw InputError(param.where, who + " has more than one value");
  }
}

// Removes an earlier parameter of the same name.
void Replace(ParamList& params, const Param& param, std::vector<Note>* notes) {
  const auto earlier = std::find_if(params.begin(), params.end(),
                                    [&](const Param& p) { return p.name == param.name; });
  if (earlier == params.end()) return;
  if (earlier->type != param.type) {
    throw InputError(
        param.where, "parameter {} is given twice, as {} and as {}; keep one",
        Quoted(param.name), ParamTypeName(earlier->type), ParamTypeName(param.type));
  }
  notes->push_back({param.where,
                    fmt::format("parameter \"{} {}\" is given twice; this one is used",
                                ParamTypeName(param.type), param.name),
                    false, true});
  params.erase(earlier);
}

}  // namespace

const char* ParamTypeName(ParamType type) { return kTypes[static_cast<int>(type)].name; }

ParamList ReadParams(Lexer& lexer, const std::string& color_space,
                     std::vector<Note>* notes) {
  ParamList params;
  while (lexer.Peek().kind == TokenKind::kString) {
    const Token token = lexer.Next();
    Param param;
    param.where = lexer.Where(token);
    param.color_space = color_space;
    ReadDeclaration(lexer, token, &param);
    ReadValues(lexer, &param);
    CheckCount(param);
    Replace(params, param, notes);
    params.push_back(std::move(param));
    if (params.size() > kMaxParams) {
      throw InputError(params.back().where, "more than {} parameters", kMaxParams);
    }
  }
  return params;
}

}  // namespace lanelight
