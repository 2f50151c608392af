#include "src/stress/shapes_text.h"

#include "src/core/pi.h"

#include <fmt/format.h>

#include <cmath>

namespace lanelight::stress {
namespace {

std::string Numbers(Vec3d v) {
  return fmt::format("{:.17g} {:.17g} {:.17g} ", v.x, v.y, v.z);
}

}  // namespace

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

MeshText SphereMesh(int rings, int segments, Vec3d center, double radius) {
  MeshText mesh;
  for (int r = 0; r <= rings; ++r) {
    const double theta = kPi * r / rings;
    const double sine = r == 0 || r == rings ? 0 : std::sin(theta);
    for (int s = 0; s < segments; ++s) {
      const double phi = 2 * kPi * s / segments;
      mesh.points.push_back(center + radius * Vec3d{sine * std::cos(phi),
                                                    sine * std::sin(phi),
                                                    std::cos(theta)});
    }
  }
  const auto at = [&](int r, int s) { return r * segments + s % segments; };
  for (int r = 0; r < rings; ++r) {
    for (int s = 0; s < segments; ++s) {
      const int a = r == 0 ? 0 : at(r, s), d = r == 0 ? 0 : at(r, s + 1);
      const int last = at(rings, 0);
      const int b = r + 1 == rings ? last : at(r + 1, s);
      const int c = r + 1 == rings ? last : at(r + 1, s + 1);
      if (b != c) mesh.indices.insert(mesh.indices.end(), {a, b, c});
      if (a != d) mesh.indices.insert(mesh.indices.end(), {a, c, d});
    }
  }
  return mesh;
}

MeshText SquareMesh(Vec3d center, Vec3d n, double side) {
  const Across a(n);
  const Vec3d u = a.u * (side / 2), v = a.v * (side / 2);
  MeshText mesh;
  mesh.AddQuad(center - u - v, center + u - v, center + u + v, center - u + v);
  return mesh;
}

std::string SphereText(Vec3d center, double radius) {
  return fmt::format(
      "AttributeBegin\nTranslate {}\nShape \"sphere\" \"float radius\" {:.17g}\n"
      "AttributeEnd\n",
      Numbers(center), radius);
}

std::string CameraText(Vec3d eye, Vec3d look, double fov) {
  const Vec3d forward = Normalize(look - eye);
  const Vec3d up = std::abs(forward.z) < 0.9 ? Vec3d{0, 0, 1} : Vec3d{0, 1, 0};
  return fmt::format("LookAt {} {} {}\nCamera \"perspective\" \"float fov\" {:.17g}\n",
                     Numbers(eye), Numbers(look), Numbers(up), fov);
}

std::string SkyScene(const std::string& camera, double albedo,
                     const std::string& shapes) {
  return camera +
         fmt::format(
             "WorldBegin\nLightSource \"infinite\" \"rgb L\" [1 1 1]\n"
             "Material \"diffuse\" \"rgb reflectance\" [{0:.17g} {0:.17g} "
             "{0:.17g}]\n",
             albedo) +
         shapes;
}

std::string RayScene(const std::string& shapes, Vec3d eye) {
  return SkyScene(CameraText(eye, eye - Vec3d{0, 0, 1}), 0.5, shapes);
}

double Draws::operator()(double low, double high) {
  const double unit = static_cast<double>(engine_() >> 11) * 0x1p-53;
  return low + (high - low) * unit;
}

Vec3d Draws::Direction() {
  const double z = (*this)(-1, 1), phi = (*this)(0, 2 * kPi);
  const double ring = std::sqrt(1 - z * z);
  return {ring * std::cos(phi), ring * std::sin(phi), z};
}

Vec3d Draws::Above(Vec3d n, double sine) {
  const double length = Length(n);
  for (;;) {
    const Vec3d d = Direction();
    const double cosine = Dot(d, n);
    if (std::abs(cosine) >= sine * length) return cosine > 0 ? d : -d;
  }
}

Vec3d PointOfSquare(Draws& draws, Vec3d center, Vec3d n, double side) {
  const Across a(n);
  return center + (a.u * draws(-0.45, 0.45) + a.v * draws(-0.45, 0.45)) * side;
}

Across::Across(Vec3d n) {
  const Vec3d other = std::abs(n.x) < 0.7 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  u = Normalize(Cross(n, other));
  v = Cross(n, u);
}

}  // namespace lanelight::stress
