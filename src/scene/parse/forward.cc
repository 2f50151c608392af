#include "src/scene/parse/forward.h"

#include <fmt/format.h>

#include "src/scene/parse/parse_state.h"

namespace lanelight {
namespace {

const char* KindName(NameKind kind) {
  if (kind == NameKind::kFloatTexture) return "float texture";
  return kind == NameKind::kSpectrumTexture ? "spectrum texture" : "named material";
}

// Sizes of the lists to which interpreters append.
struct Mark {
  explicit Mark(const ParseState& state)
      : notes(state.scene.notes.size()),
        textures(state.scene.textures.size()),
        media(state.scene.media.size()),
        objects(state.scene.objects.size()),
        meshes(state.meshes.size()),
        open_object(state.open_object) {}

  void Restore(ParseState& state) const {
    for (std::size_t i = notes; i < state.scene.notes.size(); ++i) {
      state.noted.erase(state.scene.notes[i].message);
    }
    state.scene.notes.resize(notes);
    state.scene.textures.resize(textures);
    state.scene.media.resize(media);
    state.scene.objects.resize(objects);
    state.meshes.erase(state.meshes.begin() + static_cast<std::ptrdiff_t>(meshes),
                       state.meshes.end());
    state.open_object = open_object;
  }

  std::size_t notes, textures, media, objects, meshes;
  Index open_object;
};

void Wait(ParseState& state, WaitingStatement statement) {
  const std::size_t place = statement.place;
  state.waiters[statement.needs.key].push_back(place);
  state.waiting.emplace(place, std::move(statement));
}

// Replaces the current state by that of a statement while it lives.
class InItsState {
 public:
  InItsState(ParseState& state, const WaitingStatement& statement)
      : state_(state), graphics_(std::move(state.graphics)), object_(state.open_object) {
    state.graphics = statement.graphics;
    state.open_object = statement.open_object;
    state.open_files.push_back(statement.file);
  }
  ~InItsState() {
    state_.open_files.pop_back();
    state_.open_object = object_;
    state_.graphics = std::move(graphics_);
  }

 private:
  ParseState& state_;
  GraphicsState graphics_;
  Index object_;
};

[[noreturn]] void ThrowUndefined(const ParseState& state, const NameUse& use) {
  const auto& [kind, name] = use.key;
  const bool is_float = kind == NameKind::kFloatTexture;
  const NameKind other = is_float ? NameKind::kSpectrumTexture : NameKind::kFloatTexture;
  if (kind != NameKind::kMaterial && state.declared.contains({other, name})) {
    throw InputError(use.where, "texture {} is not a {}", Quoted(name), KindName(kind));
  }
  std::vector<std::string> known;
  for (const NameKey& key : state.declared) {
    if (key.first == kind) known.push_back(key.second);
  }
  ThrowNotDefined(use.where, KindName(kind), name, known);
}

}  // namespace

Index Resolve(const ParseState& state, const NameUse& use) {
  const auto found = state.names.find(use.key);
  if (found == state.names.end()) throw use;
  return found->second;
}

void Define(ParseState& state, const NameKey& key, Index index) {
  state.names[key] = index;
  const auto waiters = state.waiters.find(key);
  if (waiters == state.waiters.end()) return;
  state.ready.insert(state.ready.end(), waiters->second.begin(), waiters->second.end());
  state.waiters.erase(waiters);
}

void RunOrWait(ParseState& state, const NameKey* defines,
               std::function<void(ParseState&)> run) {
  if (defines != nullptr) state.declared.insert(*defines);
  const Mark mark(state);
  try {
    run(state);
  } catch (const NameUse& use) {
    mark.Restore(state);
    Wait(state, {state.statements_waited++, std::move(run), use,
                 defines == nullptr ? std::nullopt : std::optional(*defines),
                 state.graphics, state.open_object, state.open_files.back()});
  }
}

void RunReady(ParseState& state) {
  while (!state.ready.empty()) {
    const auto entry = state.waiting.extract(state.ready.front());
    state.ready.pop_front();
    WaitingStatement& statement = entry.mapped();
    const InItsState its(state, statement);
    const Mark mark(state);
    try {
      statement.run(state);
    } catch (const NameUse& use) {
      mark.Restore(state);
      statement.needs = use;
      Wait(state, std::move(statement));
    }
  }
}

void RequireAllResolved(const ParseState& state) {
  if (state.waiting.empty()) return;
  std::map<NameKey, const WaitingStatement*> definitions;
  for (const auto& [place, statement] : state.waiting) {
    if (statement.defines) definitions[*statement.defines] = &statement;
  }
  // Follows the needs of the first statement.
  const WaitingStatement* at = &state.waiting.begin()->second;
  for (std::size_t steps = 0; steps <= definitions.size(); ++steps) {
    const auto next = definitions.find(at->needs.key);
    if (next == definitions.end()) ThrowUndefined(state, at->needs);
    at = next->second;
  }
  throw InputError(at->needs.where, "{} {} is defined by itself",
                   KindName(at->needs.key.first), Quoted(at->needs.key.second));
}

}  // namespace lanelight
