#include "src/scene/compile/media.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "src/base/core/check.h"
#include "src/base/image/spectrum.h"
#include "src/scene/compile/focus.h"
#include "src/scene/compile/materials.h"
#include "src/scene/compile/textures.h"
#include "src/scene/compile/world_frame.h"

namespace lanelight {
namespace {

std::int32_t PhaseFunction(const Medium& medium, CompiledMaterials& materials) {
  MaterialRow row;
  row.kind = ShadeKind::kHenyeyGreenstein;
  row.eta = medium.g;
  row.name = medium.name;
  AddMaterialRow(row, materials);
  return static_cast<std::int32_t>(materials.table.size()) - 1;
}

// Sets coefficients per unit of scene length. An extinction beyond float32 is replaced by
// the largest one that kernels can square, which transmits no light either.
void SetCoefficients(const Medium& m, double scale, MediumRecord& record) {
  const Rgb extinction = m.sigma_a + m.sigma_s;
  for (int c = 0; c < 3; ++c) {
    const double unit = std::min(1 / scale, kFarthestInScene / extinction[c]);
    record.sigma_t[c] = static_cast<float>(extinction[c] * unit);
    record.sigma_s[c] = static_cast<float>(m.sigma_s[c] * unit);
    record.emission[c] = static_cast<float>(m.sigma_a[c] * m.emission[c] * unit);
  }
}

// Returns the emission of a medium per unit of absorption, in units of D65.
std::vector<float> EmissionOf(const Medium& m) {
  if (m.emission_spectrum == nullptr || m.emission == Rgb{}) {
    return BinValues(UpsampledColor(m.emission));
  }
  std::vector<float> values = LightValues(m.emission, m.emission_spectrum);
  const double luminance = Luminance(m.emission);
  for (float& v : values) v = static_cast<float>(double(v) * luminance);
  return values;
}

// Limits extinction times the densities of a grid to what kernels can square.
void LimitDensity(const MediumGrid& grid, MediumRecord& record) {
  double largest = 0;
  for (const float majorant : grid.majorants)
    largest = std::max<double>(largest, majorant);
  const double maximum =
      std::max({record.sigma_t[0], record.sigma_t[1], record.sigma_t[2]});
  const double factor = std::min(1.0, kFarthestInScene / (maximum * largest));
  for (int c = 0; c < 3; ++c) {
    record.sigma_t[c] = static_cast<float>(record.sigma_t[c] * factor);
    record.sigma_s[c] = static_cast<float>(record.sigma_s[c] * factor);
  }
}

class MediumBuilder {
 public:
  MediumBuilder(const SceneDescription& d, const WorldFrame& frame,
                CompiledMaterials& materials)
      : d_(d), frame_(frame), materials_(materials), index_(d.media.size(), kVacuum) {}

  std::int32_t Use(Index medium) {
    if (medium == kNone) return kVacuum;
    LL_CHECK_LT(static_cast<std::size_t>(medium), index_.size());
    std::int32_t& at = index_[static_cast<std::size_t>(medium)];
    if (at != kVacuum) return at;
    const Medium& m = d_.media[static_cast<std::size_t>(medium)];
    MediumRecord record = {};
    SetCoefficients(m, frame_.scale, record);
    record.inside = m.in_material ? 1 : 0;
    record.albedos = -1;
    if (m.by_reflectance) SetAlbedo(m, record);
    record.scatters = m.sigma_s != Rgb{};
    record.material = static_cast<std::uint32_t>(PhaseFunction(m, materials_));
    record.grid = -1;
    if (m.kind != MediumKind::kHomogeneous) {
      record.grid = static_cast<std::int32_t>(table_.grids.size());
      Store(m.emission, record.emission);
      const auto transport =
          materials_.spectra == nullptr ? Transport::kRgb : Transport::kSpectral;
      table_.grids.push_back(CompileMediumGrid(m, frame_, transport));
      LimitDensity(table_.grids.back(), record);
    }
    if (materials_.spectra != nullptr) AddSpectra(m, record);
    table_.media.push_back(record);
    return at = static_cast<std::int32_t>(table_.media.size()) - 1;
  }

  // Sets the scattering coefficient from the reflectance.
  void SetAlbedo(const Medium& m, MediumRecord& record) {
    const SlabAlbedos albedos(m.g, m.eta);
    const ColorValue reflectance = TextureConstants(d_.textures).Fold(m.reflectance);
    if (reflectance.texture == kNone) {
      for (int c = 0; c < 3; ++c) {
        const double albedo = albedos.Of(reflectance.constant[c]);
        record.sigma_s[c] = static_cast<float>(record.sigma_t[c] * albedo);
      }
      return;
    }
    record.albedos = static_cast<std::int32_t>(table_.albedos.size());
    for (int i = 0; i < kAlbedoTableSize; ++i) {
      const double r = i / (kAlbedoTableSize - 1.0);
      table_.albedos.push_back(static_cast<float>(albedos.Of(r)));
    }
  }

  // Does for each bin of wavelengths what SetCoefficients and SetAlbedo do for RGB.
  void AddSpectra(const Medium& m, MediumRecord& record) {
    std::vector<float> t = BinValues(UpsampledColor(m.sigma_a));
    std::vector<float> s = BinValues(UpsampledColor(m.sigma_s));
    std::vector<float> e = EmissionOf(m);
    // The scale of the record, if the file's numbers are in the range of float32.
    const Rgb extinction = m.sigma_a + m.sigma_s;
    int maximum = 0;
    for (int c = 1; c < 3; ++c) {
      if (extinction[c] > extinction[maximum]) maximum = c;
    }
    const double unit = extinction[maximum] > 0
                            ? double(record.sigma_t[maximum]) / extinction[maximum]
                            : 0;
    std::optional<SlabAlbedos> albedos;
    std::vector<float> reflectance;
    if (m.by_reflectance) {
      albedos.emplace(m.g, m.eta);
      reflectance = BinValues(UpsampledReflectance(m.reflectance.constant));
    }
    for (std::size_t b = 0; b < t.size(); ++b) {
      const double absorbed = double(t[b]) * unit, scattered = double(s[b]) * unit;
      const double albedo = albedos ? albedos->Of(double(reflectance[b])) : 1;
      t[b] = static_cast<float>(absorbed + scattered);
      s[b] = static_cast<float>(scattered * albedo);
      if (record.grid < 0) e[b] = static_cast<float>(double(e[b]) * absorbed);
    }
    if (record.grid < 0 || !table_.grids[std::size_t(record.grid)].emission.heated()) {
      record.spectra = materials_.spectra->Append({t, s, e});
      return;
    }
    const std::vector<float> units = UnitsOfBlackbody();
    for (std::size_t b = 0; b < e.size(); ++b) e[b] *= units[b];
    const std::vector<float> planck =
        BinValues([](double nm) { return kSecondRadiation / nm; });
    record.spectra = materials_.spectra->Append({t, s, e, planck});
  }

  MediumTable Finish(const Placement& placement, std::vector<Note>& notes) {
    NoteDenseMedia(d_, placement, table_, index_, notes);
    return std::move(table_);
  }

 private:
  const SceneDescription& d_;
  const WorldFrame& frame_;
  CompiledMaterials& materials_;
  std::vector<std::int32_t> index_;
  MediumTable table_;
};

}  // namespace

MediumTable CompileMedia(const SceneDescription& d, const Placement& placement,
                         CompiledMaterials& materials, std::vector<Note>& notes) {
  MediumBuilder builder(d, placement.frame, materials);
  const std::int32_t camera = builder.Use(d.camera.medium);
  std::vector<MediumSides> sides;
  ForEachPlaced(placement, [&](const PlacedShape& placed) {
    const MediumInterface& media = placed.shape->media;
    if (!media.IsTransition()) return;
    const bool passes =
        d.materials[static_cast<std::size_t>(placed.shape->material)].kind ==
        MaterialKind::kInterface;
    sides.push_back(
        {builder.Use(media.inside), builder.Use(media.outside), passes ? 1u : 0u, 0});
  });
  MediumTable table = builder.Finish(placement, notes);
  table.camera = camera;
  table.sides.assign(sides.begin(), sides.end());
  DropUnusedBumpMaps(materials.table);  // phase functions have none
  return table;
}

void PlaceMedia(const Placement& placement, const CompiledGeometry& compiled,
                MediumTable& table) {
  if (table.sides.empty()) return;
  // Kernels look at one even where rays can hit nothing.
  table.primitives.assign(std::max(compiled.geometry.ranges.end, 1u), -1);
  std::int32_t next = 0;
  ForEachCompiled(placement, compiled,
                  [&](const PlacedShape& placed, std::uint32_t begin, std::uint32_t end) {
                    if (!placed.shape->media.IsTransition()) return;
                    std::fill(table.primitives.begin() + begin,
                              table.primitives.begin() + end, next);
                    ++next;
                  });
}

}  // namespace lanelight
