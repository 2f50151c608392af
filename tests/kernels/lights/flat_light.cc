#include "tests/kernels/lights/flat_light.h"

#include <cmath>
#include <random>

#include "kernels/stages.h"
#include "src/scene/prepare/parameters.h"
#include "tests/kernels/lights/light_truth.h"

namespace lanelight::test {
namespace {

CompiledScene SceneOf(const Flat& f, bool two_sided) {
  const auto corner = [&](double u, double v) { return VecCast<float>(f.At(u, v)); };
  Geometry g;
  g.triangles = {MakeTriangle(corner(0, 0), corner(1, 0), corner(0, 1))};
  if (f.rectangle) {
    g.triangles.push_back(MakeTriangle(corner(1, 1), corner(0, 1), corner(1, 0)));
  }
  CompiledScene scene = MakeScene(std::move(g));
  scene.lights.lights = {FlatLight(
      f.rectangle ? LightShape::kRectangle : LightShape::kTriangle, f.corner, f.x, f.y)};
  LightRecord& light = scene.lights.lights[0];
  light.two_sided = two_sided;
  light.radiance[0] = 2, light.radiance[1] = 3, light.radiance[2] = 5;
  for (TriangleRecord& t : scene.geometry.triangles) t.light = 0;
  return scene;
}

}  // namespace

double TriangleAngle(Vec3d a, Vec3d b, Vec3d c) {
  const double la = Length(a), lb = Length(b), lc = Length(c);
  const double det = std::abs(Dot(a, Cross(b - a, c - a)));
  return 2 *
         std::atan2(det, la * lb * lc + Dot(a, b) * lc + Dot(b, c) * la + Dot(c, a) * lb);
}

double PartAngle(const Flat& f, double u0, double v0, double u1, double v1) {
  return TriangleAngle(f.At(u0, v0), f.At(u1, v0), f.At(u0, v1)) +
         TriangleAngle(f.At(u1, v1), f.At(u0, v1), f.At(u1, v0));
}

double AngleOf(const Flat& f) {
  if (f.rectangle) return PartAngle(f, 0, 0, 1, 1);
  return TriangleAngle(f.corner, f.corner + f.x, f.corner + f.y);
}

std::vector<Flat> FlatLights() {
  struct Place {
    const char* name;
    Vec3d corner;
    double x, y, turn;
  };
  const Place places[] = {{"straight on", {-0.6, -0.3, 1}, 1, 0.8, 0},
                          {"aside", {0.9, 0.4, 1}, 1, 0.5, 0.3},
                          {"far aside", {3, -7, 0.5}, 1, 2, 1},
                          {"small", {0.1, 0.2, 2}, 0.02, 0.03, 0.5},
                          {"tiny", {0.3, -0.2, 1}, 5e-4, 6e-4, 0.2},
                          {"too small", {0.3, -0.2, 1}, 1.2e-4, 1.5e-4, 0.2},
                          {"thin", {-1, 0.5, 1}, 2, 1e-3, 0.7},
                          {"grazing", {1, 0.5, 0.01}, 1, 1, 0.2},
                          {"grazing, ahead", {1, -0.5, 0.01}, 2, 1, 0},
                          {"surrounding", {-0.45, -0.6, 1e-3}, 1, 1.1, 0},
                          {"at the edge", {-0.5, 1e-3, 1e-3}, 1, 1, 0},
                          {"at the corner", {1e-2, 1e-2, 1e-2}, 1, 1, 0},
                          {"huge", {-400, -600, 1}, 1000, 1000, 0.4},
                          {"long", {-500, 1, 1}, 1000, 0.1, 0}};
  std::vector<Flat> lights;
  for (const Place& p : places) {
    const double c = std::cos(p.turn), s = std::sin(p.turn);
    // Turned about the axis to (1, 2, 3), so that no coordinate is a round number.
    const Transform turn = Transform::Rotate(70, {1, 2, 3});
    const Vec3d x = turn.Vector({p.x * c, p.x * s, 0});
    const Vec3d y = turn.Vector({-p.y * s, p.y * c, 0});
    for (bool rectangle : {true, false}) {
      lights.push_back({p.name, turn.Point(p.corner), x, y, rectangle});
    }
  }
  return lights;
}

Flat Rounded(Flat f) {
  const auto round = [](Vec3d v) { return VecCast<double>(VecCast<float>(v)); };
  const Vec3d x = round(f.corner + f.x), y = round(f.corner + f.y);
  f.corner = round(f.corner);
  if (f.rectangle) return f;
  f.x = x - f.corner, f.y = y - f.corner;
  return f;
}

Draw::Draw(const Flat& f, std::uint32_t count, const FeatureSet& features, bool two_sided,
           Vec3d normal)
    : light(f), scene(SceneOf(f, two_sided)), fixture(scene, count) {
  chances.pmf = {kPmf};
  fixture.wave.chances = &chances;
  PathColumns& p = fixture.wave.path;
  p.light_pmf = nullptr;
  const Vec3f n = VecCast<float>(normal);
  std::mt19937 engine(53);
  for (std::uint32_t i = 0; i < count; ++i) {
    p.p_x[i] = p.p_y[i] = p.p_z[i] = 0, p.p_error[i] = 1e-8f;
    const float side = i % 2 == 0 ? 1.0f : -1.0f;
    p.ns_x[i] = side * n.x, p.ns_y[i] = side * n.y, p.ns_z[i] = side * n.z;
    p.d_x[i] = -n.x, p.d_y[i] = -n.y, p.d_z[i] = -n.z;
    p.start_n_x[i] = n.x, p.start_n_y[i] = n.y, p.start_n_z[i] = n.z;
    p.u_light_0[i] = static_cast<float>(engine() >> 8) * 0x1p-24f;
    p.u_light_1[i] = static_cast<float>(engine() >> 8) * 0x1p-24f;
  }
  if (count >= 4) {  // corners
    p.u_light_0[0] = p.u_light_1[0] = p.u_light_0[1] = p.u_light_1[2] = 0;
    p.u_light_1[1] = p.u_light_0[2] = p.u_light_0[3] = p.u_light_1[3] = 1 - 0x1p-24f;
  }
  fixture.QueueAll(QueueId::kLit, count);
  fixture.Run(f.rectangle ? SampleRectangleLightStage : SampleTriangleLightStage,
              features);
}

Vec3d Draw::Where(std::uint32_t i) const {
  const PathColumns& p = fixture.wave.path;
  const Vec3d w = {p.ls_x[i], p.ls_y[i], p.ls_z[i]};
  const Vec3d q = w * double{p.ls_distance[i]} - light.corner;
  const Vec3d n = Cross(light.x, light.y);
  const double n2 = Dot(n, n);
  return {Dot(Cross(q, light.y), n) / n2, Dot(Cross(light.x, q), n) / n2, 0};
}

void Draw::Hit(std::uint32_t count, const FeatureSet& features) {
  PathColumns& p = fixture.wave.path;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3d at = Where(i);
    p.b1[i] = static_cast<float>(at.x), p.b2[i] = static_cast<float>(at.y);
    p.o_x[i] = p.o_y[i] = p.o_z[i] = 0;
    p.d_x[i] = p.ls_x[i], p.d_y[i] = p.ls_y[i], p.d_z[i] = p.ls_z[i];
    p.t[i] = p.ls_distance[i], p.bsdf_pdf[i] = p.ls_pdf[i];
    p.prim[i] = light.rectangle ? i % 2 : 0;
    p.beta_r[i] = p.beta_g[i] = p.beta_b[i] = 1;
    p.l_r[i] = p.l_g[i] = p.l_b[i] = 0;
  }
  Strategy strategy;
  ApplyStrategy("directions=mis:balance", {}, strategy);
  fixture.run.mis = MakeMisParameters(strategy);
  fixture.QueueAll(QueueId::kHit, count);
  fixture.Run(light.rectangle ? EmissionRectangleStage : EmissionTriangleStage, features);
}

}  // namespace lanelight::test
