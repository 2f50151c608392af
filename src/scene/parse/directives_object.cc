#include <fmt/format.h>

#include <optional>

#include "src/base/core/suggest.h"
#include "src/scene/parse/directives.h"
#include "src/scene/parse/interpret.h"

namespace lanelight {
namespace {

struct TypedObject {
  std::string type;
  ParamSet params;
};

// The name of an object in messages, and the source of its defaults.
struct ObjectKind {
  const char* word;
  std::optional<AttributeTarget> defaults = {};
};

ParamSet ReadParamSet(ParseState& state, Statement& statement, const ObjectKind& kind,
                      const NameOperand& name) {
  ParamList own =
      ReadParams(statement.lexer, state.graphics.color_space, &state.scene.notes);
  return {fmt::format("{} {}", kind.word, Quoted(name.text)), name.where, std::move(own),
          kind.defaults ? state.Inherited(*kind.defaults) : nullptr, &state.scene.notes};
}

// Reads "type" and parameters. Errors point at the type.
TypedObject ReadObject(ParseState& state, Statement& statement, const ObjectKind& kind) {
  const NameOperand type = statement.Name();
  return {type.text, ReadParamSet(state, statement, kind, type)};
}

constexpr ObjectKind kMaterial = {"material", AttributeTarget::kMaterial};

void UseMaterial(ParseState& state, const NameUse& use) {
  const auto found = state.names.find(use.key);
  const bool later = found == state.names.end();
  state.graphics.material = later ? kNone : found->second;
  state.graphics.later_material = later ? std::make_shared<const NameUse>(use) : nullptr;
}

void SetMaterial(ParseState& state, const std::string& type, ParamSet& params) {
  const NameKey key = {NameKind::kPlainMaterial, std::to_string(state.declared.size())};
  const SourceLocation where = params.where();
  RunOrWait(state, &key, [key, type, params](ParseState& s) mutable {
    Define(s, key, InterpretMaterial(s, "", type, params));
  });
  UseMaterial(state, {key, where});
}

void AddShape(ParseState& state, const std::string& type, ParamSet& params) {
  RunOrWait(state, nullptr, [type, params = std::move(params)](ParseState& s) mutable {
    InterpretShape(s, type, params);
  });
}

void SetAreaLight(ParseState& state, const std::string& type, ParamSet& params) {
  state.graphics.area_light = InterpretAreaLight(state, type, params);
}

// Directives that are followed by a type and parameters, and nothing else.
struct ObjectDirective {
  ObjectKind kind;
  void (*interpret)(ParseState&, const std::string&, ParamSet&);
};
constexpr std::pair<std::string_view, ObjectDirective> kObjects[] = {
    {"Camera", {{"camera"}, InterpretCamera}},
    {"Film", {{"film"}, InterpretFilm}},
    {"PixelFilter", {{"pixel filter"}, InterpretFilter}},
    {"Sampler", {{"sampler"}, InterpretSampler}},
    {"Integrator", {{"integrator"}, InterpretIntegrator}},
    {"Material", {kMaterial, SetMaterial}},
    {"LightSource", {{"light", AttributeTarget::kLight}, InterpretLight}},
    {"AreaLightSource", {{"area light", AttributeTarget::kLight}, SetAreaLight}},
    {"Shape", {{"shape", AttributeTarget::kShape}, AddShape}}};

// Reads the name of a medium; "" is empty space.
Index NextMedium(ParseState& state, Statement& statement) {
  const auto [name, where] = statement.Name();
  return name.empty() ? kNone : UseMedium(state, name, where);
}

}  // namespace

void RunObject(ParseState& state, Statement& statement) {
  const auto& [kind, interpret] =
      Lookup(kObjects, std::string(statement.token.text), statement.where(), "directive");
  TypedObject object = ReadObject(state, statement, kind);
  interpret(state, object.type, object.params);
}

void RunAccelerator(ParseState& state, Statement& statement) {
  TypedObject object = ReadObject(state, statement, {"accelerator"});
  InterpretAccelerator(object.type, object.params);
  state.AddNote(statement.where(),
                "accelerator {} has no effect: the BVH is the only accelerator",
                Quoted(object.type));
}

void RunMakeNamedMaterial(ParseState& state, Statement& statement) {
  const NameOperand name = statement.Name();
  ParamSet params = ReadParamSet(state, statement, kMaterial, name);
  const NameKey key = {NameKind::kMaterial, name.text};
  if (state.declared.contains(key)) {
    throw InputError(name.where, "material {} is defined twice", Quoted(name.text));
  }
  params.Need("type", ParamType::kString);
  const std::string type = params.String("type", "");
  RunOrWait(state, &key, [key, type, params](ParseState& s) mutable {
    Define(s, key, InterpretMaterial(s, key.second, type, params));
  });
}

void RunNamedMaterial(ParseState& state, Statement& statement) {
  const auto [name, where] = statement.Name();
  UseMaterial(state, {{NameKind::kMaterial, name}, where});
}

void RunTexture(ParseState& state, Statement& statement) {
  static constexpr std::pair<const char*, bool> kIsFloat[] = {{"float", true},
                                                              {"spectrum", false}};
  const auto [name, where] = statement.Name();
  const auto [value, value_where] = statement.Name();
  TypedObject object =
      ReadObject(state, statement, {"texture", AttributeTarget::kTexture});
  const bool is_float = Lookup(kIsFloat, value, value_where, "value type of a texture:");
  const NameKey key = {is_float ? NameKind::kFloatTexture : NameKind::kSpectrumTexture,
                       name};
  if (state.declared.contains(key)) {
    throw InputError(where, "{} texture {} is defined twice", value, Quoted(name));
  }
  RunOrWait(state, &key, [key, object](ParseState& s) mutable {
    InterpretTexture(s, key, object.type, object.params);
  });
}

void RunMakeNamedMedium(ParseState& state, Statement& statement) {
  const NameOperand name = statement.Name();
  ParamSet params =
      ReadParamSet(state, statement, {"medium", AttributeTarget::kMedium}, name);
  if (name.text.empty()) {
    throw InputError(name.where,
                     "the empty name stands for empty space; use another name");
  }
  if (const auto it = state.media.find(name.text);
      it != state.media.end() && it->second.defined) {
    throw InputError(name.where, "medium {} is defined twice", Quoted(name.text));
  }
  InterpretMedium(state, name.text, params);
}

// A single name stands for both sides.
void RunMediumInterface(ParseState& state, Statement& statement) {
  MediumInterface& media = state.graphics.media;
  media.inside = media.outside = NextMedium(state, statement);
  if (statement.lexer.Peek().kind == TokenKind::kString) {
    media.outside = NextMedium(state, statement);
  }
}

}  // namespace lanelight
