#include <fmt/format.h>

#include "src/scene/parse/forward.h"
#include "src/scene/parse/parse_state.h"

namespace lanelight {
namespace {

using NamedSlot = NameSlots::value_type;

// Throws InputError unless `missing` is null.
void RequireDefined(const NamedSlot* missing, const char* kind, const NameSlots& slots) {
  if (missing == nullptr) return;
  std::vector<std::string> defined;
  for (const auto& [name, slot] : slots) {
    if (slot.defined) defined.push_back(name);
  }
  ThrowNotDefined(missing->second.where, kind, missing->first, defined);
}

bool IsUsed(const SceneDescription& scene, Index medium) {
  const auto uses = [&](const std::vector<Shape>& shapes) {
    return std::any_of(shapes.begin(), shapes.end(), [&](const Shape& shape) {
      return shape.media.inside == medium || shape.media.outside == medium;
    });
  };
  return scene.camera.medium == medium || uses(scene.shapes) ||
         std::any_of(scene.objects.begin(), scene.objects.end(),
                     [&](const ObjectDefinition& object) { return uses(object.shapes); });
}

}  // namespace

Index UseMedium(ParseState& state, const std::string& name, const SourceLocation& where) {
  NameSlot& slot = state.media[name];
  if (slot.index != kNone) return slot.index;
  Medium medium;
  medium.name = name;
  medium.where = where;
  slot = {Append(state.scene.media, std::move(medium)), where};
  return slot.index;
}

void DefineMedium(ParseState& state, Medium medium) {
  const Index index = UseMedium(state, medium.name, medium.where);
  state.media[medium.name].defined = true;
  state.scene.media[static_cast<std::size_t>(index)] = std::move(medium);
}

Index UseObject(ParseState& state, const std::string& name, const SourceLocation& where) {
  NameSlot& slot = state.objects[name];
  if (slot.index != kNone) return slot.index;
  slot = {Append(state.scene.objects, {name, {}}), where};
  return slot.index;
}

Index DefineObject(ParseState& state, const std::string& name,
                   const SourceLocation& where) {
  const Index index = UseObject(state, name, where);
  bool& defined = state.objects[name].defined;
  if (defined) {
    throw InputError(where, "object {} is defined twice", Quoted(name));
  }
  defined = true;
  return index;
}

void RequireSlotsDefined(ParseState& state) {
  const auto first = [](const NamedSlot* a, const NamedSlot& b) {
    return a == nullptr || b.second.index < a->second.index ? &b : a;
  };
  const NamedSlot *object = nullptr, *medium = nullptr;
  for (const NamedSlot& slot : state.objects) {
    if (!slot.second.defined) object = first(object, slot);
  }
  for (const NamedSlot& slot : state.media) {
    if (slot.second.defined) continue;
    if (IsUsed(state.scene, slot.second.index)) {
      medium = first(medium, slot);
    } else {
      state.AddWarning(slot.second.where, "medium {} is not defined; vacuum is used",
                       Quoted(slot.first));
    }
  }
  RequireDefined(object, "object", state.objects);
  RequireDefined(medium, "named medium", state.media);
}

}  // namespace lanelight
