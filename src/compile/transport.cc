#include "src/compile/transport.h"

#include <algorithm>
#include <iterator>

namespace lanelight {
namespace {

// Of a scene with this film.
struct Refusal {
  const Film& film;

  [[noreturn]] void operator()(const SourceLocation& where,
                               const std::string& what) const {
    throw InputError(where, what + " is not supported with --transport spectral yet; " +
                                (film.buckets.count > 0 ? "with Film \"rgb\", " : "") +
                                "--transport rgb renders it");
  }
};

bool IsGrey(Rgb c) { return c.x == c.y && c.y == c.z; }

void CheckMedium(const Medium& medium, const Refusal& refuse) {
  const std::string name = medium.name.empty() ? "" : " \"" + medium.name + "\"";
  if (medium.kind == MediumKind::kRgbGrid) {
    refuse(medium.where, "the medium" + name + " of type \"rgbgrid\"");
  }
  const bool heated = !medium.temperature.empty() || medium.sparse_temperature != nullptr;
  const bool varies = medium.kind != MediumKind::kHomogeneous;
  if (heated || (varies && !IsGrey(medium.emission))) {
    refuse(medium.where, "the medium" + name + ", which emits coloured light,");
  }
}

// The materials that shapes have, and those that they mix; mixes may be nested deeply.
template <class Visit>
void ForEachUsed(const SceneDescription& d, std::vector<Index> open, const Visit& visit) {
  std::vector<bool> seen(d.materials.size());
  while (!open.empty()) {
    const auto at = static_cast<std::size_t>(open.back());
    open.pop_back();
    if (seen[at]) continue;
    seen[at] = true;
    const Material& m = d.materials[at];
    visit(m);
    if (m.kind == MaterialKind::kMix) open.insert(open.end(), m.mix, m.mix + 2);
  }
}

std::string NameOf(const Material& m) {
  const std::string kind = m.dispersion != nullptr          ? "glass"
                           : m.eta.spectrum || m.k.spectrum ? "metal"
                                                            : "material";
  return "the " + kind + (m.name.empty() ? "" : " \"" + m.name + "\"");
}

bool HasSpectrum(const Material& m) {
  const ColorValue* const colors[] = {&m.reflectance, &m.transmittance, &m.eta, &m.k,
                                      &m.coat_albedo};
  return m.dispersion != nullptr ||
         std::any_of(std::begin(colors), std::end(colors),
                     [](const ColorValue* c) { return c->spectrum != nullptr; });
}

}  // namespace

std::optional<SpectrumUser> FindSpectrum(const SceneDescription& description,
                                         const std::vector<Index>& used) {
  std::optional<SpectrumUser> found;
  ForEachUsed(description, used, [&](const Material& m) {
    const bool disperses = m.dispersion != nullptr;
    if (found ? found->disperses || !disperses : !HasSpectrum(m)) return;
    found = {m.where, NameOf(m), disperses};
  });
  const auto add = [&](const auto& light, const char* what) {
    if (!found && light.spectrum != nullptr) found = {light.where, what};
  };
  for (const Light& light : description.lights) add(light, "a light");
  for (const AreaLight& light : description.area_lights) add(light, "an area light");
  return found;
}

void CheckTransport(const SceneDescription& description, const std::vector<Index>& used) {
  const Refusal refuse = {description.film};
  for (const Medium& medium : description.media) CheckMedium(medium, refuse);
  ForEachUsed(description, used, [&](const Material& m) {
    if (m.kind == MaterialKind::kMeasured) refuse(m.where, "the material \"measured\"");
  });
}

void NoteDispersion(const SceneDescription& description, const std::vector<Index>& used,
                    std::vector<Note>& notes) {
  const Material* found = nullptr;
  ForEachUsed(description, used, [&](const Material& m) {
    if (m.dispersion != nullptr) found = &m;
  });
  if (found == nullptr) return;
  notes.push_back({found->where,
                   "dispersion is not modelled: eta is taken at 587.6 nm; --transport "
                   "spectral models it"});
}

}  // namespace lanelight
