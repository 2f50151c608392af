// Paths that carry wavelengths against the scalar tracer, which renders each triple of
// wavelengths by itself.
#pragma once

#include "src/base/image/measured_reflectance.h"
#include "src/scene/compile/spectrum_rows.h"
#include "tests/agreement/agreement.h"

namespace lanelight::test {

inline SceneDescription Spectral(SceneDescription scene) {
  scene.integrator.transport = Transport::kSpectral;
  return scene;
}

inline OwnSpectrum Own(const Spectrum& spectrum) {
  return std::make_shared<const Spectrum>(spectrum);
}

inline double LargestDifference(const stat::ImageEstimate& a,
                                const stat::ImageEstimate& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.mean.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      largest = std::max(largest, std::abs(a.mean[i][c] - b.mean[i][c]));
    }
  }
  return largest;
}

// Returns the film's colour of light in units of D65.
inline Rgb FilmRgb(const Spectrum& light) {
  Rgb sum;
  for (double nm = 380.125; nm < 780; nm += 0.25)
    sum += WhiteFraction(nm) * light(nm) / 4;
  return sum;
}

// What the description is for the long, the middle and the short wavelength of a triple,
// in the channels red, green and blue.
struct AtTriple {
  int triple;

  Rgb Of(const Spectrum& spectrum) const {
    const auto& centre = CarriedWavelengths().centre;
    return {spectrum(centre[2 * kTriples + triple]), spectrum(centre[kTriples + triple]),
            spectrum(centre[triple])};
  }
  void Reflect(ColorValue& color) const {
    color.constant =
        Of(color.spectrum ? *color.spectrum : UpsampledReflectance(color.constant));
  }
  void Index(ColorValue& color) const {
    if (color.spectrum) color.constant = Of(*color.spectrum);
  }
  Rgb Light(Rgb color, const OwnSpectrum& own) const {
    if (!own) return Of(UpsampledColor(color));
    const Spectrum d65 = DaylightD65();
    const auto in_d65 = [&](double nm) { return (*own)(nm) / d65(nm); };
    return Of(in_d65) * (Luminance(color) / Luminance(ColorOfBins(BinMeans(in_d65))));
  }
  // Sets the colours of voxels.
  void Voxels(std::vector<float>& colors) const {
    for (std::size_t v = 0; v < colors.size(); v += 3) {
      const Rgb at = Of(UpsampledColor({colors[v], colors[v + 1], colors[v + 2]}));
      for (int c = 0; c < 3; ++c) {
        colors[v + static_cast<std::size_t>(c)] = static_cast<float>(at[c]);
      }
    }
  }
  // Three slices of a file's wavelengths for each.
  std::shared_ptr<const MeasuredReflectance> Tables(const MeasuredReflectance& m) const {
    MeasuredReflectance out = m;
    const MeasuredSpectra file = ReadMeasuredSpectra(m);
    const auto size =
        static_cast<std::size_t>(m.reflectance.width * m.reflectance.height);
    const std::size_t count = file.nm.size();
    for (std::size_t i = 0; i < out.reflectance.values.size(); ++i) {
      const std::size_t slice = i / size / 3, channel = i / size % 3;
      std::vector<double> values;
      for (std::size_t w = 0; w < count; ++w) {
        values.push_back(file.reflectance.values[(slice * count + w) * size + i % size]);
      }
      const Spectrum spectrum = Interpolated(file.nm, values, true);
      const auto bin = (2 - channel) * kTriples + static_cast<std::size_t>(triple);
      out.reflectance.values[i] =
          static_cast<float>(spectrum(CarriedWavelengths().centre[bin]));
    }
    return std::make_shared<const MeasuredReflectance>(out);
  }
  SceneDescription operator()(SceneDescription scene) const {
    for (Material& m : scene.materials) {
      if (m.measured) m.measured = Tables(*m.measured);
      Reflect(m.reflectance);
      Reflect(m.transmittance);
      Index(m.eta);
      Index(m.k);
      m.sigma_a =
          Of(m.sigma_a_spectrum ? *m.sigma_a_spectrum : UpsampledColor(m.sigma_a));
    }
    for (lanelight::Light& light : scene.lights) {
      light.emission = Light(light.emission, light.spectrum);
    }
    for (Medium& medium : scene.media) {
      medium.sigma_a = Of(UpsampledColor(medium.sigma_a));
      medium.sigma_s = Of(UpsampledColor(medium.sigma_s));
      medium.emission = Light(medium.emission, medium.emission_spectrum);
      if (medium.kind != MediumKind::kRgbGrid) continue;
      Voxels(medium.grid);
      Voxels(medium.emission_grid);
    }
    for (AreaLight& light : scene.area_lights) {
      light.radiance = Light(light.radiance, light.spectrum);
    }
    return scene;
  }
};

// Mean over triples that lie evenly.
inline stat::ImageEstimate SpectralReference(const SceneDescription& scene, int samples) {
  constexpr int kEvery = 4, kCount = kTriples / kEvery;
  stat::ImageEstimate out;
  for (int i = kEvery / 2; i < kTriples; i += kEvery) {
    TwinOptions options = Options(ReferenceEstimator::kLightSampling, samples);
    options.seed = static_cast<std::uint64_t>(i) + 1;
    const auto one = Estimate(RenderReference(AtTriple{i}(scene), options));
    if (out.mean.empty()) out = {one.width, one.height, 0, {}, {}};
    out.mean.resize(one.mean.size());
    out.variance.resize(one.mean.size());
    out.observations += one.observations;
    const auto& film = CarriedWavelengths().film;
    const Rgb f[3] = {film[2 * kTriples + i], film[kTriples + i], film[i]};
    for (std::size_t p = 0; p < one.mean.size(); ++p) {
      for (int k = 0; k < 3; ++k) {
        out.mean[p] += f[k] * (one.mean[p][k] / kCount);
        // The channels of a sample go up and down together: their errors may add up.
        out.variance[p] += f[k] * f[k] * (3 * one.variance[p][k] / kCount / kCount);
      }
    }
  }
  return out;
}

}  // namespace lanelight::test
