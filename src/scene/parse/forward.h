// Names that may be used before the file defines them. pbrt-v4 resolves names after the
// last line. Here a statement that uses an undefined material or texture waits until the
// definition has been read; undefined media and objects get their index at the first use.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>

#include "src/scene/description/description.h"

namespace lanelight {

struct ParseState;

/// kPlainMaterial: of the directive Material; its name is a number.
enum class NameKind { kMaterial, kPlainMaterial, kFloatTexture, kSpectrumTexture };
using NameKey = std::pair<NameKind, std::string>;

/// A use of a name. Thrown where the name has no definition yet; RunOrWait catches it.
struct NameUse {
  NameKey key;
  SourceLocation where;
};

/// The index of a medium or object, which may be used before it is defined.
struct NameSlot {
  Index index = kNone;
  SourceLocation where;  // of the first use or the definition
  bool defined = false;
};
using NameSlots = std::map<std::string, NameSlot>;

/// Returns the index of a defined name. Throws `use` itself if there is no definition
/// yet.
Index Resolve(const ParseState& state, const NameUse& use);

/// Makes `key` stand for `index`; statements that wait for it become ready.
void Define(ParseState& state, const NameKey& key, Index index);

/// Calls `run`. If that throws a NameUse, what `run` has added is removed, and `run` is
/// called again, in the same graphics state, once the name is defined. `defines`: what
/// the statement defines, or null.
void RunOrWait(ParseState& state, const NameKey* defines,
               std::function<void(ParseState&)> run);

/// Runs the statements that have become ready, and those which these make ready.
void RunReady(ParseState& state);

/// Throws InputError for the first statement in the file that still waits: the name is
/// defined nowhere, or by itself.
void RequireAllResolved(const ParseState& state);

/// Returns the index of medium `name`, which may be defined later.
Index UseMedium(ParseState& state, const std::string& name, const SourceLocation& where);
/// Appends a medium, or fills the place that a use of it has taken.
void DefineMedium(ParseState& state, Medium medium);
/// The same for objects; returns the index. InputError if it is defined twice.
Index UseObject(ParseState& state, const std::string& name, const SourceLocation& where);
Index DefineObject(ParseState& state, const std::string& name,
                   const SourceLocation& where);

/// InputError for the first object, and the first medium that a shape or the camera uses,
/// without definition. Other media without definition are warnings.
void RequireSlotsDefined(ParseState& state);

}  // namespace lanelight
