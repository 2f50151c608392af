// Media and objects that may be used before they are defined.
#include <fmt/format.h>

#include "src/scene/parse/forward.h"
#include "src/scene/parse/parse_state.h"

namespace lanelight {
namespace {

std::vector<std::string> Defined(const NameSlots& slots) {
  std::vector<std::string> names;
  for (const auto& [name, slot] : slots) {
    if (slot.defined) names.push_back(name);
  }
  return names;
}

bool Uses(const MediumInterface& media, Index medium) {
  return media.inside == medium || media.outside == medium;
}

bool IsUsed(const SceneDescription& scene, Index medium) {
  const auto uses = [&](const std::vector<Shape>& shapes) {
    return std::any_of(shapes.begin(), shapes.end(),
                       [&](const Shape& shape) { return Uses(shape.media, medium); });
  };
  return scene.camera.medium == medium || uses(scene.shapes) ||
         std::any_of(scene.objects.begin(), scene.objects.end(),
                     [&](const ObjectDefinition& object) { return uses(object.shapes); });
}

}  // namespace

Index UseMedium(ParseState& state, const std::string& name, const SourceLocation& where) {
  NameSlot& slot = state.media[name];
  if (slot.index != kNone) return slot.index;
  slot = {static_cast<Index>(state.scene.media.size()), where};
  state.scene.media.emplace_back();
  state.scene.media.back().name = name;
  state.scene.media.back().where = where;
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
  slot = {static_cast<Index>(state.scene.objects.size()), where};
  state.scene.objects.push_back({name, {}});
  return slot.index;
}

Index DefineObject(ParseState& state, const std::string& name,
                   const SourceLocation& where) {
  const Index index = UseObject(state, name, where);
  bool& defined = state.objects[name].defined;
  if (defined) {
    throw InputError(where, fmt::format("object {} is defined twice", Quoted(name)));
  }
  defined = true;
  return index;
}

void RequireSlotsDefined(ParseState& state) {
  const auto is_earlier = [](const NameSlot& slot, const NameSlot* other) {
    return other == nullptr || slot.index < other->index;
  };
  const std::string *object = nullptr, *medium = nullptr;
  const NameSlot *object_slot = nullptr, *medium_slot = nullptr;
  for (const auto& [name, slot] : state.objects) {
    if (!slot.defined && is_earlier(slot, object_slot)) {
      object = &name, object_slot = &slot;
    }
  }
  for (const auto& [name, slot] : state.media) {
    if (slot.defined) continue;
    if (!IsUsed(state.scene, slot.index)) {
      state.AddWarning(slot.where, fmt::format("medium {} is not defined; nothing is in "
                                               "it",
                                               Quoted(name)));
    } else if (is_earlier(slot, medium_slot)) {
      medium = &name, medium_slot = &slot;
    }
  }
  if (object != nullptr) {
    ThrowNotDefined(object_slot->where, "object", *object, Defined(state.objects));
  }
  if (medium != nullptr) {
    ThrowNotDefined(medium_slot->where, "named medium", *medium, Defined(state.media));
  }
}

}  // namespace lanelight
