#include "src/scene/compile/spectrum_rows.h"

#include <algorithm>
#include <iterator>

#include "src/base/core/check.h"
#include "src/base/core/error.h"

namespace lanelight {

namespace {

std::vector<float> Values(const ColorValue& color, ColorBound bound) {
  const bool reflects = bound == ColorBound::kReflectance;
  if (color.spectrum == nullptr) {
    return BinValues(reflects ? UpsampledReflectance(color.constant)
                              : UpsampledColor(color.constant));
  }
  std::vector<float> values = BinMeans(*color.spectrum);
  if (reflects) {
    for (float& v : values) v = std::clamp(v, 0.0f, 1.0f);
  }
  return values;
}

// Returns whether the light that a medium emits has a spectrum.
bool HasSpectrum(const Medium& m) {
  return m.emission != Rgb{} &&
         (m.emission_spectrum != nullptr || !m.temperature.empty() ||
          m.sparse_temperature != nullptr);
}

// Returns the media that shapes bound, and the camera's.
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

// Visits the used materials and those that they mix. Mixes may be nested deeply.
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
         std::ranges::any_of(colors,
                             [](const ColorValue* c) { return c->spectrum != nullptr; });
}

}  // namespace

std::vector<float> LightValues(Rgb color, const OwnSpectrum& spectrum) {
  std::vector<float> values;
  if (spectrum == nullptr) {
    values = BinValues(UpsampledColor(color / Luminance(color)));
  } else {
    const Spectrum d65 = DaylightD65();
    values = BinMeans([&](double nm) { return (*spectrum)(nm) / d65(nm); });
  }
  // Divides out the unit of the spectrum and the error of the fit.
  const double luminance = Luminance(ColorOfBins(values));
  if (!(luminance > 0)) {
    throw InputError(fmt::format(
        "a light emits nothing from {} to {} nm, which is what --transport spectral "
        "carries; --transport rgb with Film \"rgb\" renders it",
        kFirstCarriedNm, kLastCarriedNm));
  }
  for (float& v : values) v = static_cast<float>(double(v) / luminance);
  return values;
}

SpectrumRows::SpectrumRows() {
  const WavelengthBins& bins = CarriedWavelengths();
  for (int b = 0; b < kWavelengthBins; ++b) {
    for (int c = 0; c < 3; ++c) {
      table_.film[c].push_back(static_cast<float>(bins.film[b][c]));
    }
    table_.place.push_back(static_cast<float>(SigmoidPlace(bins.centre[b])));
  }
}

std::int32_t SpectrumRows::Intern(const std::vector<float>& row) {
  const auto next = static_cast<std::int32_t>(table_.rows.size() / kWavelengthBins);
  const auto [it, is_new] = rows_.try_emplace(row, next);
  if (is_new) table_.rows.insert(table_.rows.end(), row.begin(), row.end());
  return it->second;
}

std::int32_t SpectrumRows::Of(const ColorValue& color, ColorBound bound) {
  LL_CHECK_EQ(color.texture, kNone);
  return Intern(Values(color, bound));
}

std::int32_t SpectrumRows::OfLight(Rgb color, const OwnSpectrum& spectrum) {
  return Intern(LightValues(color, spectrum));
}

std::int32_t SpectrumRows::OfIndex(const Spectrum& index) {
  const WavelengthBins& bins = CarriedWavelengths();
  const std::size_t row = table_.indices.size() / kWavelengthEdges;
  for (double nm : bins.edge) table_.indices.push_back(static_cast<float>(index(nm)));
  return static_cast<std::int32_t>(row);
}

std::int32_t SpectrumRows::Append(std::initializer_list<std::vector<float>> rows) {
  const auto first = static_cast<std::int32_t>(table_.rows.size() / kWavelengthBins);
  for (const std::vector<float>& row : rows) {
    table_.rows.insert(table_.rows.end(), row.begin(), row.end());
  }
  return first;
}

void SpectrumRows::AddSigmoidTables() {
  if (!table_.sigmoids.empty()) return;
  for (const auto& row : PolynomialThrough()) {
    for (double v : row) table_.polynomial.push_back(static_cast<float>(v));
  }
  table_.per_half_tangent = static_cast<float>(1 / HalfTangentOfGrey(1 - kMinUpsampled));
  const std::vector<float>& sigmoids = UpsamplingTable();
  table_.sigmoids.assign(sigmoids.begin(), sigmoids.end());
}

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
