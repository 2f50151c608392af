#include "tests/reference/bidirectional.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "src/base/core/check.h"
#include "src/base/core/pi.h"
#include "tests/reference/camera.h"
#include "tests/reference/frame.h"
#include "tests/reference/lights.h"
#include "tests/reference/material.h"

namespace lanelight {
namespace reference {
namespace {

using Fault = BidirectionalFault;

// The film as seen from the scene: the ray through (x, y) has the direction a + x b + y
// c.
class FilmView {
 public:
  FilmView(const SceneDescription& scene, Random& random) {
    LL_CHECK(scene.camera.kind == CameraKind::kPerspective);
    LL_CHECK(scene.camera.lens_radius == 0);
    const CameraRays rays(scene.camera, scene.film);
    const Vec3d forward = Normalize(scene.camera.world_from_camera.Vector({0, 0, 1}));
    const auto at = [&](double x, double y) {
      const Ray ray = rays.Sample(x, y, random).ray;
      eye_ = ray.o;
      return ray.d / Dot(ray.d, forward);
    };
    a_ = at(0, 0);
    b_ = at(1, 0) - a_;
    c_ = at(0, 1) - a_;
  }

  Vec3d eye() const { return eye_; }
  // Returns (x, y, depth) in pixels and in units of a: by Cramer's rule.
  Vec3d Project(Vec3d w) const {
    const double det = Dot(a_, Cross(b_, c_));
    const double depth = Dot(w, Cross(b_, c_)) / det;
    return {Dot(a_, Cross(w, c_)) / det / depth, Dot(a_, Cross(b_, w)) / det / depth,
            depth};
  }
  // Returns pixels^2 per solid angle in the direction w: domega = |n.w| dA / distance^2.
  double Density(Vec3d w) const {
    const double distance = 1 / Project(w).z;
    return distance * distance / std::abs(Dot(Cross(b_, c_), w));
  }

 private:
  Vec3d eye_, a_, b_, c_;
};

struct Vertex {
  int primitive = kNone;
  SurfacePoint at;
  TangentFrame frame;
  LocalMaterial material;
  Vec3d in;  // unit, to the vertex before it in the subpath
  Rgb beta;  // radiance or importance that arrives over the density, without emission
  bool smooth = false;

  Vec3d Local(Vec3d v) const { return frame.ToLocal(v); }
};

double AbsDot(Vec3d a, Vec3d b) { return std::abs(Dot(a, b)); }

// Density per solid angle with which SampleBsdf chooses wi. The normals m have the
// density D(m) m.z; the rest are the Jacobians of Walter et al. 2007.
double ScatteringDensity(const LocalMaterial& m, Vec3d wo, Vec3d wi, double index) {
  if (wo.z < 0) return ScatteringDensity(m, FlipZ(wo), FlipZ(wi), 1 / index);
  if (m.kind == MaterialKind::kDiffuse) {
    return wi.z > 0 ? DiffuseDensity(m.scattering, wi.z) : 0;
  }
  const bool is_metal = m.kind == MaterialKind::kConductor;
  const Ggx& ggx = m.interface;
  if (wi.z > 0) {
    const Vec3d h = Normalize(wo + wi);
    const double chance = is_metal ? 1 : FresnelDielectric(Dot(wo, h), index);
    return chance * ggx.D(h) * h.z / (4 * Dot(wo, h));
  }
  if (is_metal) return 0;
  Vec3d h = Normalize(wo + index * wi);
  if (h.z < 0) h = -h;
  const double o = Dot(wo, h), i = Dot(wi, h), d = (o + index * i) / index;
  if (o <= 0 || i >= 0) return 0;
  return (1 - FresnelDielectric(o, index)) * ggx.D(h) * h.z * -i / (d * d);
}

struct BidirectionalTwin {
  const SceneDescription& scene;
  const BidirectionalOptions& options;
  const Geometry& geometry;
  const Lights& lights;
  const FilmView& film;
  Random& random;
  BidirectionalImages& images;

  // A path from the camera, path[0], to a light; the camera has a place only.
  using Path = std::vector<const Vertex*>;

  bool Has(Fault fault) const { return options.fault == fault; }
  double Density(const Vertex& v, Vec3d wo, Vec3d wi) const;
  Rgb Importance(const Vertex& v, const BsdfSample& next, Vec3d out) const;
  void Walk(Ray ray, Rgb beta, bool is_light, std::vector<Vertex>& path) const;
  std::vector<Vertex> CameraSubpath(double x, double y) const;
  std::vector<Vertex> LightSubpath() const;
  Rgb Sent(const Vertex& y, int s, Vec3d toward) const;
  bool Sees(const Vertex& a, const Vertex& b) const;
  std::vector<double> Densities(const Path& path) const;
  void Add(Technique technique, const Path& path, Vec3d at, Rgb light) const;
  void Connect(const std::vector<Vertex>& camera, const std::vector<Vertex>& light, int s,
               int t, Vec3d at) const;
  void Sample(int x, int y) const;
};

double BidirectionalTwin::Density(const Vertex& v, Vec3d wo, Vec3d wi) const {
  if (v.smooth) return 1;
  return ScatteringDensity(v.material, v.Local(wo), v.Local(wi), v.material.index);
}

// Returns the factor of importance that v scatters towards `out`. Light comes the other
// way: in a path's measure, light that arrives from v.in has the shading cosine, and
// light that leaves along `out` has the geometric one. Importance is not scaled by the
// index where it is refracted.
Rgb BidirectionalTwin::Importance(const Vertex& v, const BsdfSample& next,
                                  Vec3d out) const {
  double geometric = AbsDot(v.at.ng, out) / AbsDot(v.at.ng, v.in);
  const Vec3d in = v.Local(v.in), to = v.Local(out);
  const double shading = std::abs(in.z / to.z);
  if (Has(Fault::kNoShadingCorrection)) geometric = 1 / shading;
  if (v.smooth) {
    return (in.z * to.z < 0 ? Rgb{1, 1, 1} : next.weight) * (shading * geometric);
  }
  double density = Density(v, v.in, out);
  if (Has(Fault::kWrongGlossyDensity) && v.material.kind != MaterialKind::kDiffuse) {
    density *= 2;
  }
  return EvaluateCos(v.material, to, in, random) * (geometric / density);
}

// Adds vertices to a subpath: as many as the depth limit lets it have.
void BidirectionalTwin::Walk(Ray ray, Rgb beta, bool is_light,
                             std::vector<Vertex>& path) const {
  // The last vertex of a camera subpath only emits.
  const int vertices = scene.integrator.max_depth + (is_light ? 1 : 2);
  while (static_cast<int>(path.size()) < vertices) {
    const Hit hit = geometry.Intersect(ray, kInfinity, random);
    if (hit.primitive == kNone) return;
    Vertex v;
    v.primitive = hit.primitive;
    v.at = geometry.Describe(ray, hit);
    v.frame = MakeFrame(v.at.ns, v.at.dpdu);
    v.material = EvaluateMaterial(scene, geometry.primitives()[hit.primitive].material,
                                  v.at, {}, random);
    const MaterialKind kind = v.material.kind;
    LL_CHECK(kind == MaterialKind::kDiffuse || kind == MaterialKind::kConductor ||
             kind == MaterialKind::kDielectric);
    v.smooth = kind != MaterialKind::kDiffuse && v.material.interface.smooth();
    v.in = -ray.d;
    v.beta = beta;
    path.push_back(v);
    const auto next = SampleBsdf(v.material, v.Local(v.in), random);
    if (!next) return;
    const Vec3d out = Normalize(v.frame.ToWorld(next->wi));
    beta = beta * (is_light ? Importance(v, *next, out) : next->weight);
    if (beta == Rgb{}) return;
    ray = {v.at.p, out, v.primitive};
  }
}

std::vector<Vertex> BidirectionalTwin::CameraSubpath(double x, double y) const {
  std::vector<Vertex> path(1);
  path[0].at.p = film.eye();
  Walk(CameraRays(scene.camera, scene.film).Sample(x, y, random).ray, {1, 1, 1}, false,
       path);
  return path;
}

std::vector<Vertex> BidirectionalTwin::LightSubpath() const {
  const auto from = lights.SampleEmission(random);
  if (!from) return {};
  std::vector<Vertex> path(1);
  path[0].primitive = from->primitive;
  path[0].at.p = from->p;
  path[0].at.ng = from->n;
  const Vec3d local = SampleDiffuse(Scattering::kLambertian, random);
  const Vec3d d = Normalize(MakeFrame(from->n).ToWorld(local));
  // The cosine of the direction cancels its density.
  const Rgb beta =
      lights.Emitted(from->primitive, path[0].at, d) *
      (lights.Sides(from->primitive) * kPi / lights.EmissionDensity(from->primitive));
  Walk({from->p, d, from->primitive}, beta, true, path);
  return path;
}

// Returns the radiance over the density that the last of s vertices sends.
Rgb BidirectionalTwin::Sent(const Vertex& y, int s, Vec3d toward) const {
  if (s == 1) {
    return lights.Emitted(y.primitive, y.at, toward) /
           lights.EmissionDensity(y.primitive);
  }
  if (y.smooth) return {};
  const Vec3d in = y.Local(y.in);
  const double arrives =
      Has(Fault::kNoShadingCorrection) ? std::abs(in.z) : AbsDot(y.at.ng, y.in);
  return y.beta * EvaluateCos(y.material, y.Local(toward), in, random) / arrives;
}

bool BidirectionalTwin::Sees(const Vertex& a, const Vertex& b) const {
  const Vec3d to = b.at.p - a.at.p;
  const double distance = Length(to);
  const Ray ray = {a.at.p, to / distance, a.primitive};
  return geometry.Intersect(ray, distance * (1 - 1e-9), random).primitive == kNone;
}

// Returns the densities of the path x_0, ..., x_n by technique, from t = 1 on, up to a
// factor; 0 where it cannot be found.
std::vector<double> BidirectionalTwin::Densities(const Path& path) const {
  const int n = static_cast<int>(path.size()) - 1;
  const auto direction = [&](int from, int to) {
    return Normalize(path[to]->at.p - path[from]->at.p);
  };
  // From a density per solid angle at x_from to one by area at x_to.
  const auto by_area = [&](int from, int to) {
    const Vec3d d = path[to]->at.p - path[from]->at.p;
    return AbsDot(path[to]->at.ng, Normalize(d)) / Dot(d, d);
  };
  std::vector<double> camera(n + 1, 1.0), light(n + 1, 1.0);
  camera[1] = film.Density(direction(0, 1)) * by_area(0, 1);
  for (int i = 1; i < n; ++i) {
    camera[i + 1] =
        Density(*path[i], direction(i, i - 1), direction(i, i + 1)) * by_area(i, i + 1);
  }
  light[n] = lights.EmissionDensity(path[n]->primitive);
  if (n > 1) {
    light[n - 1] = AbsDot(path[n]->at.ng, direction(n, n - 1)) /
                   (lights.Sides(path[n]->primitive) * kPi) * by_area(n, n - 1);
  }
  for (int i = n - 1; i > 1; --i) {
    light[i - 1] =
        Density(*path[i], direction(i, i + 1), direction(i, i - 1)) * by_area(i, i - 1);
  }
  const double pixels = double(scene.film.width) * scene.film.height;
  const double paths = options.paths_per_sample > 0 ? options.paths_per_sample : pixels;
  std::vector<double> densities;
  for (int t = 1; t <= n + 1; ++t) {
    const bool ends_smooth = t > 1 && t <= n && path[t - 1]->smooth;
    const bool meets_smooth = t < n && path[t]->smooth;
    double density = t == 1 ? paths : 1;
    for (int i = 1; i <= n; ++i) density *= i < t ? camera[i] : light[i];
    const bool found = Has(Fault::kCountsMirrors) || !(ends_smooth || meets_smooth);
    densities.push_back(found ? density : 0);
  }
  return densities;
}

// Adds light to the pixels of the filter (t = 1), or to the pixel at `at`.
void BidirectionalTwin::Add(Technique technique, const Path& path, Vec3d at,
                            Rgb light) const {
  const Film& size = scene.film;
  const double pixels = double(size.width) * size.height;
  light = light * size.imaging_ratio / options.samples;
  std::vector<double> densities, weights;
  if (!options.sets.empty()) densities = Densities(path);
  for (const TechniqueSet& set : options.sets) {
    double sum = 0;
    for (int t = 1; t <= static_cast<int>(path.size()); ++t) {
      if (set({static_cast<int>(path.size()) - t, t})) sum += densities[t - 1];
    }
    weights.push_back(set(technique) ? densities[technique.t - 1] / sum : 0);
  }
  const auto put = [&](int x, int y, Rgb value) {
    const auto pixel = static_cast<std::size_t>(y * size.width + x);
    const auto to = [&](TechniqueImages& of, double weight) {
      std::vector<Rgb>& image = of[technique];
      image.resize(static_cast<std::size_t>(size.width * size.height));
      image[pixel] += value * weight;
    };
    to(images.unweighted, 1);
    for (std::size_t i = 0; i < weights.size(); ++i) {
      if (weights[i] > 0) to(images.weighted[i], weights[i]);
    }
  };
  if (technique.t > 1) return put(int(at.x), int(at.y), light);
  const double rx = scene.filter.x_radius, ry = scene.filter.y_radius;
  const double paths = Has(Fault::kTwoLightSubpaths) ? pixels / 2 : pixels;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      if (std::abs(x + 0.5 - at.x) > rx || std::abs(y + 0.5 - at.y) > ry) continue;
      put(x, y, light / (4 * rx * ry * paths));
    }
  }
}

void BidirectionalTwin::Connect(const std::vector<Vertex>& camera,
                                const std::vector<Vertex>& light, int s, int t,
                                Vec3d at) const {
  const Vertex& z = camera[t - 1];
  Path path;
  for (int i = 0; i < t; ++i) path.push_back(&camera[i]);
  for (int i = s - 1; i >= 0; --i) path.push_back(&light[i]);
  if (s == 0) {
    const Rgb emitted = lights.Emitted(z.primitive, z.at, z.in);
    if (!(emitted == Rgb{})) Add({s, t}, path, at, z.beta * emitted);
    return;
  }
  if (z.smooth) return;
  const Vertex& y = light[s - 1];
  const Vec3d to = y.at.p - z.at.p, w = Normalize(to);
  const bool no_cosine =
      Has(s == 1 ? Fault::kNoCosineAtLight : Fault::kNoCosineAtConnection);
  const double cosine = no_cosine ? 1 : AbsDot(y.at.ng, w);
  Rgb value = Sent(y, s, -w) * (cosine / Dot(to, to));
  if (t == 1) {
    at = film.Project(w);
    if (at.z <= 0) return;
    const double lost = Has(Fault::kNoCosineAtCamera) ? std::pow(at.z, 3) : 1;
    value = value * film.Density(w) * lost;
  } else {
    value = value * z.beta * EvaluateCos(z.material, z.Local(z.in), z.Local(w), random);
  }
  if (!(value == Rgb{}) && Sees(z, y)) Add({s, t}, path, at, value);
}

void BidirectionalTwin::Sample(int x, int y) const {
  const Filter& filter = scene.filter;
  LL_CHECK(filter.kind == FilterKind::kBox);
  const double fx = x + 0.5 + SampleFilter(filter, filter.x_radius, random);
  const double fy = y + 0.5 + SampleFilter(filter, filter.y_radius, random);
  const std::vector<Vertex> camera = CameraSubpath(fx, fy), light = LightSubpath();
  const int max_vertices = scene.integrator.max_depth + 2;
  for (int t = 1; t <= static_cast<int>(camera.size()); ++t) {
    for (int s = t == 1 ? 1 : 0; s <= static_cast<int>(light.size()); ++s) {
      if (s + t <= max_vertices) Connect(camera, light, s, t, {double(x), double(y), 0});
    }
  }
}

}  // namespace
}  // namespace reference

BidirectionalImages RenderBidirectional(const SceneDescription& scene,
                                        const BidirectionalOptions& options) {
  LL_CHECK(scene.lights.empty());
  const reference::Geometry geometry(scene, {});
  const reference::Lights lights(scene, geometry, {});
  reference::Random random(options.seed);
  const reference::FilmView film(scene, random);
  BidirectionalImages images;
  images.weighted.resize(options.sets.size());
  const reference::BidirectionalTwin twin = {scene, options, geometry, lights,
                                             film,  random,  images};
  for (int i = 0; i < options.samples; ++i) {
    for (int y = 0; y < scene.film.height; ++y) {
      for (int x = 0; x < scene.film.width; ++x) twin.Sample(x, y);
    }
  }
  return images;
}

}  // namespace lanelight
