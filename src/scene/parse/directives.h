// The table of directives. A directive reads its operands from the lexer and changes the
// state; one function each, grouped by file.
#pragma once

#include "src/scene/parse/lex.h"
#include "src/scene/parse/parse_state.h"

namespace lanelight {

/// A string, and where it stands.
struct NameOperand {
  std::string text;
  SourceLocation where;
};

/// One occurrence of a directive: where its operands come from.
struct Statement {
  Lexer& lexer;
  Token token;  // the directive's own name

  SourceLocation where() const { return lexer.Where(token); }
  /// The next token as a number / a string; InputError naming the directive otherwise.
  double Number();
  /// Names are in composed form (NFC); names of files are as they stand.
  NameOperand Name();
  NameOperand FileName();
  /// `count` numbers, in brackets or bare.
  std::vector<double> Numbers(std::size_t count);
};

using DirectiveFn = void (*)(ParseState&, Statement&);

// directives_transform.cc
void RunIdentity(ParseState&, Statement&);
void RunTranslate(ParseState&, Statement&);
void RunRotate(ParseState&, Statement&);
void RunScale(ParseState&, Statement&);
void RunLookAt(ParseState&, Statement&);
void RunTransform(ParseState&, Statement&);
void RunConcatTransform(ParseState&, Statement&);
void RunCoordinateSystem(ParseState&, Statement&);
void RunCoordSysTransform(ParseState&, Statement&);
void RunActiveTransform(ParseState&, Statement&);
void RunTransformTimes(ParseState&, Statement&);

// directives_scope.cc
void RunWorldBegin(ParseState&, Statement&);
void RunAttributeBegin(ParseState&, Statement&);
void RunAttributeEnd(ParseState&, Statement&);
void RunTransformBegin(ParseState&, Statement&);
void RunObjectBegin(ParseState&, Statement&);
void RunObjectEnd(ParseState&, Statement&);
void RunObjectInstance(ParseState&, Statement&);
void RunInclude(ParseState&, Statement&);
void RunImport(ParseState&, Statement&);
void RunAttribute(ParseState&, Statement&);
void RunReverseOrientation(ParseState&, Statement&);
void RunColorSpace(ParseState&, Statement&);

// directives_object.cc, option.cc
void RunObject(ParseState&, Statement&);  // those of a type and parameters alone
void RunAccelerator(ParseState&, Statement&);
void RunOption(ParseState&, Statement&);
void RunMakeNamedMaterial(ParseState&, Statement&);
void RunNamedMaterial(ParseState&, Statement&);
void RunTexture(ParseState&, Statement&);
void RunMakeNamedMedium(ParseState&, Statement&);
void RunMediumInterface(ParseState&, Statement&);

}  // namespace lanelight
