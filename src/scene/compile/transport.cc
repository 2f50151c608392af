#include "src/scene/compile/transport.h"

#include <algorithm>
#include <iterator>

namespace lanelight {
namespace {

// Whether the light that a medium emits has a spectrum.
bool HasSpectrum(const Medium& m) {
  return m.emission != Rgb{} &&
         (m.emission_spectrum != nullptr || !m.temperature.empty() ||
          m.sparse_temperature != nullptr);
}

// Those that shapes bound, and the camera's.
std::vector<Index> MediaOf(const SceneDescription& d) {
  std::vector<Index> media = {d.camera.medium};
  const auto add = [&](const std::vector<Shape>& shapes) {
    for (const Shape& shape : shapes) {
      media.insert(media.end(), {shape.media.inside, shape.media.outside});
    }
  };
  add(d.shapes);
  for (const ObjectDefinition& object : d.objects) add(object.shapes);
  std::erase(media, kNone);
  return media;
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
  return m.dispersion != nullptr || m.measured != nullptr ||
         m.sigma_a_spectrum != nullptr ||
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
  for (const Index i : MediaOf(description)) {
    const Medium& m = description.media[static_cast<std::size_t>(i)];
    if (!found && HasSpectrum(m)) {
      found = {m.where, "the light of the medium \"" + m.name + "\""};
    }
  }
  return found;
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
