#include "src/parse/directives.h"
#include "src/parse/format.h"
#include "src/parse/interpret.h"
#include "src/core/suggest.h"

namespace lanelight {
namespace {

struct TypedObject {
  std::string type;
  ParamSet params;
};

// InputError for what the table of the format refuses with a reason. Where unsupported
// things are to be skipped, the interpreters say what happens instead.
void CheckRefused(const ParseState& state, const SourceLocation& where,
                  std::string_view directive, std::string_view kind,
                  const std::string& type) {
  const std::string_view why = WhyRefused(directive, type);
  if (why.empty() || state.options.skip_unsupported) return;
  throw InputError(where,
                   fmt::format("{} {} is not supported: {} (--skip-unsupported goes on "
                               "without it)",
                               kind, Quoted(type), why));
}

// Reads "type" and parameters; the type's own place is where errors about it point.
TypedObject ReadObject(ParseState& state, Statement& statement, const char* kind,
                       std::shared_ptr<const ParamList> inherited = nullptr) {
  const SourceLocation where = statement.lexer.Where(statement.lexer.Peek());
  std::string type = statement.String();
  CheckRefused(state, where, statement.token.text, kind, type);
  ParamList own = ReadParams(statement.lexer, state.graphics.color_space);
  ParamSet params(fmt::format("{} {}", kind, Quoted(type)), where, std::move(own),
                  std::move(inherited), &state.scene.notes);
  return {std::move(type), std::move(params)};
}

}  // namespace

void RunCamera(ParseState& state, Statement& statement) {
  TypedObject object = ReadObject(state, statement, "camera");
  InterpretCamera(state, object.type, object.params);
}

void RunFilm(ParseState& state, Statement& statement) {
  TypedObject object = ReadObject(state, statement, "film");
  InterpretFilm(state, object.type, object.params);
}

void RunPixelFilter(ParseState& state, Statement& statement) {
  TypedObject object = ReadObject(state, statement, "pixel filter");
  InterpretFilter(state, object.type, object.params);
}

void RunSampler(ParseState& state, Statement& statement) {
  TypedObject object = ReadObject(state, statement, "sampler");
  InterpretSampler(state, object.type, object.params);
}

void RunIntegrator(ParseState& state, Statement& statement) {
  TypedObject object = ReadObject(state, statement, "integrator");
  InterpretIntegrator(state, object.type, object.params);
}

// Every parameter of the table is noted; anything else is unknown.
void RunAccelerator(ParseState& state, Statement& statement) {
  TypedObject object = ReadObject(state, statement, "accelerator");
  std::vector<std::string> types;
  bool known = false;
  for (const FormatObject& o : PbrtFormat()) {
    if (o.directive != std::string("Accelerator")) continue;
    types.emplace_back(o.type);
    if (object.type != o.type) continue;
    known = true;
    for (const FormatLine& line : o.lines) {
      const std::string_view parameter = line.parameter;
      object.params.Ignore(parameter.substr(parameter.rfind(' ') + 1), line.why);
    }
  }
  if (!known) ThrowUnknown(object.params.where(), "accelerator", object.type, types);
  object.params.CheckAllUsed();
  state.AddNote(statement.where(),
                fmt::format("accelerator {} has no effect: there is one kind",
                            Quoted(object.type)));
}

void RunMaterial(ParseState& state, Statement& statement) {
  TypedObject object = ReadObject(state, statement, "material",
                                  state.Inherited(AttributeTarget::kMaterial));
  state.graphics.material = InterpretMaterial(state, "", object.type, object.params);
}

void RunMakeNamedMaterial(ParseState& state, Statement& statement) {
  const SourceLocation where = statement.lexer.Where(statement.lexer.Peek());
  const std::string name = statement.String();
  ParamList own = ReadParams(statement.lexer, state.graphics.color_space);
  if (state.materials.contains(name)) {
    throw InputError(where, fmt::format("material {} is defined twice", Quoted(name)));
  }
  ParamSet params(fmt::format("material {}", Quoted(name)), where, std::move(own),
                  state.Inherited(AttributeTarget::kMaterial), &state.scene.notes);
  const std::string type = params.String("type", "");
  if (params.Find("type", {}) == nullptr) {
    throw InputError(where,
                     fmt::format("material {} has no \"string type\"", Quoted(name)));
  }
  CheckRefused(state, where, "Material", "material", type);
  state.materials[name] = InterpretMaterial(state, name, type, params);
}

void RunNamedMaterial(ParseState& state, Statement& statement) {
  const SourceLocation where = statement.lexer.Where(statement.lexer.Peek());
  const std::string name = statement.String();
  const auto it = state.materials.find(name);
  if (it == state.materials.end()) {
    ThrowUnknown(where, "named material", name, Names(state.materials));
  }
  state.graphics.material = it->second;
}

void RunTexture(ParseState& state, Statement& statement) {
  const SourceLocation where = statement.lexer.Where(statement.lexer.Peek());
  const std::string name = statement.String();
  const SourceLocation value_where = statement.lexer.Where(statement.lexer.Peek());
  const std::string value = statement.String();
  TypedObject object =
      ReadObject(state, statement, "texture", state.Inherited(AttributeTarget::kTexture));
  if (value != "float" && value != "spectrum") {
    ThrowUnknown(value_where, "value type of a texture:", value, {"float", "spectrum"});
  }
  const bool is_float = value == "float";
  auto& names = is_float ? state.float_textures : state.color_textures;
  if (names.contains(name)) {
    throw InputError(where,
                     fmt::format("{} texture {} is defined twice", value, Quoted(name)));
  }
  InterpretTexture(state, name, is_float, object.type, object.params);
}

void RunLightSource(ParseState& state, Statement& statement) {
  TypedObject object =
      ReadObject(state, statement, "light", state.Inherited(AttributeTarget::kLight));
  InterpretLight(state, object.type, object.params);
}

void RunAreaLightSource(ParseState& state, Statement& statement) {
  TypedObject object = ReadObject(state, statement, "area light",
                                  state.Inherited(AttributeTarget::kLight));
  state.graphics.area_light = InterpretAreaLight(state, object.type, object.params);
}

void RunShape(ParseState& state, Statement& statement) {
  TypedObject object =
      ReadObject(state, statement, "shape", state.Inherited(AttributeTarget::kShape));
  InterpretShape(state, object.type, object.params);
}

void RunMakeNamedMedium(ParseState& state, Statement& statement) {
  const SourceLocation where = statement.lexer.Where(statement.lexer.Peek());
  const std::string name = statement.String();
  ParamList own = ReadParams(statement.lexer, state.graphics.color_space);
  if (name.empty()) {
    throw InputError(where, "the empty name is that of empty space; give another");
  }
  if (state.media.contains(name)) {
    throw InputError(where, fmt::format("medium {} is defined twice", Quoted(name)));
  }
  ParamSet params(fmt::format("medium {}", Quoted(name)), where, std::move(own),
                  state.Inherited(AttributeTarget::kMedium), &state.scene.notes);
  InterpretMedium(state, name, params);
}

namespace {

// The medium that the next string names; "": empty space.
Index NextMedium(const ParseState& state, Statement& statement) {
  const SourceLocation where = statement.lexer.Where(statement.lexer.Peek());
  const std::string name = statement.String();
  if (name.empty()) return kNone;
  const auto it = state.media.find(name);
  if (it == state.media.end()) {
    ThrowUnknown(where, "named medium", name, Names(state.media));
  }
  return it->second;
}

}  // namespace

// One name: the same on both sides.
void RunMediumInterface(ParseState& state, Statement& statement) {
  MediumInterface& media = state.graphics.media;
  media.inside = media.outside = NextMedium(state, statement);
  if (statement.lexer.Peek().kind == TokenKind::kString) {
    media.outside = NextMedium(state, statement);
  }
}

}  // namespace lanelight
