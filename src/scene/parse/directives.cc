#include "src/scene/parse/directives.h"

#include <fmt/format.h>

#include "src/base/core/suggest.h"
#include "src/scene/parse/names.h"

namespace lanelight {
namespace {

enum class Block { kAny, kOptions, kWorld };  // before WorldBegin, after it

struct Directive {
  const char* name;
  Block block;
  DirectiveFn run;
};

constexpr Directive kDirectives[] = {
    {"Identity", Block::kAny, RunIdentity},
    {"Translate", Block::kAny, RunTranslate},
    {"Rotate", Block::kAny, RunRotate},
    {"Scale", Block::kAny, RunScale},
    {"LookAt", Block::kAny, RunLookAt},
    {"Transform", Block::kAny, RunTransform},
    {"ConcatTransform", Block::kAny, RunConcatTransform},
    {"CoordinateSystem", Block::kAny, RunCoordinateSystem},
    {"CoordSysTransform", Block::kAny, RunCoordSysTransform},
    {"ActiveTransform", Block::kAny, RunActiveTransform},
    {"TransformTimes", Block::kOptions, RunTransformTimes},
    {"Camera", Block::kOptions, RunObject},
    {"Film", Block::kOptions, RunObject},
    {"PixelFilter", Block::kOptions, RunObject},
    {"Sampler", Block::kOptions, RunObject},
    {"Integrator", Block::kOptions, RunObject},
    {"Accelerator", Block::kOptions, RunAccelerator},
    {"Option", Block::kOptions, RunOption},
    {"WorldBegin", Block::kOptions, RunWorldBegin},
    {"ColorSpace", Block::kAny, RunColorSpace},
    {"Attribute", Block::kAny, RunAttribute},
    {"Include", Block::kAny, RunInclude},
    {"Import", Block::kWorld, RunImport},
    {"AttributeBegin", Block::kWorld, RunAttributeBegin},
    {"AttributeEnd", Block::kWorld, RunAttributeEnd},
    {"TransformBegin", Block::kWorld, RunTransformBegin},
    {"TransformEnd", Block::kWorld, RunAttributeEnd},
    {"ReverseOrientation", Block::kWorld, RunReverseOrientation},
    {"Material", Block::kWorld, RunObject},
    {"MakeNamedMaterial", Block::kWorld, RunMakeNamedMaterial},
    {"NamedMaterial", Block::kWorld, RunNamedMaterial},
    {"Texture", Block::kWorld, RunTexture},
    {"LightSource", Block::kWorld, RunObject},
    {"AreaLightSource", Block::kWorld, RunObject},
    {"Shape", Block::kWorld, RunObject},
    {"ObjectBegin", Block::kWorld, RunObjectBegin},
    {"ObjectEnd", Block::kWorld, RunObjectEnd},
    {"ObjectInstance", Block::kWorld, RunObjectInstance},
    {"MakeNamedMedium", Block::kAny, RunMakeNamedMedium},
    {"MediumInterface", Block::kAny, RunMediumInterface},
};

const Directive* FindDirective(std::string_view name) {
  for (const Directive& directive : kDirectives) {
    if (name == directive.name) return &directive;
  }
  return nullptr;
}

void CheckBlock(const ParseState& state, const Directive& directive,
                const SourceLocation& where) {
  if (directive.block == Block::kOptions && state.in_world) {
    if (directive.name == std::string_view("WorldBegin")) {
      throw InputError(where, "a second WorldBegin; a scene has one");
    }
    throw InputError(where, "{} must come before WorldBegin", directive.name);
  }
  if (directive.block == Block::kWorld && !state.in_world) {
    throw InputError(where, "{} must come after WorldBegin", directive.name);
  }
}

}  // namespace

double Statement::Number() {
  const Token operand = lexer.Next();
  if (operand.kind == TokenKind::kNumber) return operand.number;
  throw InputError(lexer.Where(operand), "found {} where {} needs a number",
                   operand.Describe(), token.text);
}

NameOperand Statement::Name() {
  NameOperand name = FileName();
  name.text = NormalizedName(name.text);
  return name;
}

NameOperand Statement::FileName() {
  const Token operand = lexer.Next();
  const SourceLocation where = lexer.Where(operand);
  if (operand.kind == TokenKind::kString) return {std::string(operand.text), where};
  throw InputError(where, "found {}, but {} needs a name in quotes", operand.Describe(),
                   token.text);
}

std::vector<double> Statement::Numbers(std::size_t count) {
  const bool bracket = lexer.Peek().kind == TokenKind::kOpen;
  if (bracket) lexer.Next();
  std::vector<double> numbers(count);
  for (double& number : numbers) number = Number();
  if (!bracket) return numbers;
  const Token close = lexer.Next();
  if (close.kind != TokenKind::kClose) {
    throw InputError(lexer.Where(close), "found {} where {} needs ] after {} numbers",
                     close.Describe(), token.text, count);
  }
  return numbers;
}

void RunDirectives(ParseState& state) {
  const SourceFilePtr file = state.open_files.back();
  Lexer lexer(file->text, file->name);
  for (Token token = lexer.Next(); token.kind != TokenKind::kEnd; token = lexer.Next()) {
    Statement statement{lexer, token};
    if (token.kind != TokenKind::kWord) {
      throw InputError(statement.where(), "found {}, expected a directive",
                       token.Describe());
    }
    const Directive* directive = FindDirective(token.text);
    if (directive == nullptr) {
      CheckVersion3(statement.where(), "directive", token.text);
      if (!std::all_of(token.text.begin(), token.text.end(), IsAscii)) {
        throw InputError(statement.where(),
                         "{} is not a directive: it has characters that are not ASCII, "
                         "such as a no-break space",
                         Quoted(token.text));
      }
      std::vector<std::string> known;
      for (const Directive& d : kDirectives) known.emplace_back(d.name);
      ThrowUnknown(statement.where(), "directive", token.text, known);
    }
    CheckBlock(state, *directive, statement.where());
    directive->run(state, statement);
    RunReady(state);
  }
}

}  // namespace lanelight
