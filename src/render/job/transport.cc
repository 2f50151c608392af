#include "src/render/job/transport.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "src/base/image/wavelengths.h"
#include "src/scene/compile/spectrum_rows.h"

namespace lanelight {
namespace {

std::vector<Index> MaterialsOf(const SceneDescription& scene) {
  std::vector<Index> used;
  for (const Shape& shape : scene.shapes) used.push_back(shape.material);
  for (const ObjectDefinition& object : scene.objects) {
    for (const Shape& shape : object.shapes) used.push_back(shape.material);
  }
  std::ranges::sort(used);
  used.erase(std::unique(used.begin(), used.end()), used.end());
  return used;
}

bool EmitsCarried(const OwnSpectrum& spectrum) {
  if (spectrum == nullptr) return true;
  for (int nm = kFirstCarriedNm; nm <= kLastCarriedNm; ++nm) {
    if ((*spectrum)(nm) > 0) return true;
  }
  return false;
}

// Why these strategies do not go with wavelengths; empty if they do.
std::string ReasonForRgb(std::span<const Strategy> strategies, bool disperses) {
  for (const Strategy& s : strategies) {
    if (s.reuse != Reuse::kNone && disperses) {
      return "reuse=block does not support dispersive glass";
    }
  }
  return "";
}

// Says why the scene does not go with wavelengths; empty if it does.
std::string ReasonForRgb(const SceneDescription& scene) {
  const auto dark = [](const auto& light) { return !EmitsCarried(light.spectrum); };
  if (std::ranges::any_of(scene.lights, dark) ||
      std::ranges::any_of(scene.area_lights, dark) ||
      std::ranges::any_of(scene.media, [](const Medium& m) {
        return m.emission != Rgb{} && !EmitsCarried(m.emission_spectrum);
      })) {
    return fmt::format("a light emits nothing from {} to {} nm", kFirstCarriedNm,
                       kLastCarriedNm);
  }
  return "";
}

}  // namespace

TransportChoice ChooseTransport(const SceneDescription& scene,
                                std::span<const Strategy> strategies) {
  const std::vector<Index> used = MaterialsOf(scene);
  const std::optional<SpectrumUser> user = FindSpectrum(scene, used);
  if (!user) return {.why = "nothing in the scene has a spectrum"};
  const std::string has =
      user->what + (user->disperses ? " disperses" : " has a spectrum");
  std::string refusal = ReasonForRgb(strategies, user->disperses);
  if (refusal.empty()) refusal = ReasonForRgb(scene);
  if (refusal.empty()) return {Transport::kSpectral, has, {}, false};
  return {Transport::kRgb, fmt::format("{}, though {}", refusal, has), user->where, true};
}

}  // namespace lanelight
