#include "src/measure/stress/cases/scene_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lanelight::stress {

std::string Grey(const std::string& parameter, double value) {
  return fmt::format(" \"rgb {0}\" [{1:.17g} {1:.17g} {1:.17g}]", parameter, value);
}

std::string Numbers(Vec3d v) {
  return fmt::format("{:.17g} {:.17g} {:.17g} ", v.x, v.y, v.z);
}

std::string Block(const std::string& text) {
  return "AttributeBegin\n" + text + "\nAttributeEnd\n";
}

std::string ViewOfPlane(double cosine, double half) {
  const double sine = std::sqrt((1 - cosine) * (1 + cosine));
  const double side = half * std::min(1.0, cosine);
  return fmt::format(
      "LookAt {:.17g} 0 {:.17g}  0 0 0  0 1 0\n"
      "Camera \"orthographic\" \"float screenwindow\" [{:.17g} {:.17g} {:.17g} "
      "{:.17g}]\nPixelFilter \"box\"\nWorldBegin\n",
      sine, cosine, -side, side, -half, half);
}

std::string ViewFrom(Vec3d eye, double fov) {
  return fmt::format(
      "LookAt {} 0 0 0  0.01 0.02 1\nCamera \"perspective\" \"float fov\" {:.17g}\n"
      "PixelFilter \"box\"\nWorldBegin\n",
      Numbers(eye), fov);
}

std::string CameraText(Vec3d eye, Vec3d look, double fov) {
  const Vec3d forward = Normalize(look - eye);
  const Vec3d up = std::abs(forward.z) < 0.9 ? Vec3d{0, 0, 1} : Vec3d{0, 1, 0};
  return fmt::format("LookAt {} {} {}\nCamera \"perspective\" \"float fov\" {:.17g}\n",
                     Numbers(eye), Numbers(look), Numbers(up), fov);
}

std::string Diffuse(double albedo) { return "\"diffuse\"" + Grey("reflectance", albedo); }

std::string Alphas(double alpha_x, double alpha_y) {
  return fmt::format(
      " \"float uroughness\" {:.17g} \"float vroughness\" {:.17g} \"bool "
      "remaproughness\" false",
      alpha_x, alpha_y);
}

std::string Metal(double reflectance, double alpha_x, double alpha_y) {
  return "\"conductor\"" + Grey("reflectance", reflectance) + Alphas(alpha_x, alpha_y);
}

std::string Glass(double eta, double alpha) {
  return fmt::format("\"dielectric\" \"float eta\" {:.17g}", eta) + Alphas(alpha, alpha);
}

std::string Sky(double radiance) {
  return "LightSource \"infinite\"" + Grey("L", radiance) + "\n";
}

std::string AreaLightText(double radiance, bool two_sided) {
  return fmt::format("AreaLightSource \"diffuse\"{} \"bool twosided\" {}\n",
                     Grey("L", radiance), two_sided);
}

std::string SphereLight(Vec3d center, double radius, double radiance) {
  return Block(AreaLightText(radiance) + Sphere(center, radius, Diffuse(0)));
}

std::string Plane(const std::string& material) {
  return Block("Material " + material + "\nShape \"plane\"");
}

std::string Sphere(Vec3d center, double radius) {
  return Block(fmt::format("Translate {}\nShape \"sphere\" \"float radius\" {:.17g}",
                           Numbers(center), radius));
}

std::string Sphere(Vec3d center, double radius, const std::string& material) {
  return Block("Material " + material + "\n" + Sphere(center, radius));
}

void MeshText::AddTriangle(Vec3d a, Vec3d b, Vec3d c) {
  const int first = static_cast<int>(points.size());
  points.insert(points.end(), {a, b, c});
  indices.insert(indices.end(), {first, first + 1, first + 2});
}

void MeshText::AddQuad(Vec3d a, Vec3d b, Vec3d c, Vec3d d) {
  const int first = static_cast<int>(points.size());
  points.insert(points.end(), {a, b, c, d});
  indices.insert(indices.end(),
                 {first, first + 1, first + 2, first, first + 2, first + 3});
}

std::string MeshText::Text() const {
  std::string text = "Shape \"trianglemesh\" \"point3 P\" [";
  for (const Vec3d& p : points) text += Numbers(p);
  text += "] \"integer indices\" [";
  for (const int i : indices) text += fmt::format("{} ", i);
  return text + "]\n";
}

std::string Rectangle(Vec3d low, Vec3d high, bool up) {
  const Vec3d right{high.x, low.y, low.z}, left{low.x, high.y, low.z};
  MeshText mesh;
  mesh.AddQuad(low, up ? right : left, high, up ? left : right);
  return mesh.Text();
}

std::string SkyScene(const std::string& camera, double albedo,
                     const std::string& shapes) {
  return camera + "WorldBegin\n" + Sky(1) + "Material " + Diffuse(albedo) + "\n" + shapes;
}

std::string Walls(double emission, double albedo, double radius) {
  return Block(AreaLightText(emission) + "ReverseOrientation\n" +
               Sphere({}, radius, Diffuse(albedo)));
}

std::string Room(double emission, double albedo) {
  return ViewFrom({0.2, 0.3, 3}, 50) + Walls(emission, albedo);
}

std::string Sheets(double transmitted) {
  std::string text = ViewOfPlane() + Sky(1);
  double left = transmitted;
  for (int i = 0; i == 0 || left < 1; ++i) {
    const double fraction = std::max(left, 1e-3);
    left /= fraction;
    text += Block(fmt::format("Translate 0 0 {:.17g}\n", -0.1 * i) +
                  Plane("\"diffusetransmission\"" + Grey("reflectance", 0) +
                        Grey("transmittance", fraction)));
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
    ring.text +=
        fmt::format("LightSource \"point\" \"point3 from\" [{} {} 0.8]{}\n",
                    0.6 * std::cos(turn), 0.6 * std::sin(turn), Grey("I", intensity));
  }
  ring.expected = 0.5 / std::numbers::pi * 0.8 * sum;
  return ring;
}

}  // namespace lanelight::stress
