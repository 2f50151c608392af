#include "src/stress/cases/transport_scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lanelight::stress {

std::string Walls(double emission, double albedo) {
  return fmt::format(
      "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [{0:.17g} {0:.17g} "
      "{0:.17g}]\nReverseOrientation\nMaterial {1}\nShape \"sphere\" \"float radius\" "
      "4\nAttributeEnd\n",
      emission, Diffuse(albedo));
}

std::string Room(double emission, double albedo) {
  return ViewFrom({0.2, 0.3, 3}, 50) + Walls(emission, albedo);
}

std::string Sheets(double transmitted) {
  std::string text = ViewOfPlane() + Sky(1);
  double left = transmitted;
  for (int i = 0; i == 0 || left < 1; ++i) {
    const double share = std::max(left, 1e-3);
    left /= share;
    text += fmt::format(
        "AttributeBegin\nTranslate 0 0 {0:.17g}\nMaterial \"diffusetransmission\" \"rgb "
        "reflectance\" [0 0 0] \"rgb transmittance\" [{1:.17g} {1:.17g} {1:.17g}]\nShape "
        "\"plane\"\nAttributeEnd\n",
        -0.1 * i, share);
    if (left > 1 - 1e-9) break;
  }
  return text;
}

LightRing RingOfLights(int lights) {
  LightRing ring;
  ring.text = ViewOfPlane() + Plane(Diffuse(0.5));
  double sum = 0;
  for (int i = 0; i < lights; ++i) {
    const double turn = 2 * std::numbers::pi * i / lights;
    // A golden step through the decades: neighbours differ.
    const double step = std::fmod(i * 0.6180339887498949, 1);
    const double intensity = std::pow(10, 6 * step - 3) / lights;
    sum += intensity;
    ring.text += fmt::format(
        "LightSource \"point\" \"point3 from\" [{} {} 0.8] \"rgb I\" [{} {} {}]\n",
        0.6 * std::cos(turn), 0.6 * std::sin(turn), intensity, intensity, intensity);
  }
  ring.expected = 0.5 / std::numbers::pi * 0.8 * sum;
  return ring;
}

}  // namespace lanelight::stress
