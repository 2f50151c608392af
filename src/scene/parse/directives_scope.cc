#include <fmt/format.h>

#include <cctype>

#include "src/base/core/suggest.h"
#include "src/scene/parse/directives.h"
#include "src/scene/parse/interpret.h"
#include "src/scene/parse/motion.h"

namespace lanelight {
namespace {

constexpr std::size_t kDeepestNesting = 1000;

void Push(ParseState& state, const Statement& statement, ScopeKind kind) {
  if (state.scopes.size() >= kDeepestNesting) {
    throw InputError(statement.where(), "blocks are nested more than {} deep",
                     kDeepestNesting);
  }
  state.scopes.push_back({kind, statement.where(), state.graphics});
}

bool HasOpenScope(const ParseState& state) {
  return !state.scopes.empty() && state.scopes.back().kind != ScopeKind::kImport;
}

// Removes the innermost scope, which must be of this kind.
GraphicsState Pop(ParseState& state, const Statement& statement, ScopeKind kind) {
  if (!HasOpenScope(state)) {
    throw InputError(statement.where(), "{} without {}", statement.token.text,
                     BeginName(kind));
  }
  const Scope& scope = state.scopes.back();
  if (scope.kind != kind) {
    throw InputError(statement.where(), "{} inside the {} of {}", statement.token.text,
                     BeginName(scope.kind), scope.where.ToString());
  }
  GraphicsState saved = std::move(state.scopes.back().saved);
  state.scopes.pop_back();
  return saved;
}

}  // namespace

void RunWorldBegin(ParseState& state, Statement&) {
  state.in_world = true;
  GraphicsState& graphics = state.graphics;
  graphics.ctm = graphics.ctm_end = Transform();
  graphics.start_active = graphics.end_active = true;
  state.coordinate_systems["world"] = {};
}

void RunAttributeBegin(ParseState& state, Statement& statement) {
  Push(state, statement, ScopeKind::kAttribute);
}

// pbrt-v4 goes on after a superfluous one, in an imported file as well.
void RunAttributeEnd(ParseState& state, Statement& statement) {
  if (!HasOpenScope(state)) {
    return state.AddWarning(statement.where(), "{} without AttributeBegin is ignored",
                            statement.token.text);
  }
  state.graphics = Pop(state, statement, ScopeKind::kAttribute);
}

void RunTransformBegin(ParseState& state, Statement& statement) {
  constexpr const char* kMessage =
      "TransformBegin and TransformEnd are AttributeBegin and AttributeEnd, as in "
      "pbrt-v4; write those";
  if (state.noted.insert(kMessage).second)
    state.AddWarning(statement.where(), "{}", kMessage);
  RunAttributeBegin(state, statement);
}

void RunObjectBegin(ParseState& state, Statement& statement) {
  const auto [name, where] = statement.Name();
  if (state.open_object != kNone) {
    throw InputError(
        statement.where(),
        "ObjectBegin inside the definition of object {}; objects do not nest",
        Quoted(state.scene.objects[state.open_object].name));
  }
  const Index index = DefineObject(state, name, where);
  Push(state, statement, ScopeKind::kObject);
  state.open_object = index;
}

void RunObjectEnd(ParseState& state, Statement& statement) {
  state.graphics = Pop(state, statement, ScopeKind::kObject);
  state.open_object = kNone;
}

void RunObjectInstance(ParseState& state, Statement& statement) {
  const auto [name, where] = statement.Name();
  if (state.open_object != kNone) {
    throw InputError(statement.where(),
                     "ObjectInstance inside an object definition; instances do not nest");
  }
  PlaceObject(state, UseObject(state, name, where), statement.where());
}

void RunInclude(ParseState& state, Statement& statement) {
  const auto [name, where] = statement.FileName();
  RunFile(state, ResolvePath(state, name), where);
}

// Like Include, but changes to the graphics state end with the file.
void RunImport(ParseState& state, Statement& statement) {
  const auto [name, where] = statement.FileName();
  Push(state, statement, ScopeKind::kImport);
  RunFile(state, ResolvePath(state, name), where);
  const Scope& scope = state.scopes.back();
  if (scope.kind != ScopeKind::kImport) {
    throw InputError(scope.where, "this {} has no end in the imported file",
                     BeginName(scope.kind));
  }
  state.graphics = std::move(state.scopes.back().saved);
  state.scopes.pop_back();
}

void RunAttribute(ParseState& state, Statement& statement) {
  static constexpr std::pair<const char*, AttributeTarget> kTargets[] = {
      {"shape", AttributeTarget::kShape},
      {"light", AttributeTarget::kLight},
      {"material", AttributeTarget::kMaterial},
      {"medium", AttributeTarget::kMedium},
      {"texture", AttributeTarget::kTexture}};
  const auto [name, where] = statement.Name();
  const AttributeTarget target = Lookup(kTargets, name, where, "target of Attribute:");
  const ParamList added =
      ReadParams(statement.lexer, state.graphics.color_space, &state.scene.notes);
  auto& current = state.graphics.attributes[static_cast<int>(target)];
  // Scopes share the list until it changes.
  auto list =
      current ? std::make_shared<ParamList>(*current) : std::make_shared<ParamList>();
  for (const Param& param : added) {
    std::erase_if(*list, [&](const Param& old) { return old.name == param.name; });
    list->push_back(param);
  }
  current = std::move(list);
}

void RunReverseOrientation(ParseState& state, Statement&) {
  state.graphics.reverse_orientation = !state.graphics.reverse_orientation;
}

void RunColorSpace(ParseState& state, Statement& statement) {
  static const std::vector<std::string> kSpaces = {"srgb", "dci-p3", "rec2020",
                                                   "aces2065-1"};
  const auto [original, where] = statement.Name();
  std::string name = original;  // in letters of either case, as in pbrt-v4
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (std::find(kSpaces.begin(), kSpaces.end(), name) == kSpaces.end()) {
    return state.AddWarning(where, "unknown color space {} is ignored; known: {}",
                            Quoted(original), QuotedList(kSpaces));
  }
  state.graphics.color_space = name;
}

}  // namespace lanelight
