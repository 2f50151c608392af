// Colours and indices of surfaces at the wavelengths of their paths. Shading kernels read
// them where they read textured ones.
#include "kernels/simd/each_target-inl.h"

#include "kernels/queue/batch-inl.h"
#include "kernels/texture/coated_base-inl.h"
#include "kernels/texture/wavelengths-inl.h"
#include "src/scene/compiled/materials.h"
#include "src/vocabulary/path/wave.h"

LANELIGHT_BEGIN_KERNELS

// One colour parameter of materials: its columns, and which spectra it has.
struct ColorColumns {
  float *r, *g, *b;
  const AlignedVector<int32_t>* spectrum;
};

template <class Body>
LANELIGHT_INLINE void ForEachColor(const Wave& wave, const Body& body) {
  const PathColumns& p = wave.path;
  const MaterialTable& m = *wave.materials;
  body(ColorColumns{p.color0_r, p.color0_g, p.color0_b, &m.color0_spectrum});
  if (p.color1_r != nullptr) {
    body(ColorColumns{p.color1_r, p.color1_g, p.color1_b, &m.color1_spectrum});
  }
  if (p.coat_albedo_r != nullptr) {
    body(ColorColumns{p.coat_albedo_r, p.coat_albedo_g, p.coat_albedo_b,
                      &m.coat_albedo_spectrum});
  }
}

void Spectra(Wave& wave) {
  const SpectrumTable& table = *wave.spectra;
  ForEachBatch(wave, wave.queue(QueueId::kSurface),
               [&](const StoreSlots& slots, MF) HWY_ATTR {
                 const Wavelengths at(wave.path, slots);
                 const VI material = Gather(wave.path.material, slots);
                 ForEachColor(wave, [&](const ColorColumns& c) HWY_ATTR {
                   const V3 color = AtRows(table, Lookup(*c.spectrum, material), at);
                   Scatter3(color, c.r, c.g, c.b, slots);
                 });
               });
}

// r of a metal of that extinction k, as MetalExtinction() but relative to `index`.
LANELIGHT_INLINE V3 HeadOn(V3 k, VF index) {
  const V3 ratio = Mul(k, hn::Div(Splat(1.0f), index));
  const V3 square = Mul(ratio, ratio);
  const auto r = [](VF s) HWY_ATTR { return hn::Div(s, hn::Add(s, Splat(4.0f))); };
  return {r(square.x), r(square.y), r(square.z)};
}

// Returns values of textures at the wavelengths of the paths. `kind`: PathColor.
LANELIGHT_INLINE V3 Upsampled(const SceneParts& scene, VI kind, VI material, V3 color,
                              const Wavelengths& at) {
  const DF df;
  const SpectrumTable& table = *scene.spectra;
  const auto is = [&](PathColor k) HWY_ATTR {
    return hn::RebindMask(df, hn::Eq(kind, hn::Set(DI(), static_cast<int32_t>(k))));
  };
  const MF metal = is(PathColor::kMetalExtinction), unbounded = is(PathColor::kUnbounded);
  const MF scaled = is(PathColor::kScaledReflectance);
  if (hn::AllFalse(df, hn::Or(scaled, hn::Or(metal, unbounded)))) {
    return UpsampledReflectances(table, color, at);
  }
  const VF index =
      hn::IfThenElse(metal, Lookup(scene.materials->color0_r, material), Splat(1.0f));
  const V3 reflectance = IfThenElse(metal, HeadOn(color, index), color);
  V3 value = UpsampledReflectances(table, reflectance, at);
  if (!hn::AllFalse(df, scaled)) {
    const VF scale = Lookup(scene.materials->color_scale, material), one = Splat(1.0f);
    const V3 product = Mul(value, scale);
    value = IfThenElse(
        scaled,
        {hn::Min(product.x, one), hn::Min(product.y, one), hn::Min(product.z, one)},
        value);
  }
  return IfThenElse(unbounded, UpsampledColors(table, color, at),
                    IfThenElse(metal, Mul(MetalExtinction(value), index), value));
}

// Textures, and constants beside them.
void TextureSpectra(Wave& wave) {
  const SceneParts& scene = wave;
  ForEachBatch(
      wave, wave.queue(QueueId::kSurface), [&](const StoreSlots& slots, MF) HWY_ATTR {
        const Wavelengths at(wave.path, slots);
        const VI material = Gather(wave.path.material, slots);
        ForEachColor(wave, [&](const ColorColumns& c) HWY_ATTR {
          const VI row = Lookup(*c.spectrum, material);
          const auto constant = hn::Gt(row, hn::Set(DI(), -1));
          V3 color = AtRows(*scene.spectra, hn::IfThenElseZero(constant, row), at);
          if (!hn::AllTrue(DI(), constant)) {
            const V3 textured =
                Upsampled(scene, row, material, Gather3(c.r, c.g, c.b, slots), at);
            color = IfThenElse(hn::RebindMask(DF(), constant), color, textured);
          }
          Scatter3(color, c.r, c.g, c.b, slots);
        });
      });
}

// Glass whose index depends on the wavelength leaves a path one of its three, chosen
// uniformly, with the weight of all.
void Disperse(Wave& wave) {
  const PathColumns& p = wave.path;
  const MaterialTable& m = *wave.materials;
  ForEachBatch(
      wave, wave.queue(QueueId::kSurface), [&](const StoreSlots& slots, MF) HWY_ATTR {
        const VI material = Gather(p.material, slots);
        const VI row = Lookup(m.eta_spectrum, material);
        const auto some = hn::Gt(row, hn::Set(DI(), -1));
        const MF disperses = hn::RebindMask(DF(), some);
        const Wavelengths at(p, slots);
        const VF index = IndexAt(*wave.spectra, hn::IfThenElseZero(some, row), at);
        Scatter(hn::IfThenElse(disperses, index, Lookup(m.eta, material)), p.eta, slots);
        const MF leaves = hn::AndNot(at.alone, disperses);
        const V3 beta = Gather3(p.beta_r, p.beta_g, p.beta_b, slots);
        const auto left = [&](VF b, int32_t hero) HWY_ATTR {
          const auto is = hn::RebindMask(DF(), hn::Eq(at.hero, hn::Set(DI(), hero)));
          return hn::IfThenElseZero(is, hn::Mul(b, Splat(3.0f)));
        };
        const V3 one = {left(beta.x, 2), left(beta.y, 1), left(beta.z, 0)};
        Scatter3(IfThenElse(leaves, one, beta), p.beta_r, p.beta_g, p.beta_b, slots);
        const VF number = Gather(p.wavelength, slots);
        const VF marked = hn::CopySign(number, Splat(-1.0f));
        Scatter(hn::IfThenElse(leaves, marked, number), p.wavelength, slots);
      });
}

constexpr FieldSet kSpectralColors = {
    Field::color0_r,      Field::color0_g,      Field::color0_b,
    Field::color1_r,      Field::color1_g,      Field::color1_b,
    Field::coat_albedo_r, Field::coat_albedo_g, Field::coat_albedo_b};

Stage SpectraStage() {
  return {.name = "spectra",
          .meaning = "converts colours of surfaces to wavelengths of paths",
          .input = QueueId::kSurface,
          .role = StageRole::kTexture,
          .needs = {Feature::kPlainSpectra, Feature::kScatters},
          .reads = {Field::material, Field::wavelength},
          .writes = kSpectralColors,
          .resolve = Always<Spectra>};
}

Stage TextureSpectraStage() {
  return {.name = "texture_spectra",
          .meaning = "converts textured colours to wavelengths of paths",
          .input = QueueId::kSurface,
          .role = StageRole::kTexture,
          .needs = {Feature::kSpectral, Feature::kTextures, Feature::kScatters},
          .reads = kSpectralColors | FieldSet{Field::material, Field::wavelength},
          .writes = kSpectralColors,
          .resolve = Always<TextureSpectra>};
}

Stage DisperseStage() {
  return {.name = "disperse",
          .meaning = "computes dispersed indices of glass; leaves one wavelength",
          .input = QueueId::kSurface,
          .role = StageRole::kTexture,
          .needs = {Feature::kDispersion, Feature::kScatters},
          .reads = fields::kThroughput | FieldSet{Field::material, Field::wavelength},
          .writes = fields::kThroughput | FieldSet{Field::eta, Field::wavelength},
          .resolve = Always<Disperse>};
}

LANELIGHT_END_KERNELS
