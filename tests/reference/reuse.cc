#include "tests/reference/reuse.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include "src/base/core/check.h"
#include "tests/reference/bsdf.h"
#include "tests/reference/camera.h"
#include "tests/reference/frame.h"
#include "tests/reference/optics.h"
#include "tests/reference/path_tracer.h"

namespace lanelight {
namespace reference {
namespace {

// A point of a path on a diffuse surface; `n` is on the side that the path came from.
struct Vertex {
  int primitive = kNone;
  Vec3d p, n;
  Rgb albedo;
};

// A diffuse surface that a ray meets, behind mirrors if need be.
struct Arrival {
  Vertex vertex;
  Ray ray;               // that meets it
  Rgb beta = {1, 1, 1};  // of the mirrors
  int events = 0;        // at them
};

// One path of a block: the first vertex, the second one, and what that sends.
struct Path {
  std::optional<Arrival> first;
  std::optional<Vertex> second;
  Rgb own;   // light that is no other's: emission, and delta lights at the first vertex
  Rgb sent;  // radiance of the second vertex towards any side that sees it
  double q = 1;  // probability with which it is kept
};

// A pair of a first and a second vertex.
struct Pair {
  Rgb f;
  double pdf_area = 0;
};

struct ReuseTwin {
  const SceneDescription& scene;
  const ReuseTwinOptions& options;
  const Geometry& geometry;
  const Lights& lights;
  Random& random;

  std::optional<Arrival> Meet(Ray ray) const;
  Rgb Gather(const Ray& ray, int depth) const;
  bool Sees(const Vertex& x, const Vertex& y) const;
  Path Trace(const Ray& ray) const;
  double CertainlyKept(const std::vector<Path>& paths) const;
  Pair Evaluate(const Arrival& x, const Vertex& y) const;
  bool Counts(const Arrival& x, const Path& owner) const;
  void Share(const Path& owner, const std::vector<const Path*>& block,
             std::vector<Rgb>& light) const;
  void Connect(const std::vector<const Path*>& block, std::vector<Rgb>& light) const;
};

double MaxChannel(Rgb c) { return std::max({c.x, c.y, c.z}); }

// The next surface, by the law of reflection where it is a mirror.
std::optional<Arrival> ReuseTwin::Meet(Ray ray) const {
  Arrival arrival;
  for (;; ++arrival.events) {
    const Hit hit = geometry.Intersect(ray, kInfinity, random);
    if (hit.primitive == kNone) return std::nullopt;
    const SurfacePoint at = geometry.Describe(ray, hit);
    const Material& material =
        scene.materials[geometry.primitives()[hit.primitive].material];
    const Vec3d n = Dot(at.ng, ray.d) < 0 ? at.ng : -at.ng;
    if (material.kind == MaterialKind::kDiffuse) {
      arrival.vertex = {hit.primitive, at.p, n, material.reflectance.constant};
      arrival.ray = ray;
      return arrival;
    }
    LL_CHECK(material.kind == MaterialKind::kConductor);
    const double cosine = -Dot(ray.d, n);
    arrival.beta = arrival.beta *
                   FresnelConductor(cosine, material.eta.constant, material.k.constant);
    ray = {at.p, Normalize(ray.d + 2 * cosine * n), hit.primitive};
  }
}

// Radiance along the ray, by the plain path tracer.
Rgb ReuseTwin::Gather(const Ray& ray, int depth) const {
  TwinOptions plain;
  plain.estimator = ReferenceEstimator::kMaterialSampling;
  plain.max_depth = depth;
  return ReferenceRadiance(scene, geometry, lights, ray, plain, random);
}

bool ReuseTwin::Sees(const Vertex& x, const Vertex& y) const {
  const Vec3d to = y.p - x.p;
  const double distance = Length(to);
  const Ray ray = {x.p, to / distance, x.primitive};
  return geometry.Intersect(ray, distance * (1 - 1e-9), random).primitive == kNone;
}

Path ReuseTwin::Trace(const Ray& ray) const {
  Path path;
  path.first = Meet(ray);
  if (!path.first) {
    path.own = Gather(ray, scene.integrator.max_depth);
    return path;
  }
  const Arrival& x = *path.first;
  const int left = scene.integrator.max_depth - x.events;  // events at x and later
  // Up to what the ray leaving x meets: emission seen, also by x, and delta lights at x.
  path.own = Gather(ray, std::min(x.events + 1, scene.integrator.max_depth));
  if (left < 1 || MaxChannel(x.beta * x.vertex.albedo) == 0) return path;
  const Vec3d local = SampleDiffuse(Scattering::kLambertian, random);
  const Ray next = {x.vertex.p, Normalize(MakeFrame(x.vertex.n).ToWorld(local)),
                    x.vertex.primitive};
  const std::optional<Arrival> y = Meet(next);
  // Behind a mirror it is the path's own: no density finds it.
  if (!y || y->events > 0 || left < 2) {
    if (left >= 2) {
      path.own += x.beta * x.vertex.albedo * (Gather(next, left - 1) - Gather(next, 0));
    }
    return path;
  }
  path.second = y->vertex;
  path.sent = Gather(next, left - 1) - Gather(next, 0);  // less what y emits
  if (x.vertex.primitive == options.silent_primitive) path.sent = {};
  return path;
}

// c for which the sum of min(1, sent / c) is the share that is kept of those that send.
double ReuseTwin::CertainlyKept(const std::vector<Path>& paths) const {
  std::vector<double> sent;
  for (const Path& path : paths) {
    if (MaxChannel(path.sent) > 0) sent.push_back(MaxChannel(path.sent));
  }
  if (sent.empty()) return 1;
  const double wanted = options.kept * double(sent.size());
  double low = 0, high = 0;
  for (const double s : sent) high += s / wanted;
  for (int i = 0; i < 200; ++i) {
    const double c = (low + high) / 2;
    double sum = 0;
    for (const double s : sent) sum += std::min(1.0, s / c);
    (sum > wanted ? low : high) = c;
  }
  return high;
}

// What x sends on of the light that comes from y, and the density by area at y of the
// direction that finds it; nothing where they do not face each other.
Pair ReuseTwin::Evaluate(const Arrival& x, const Vertex& y) const {
  const Vec3d to = y.p - x.vertex.p;
  const double d2 = Dot(to, to);
  const Vec3d w = to / std::sqrt(d2);
  const double cos_x = Dot(x.vertex.n, w), cos_y = -Dot(y.n, w);
  if (!(cos_x > 0 && cos_y > 0)) return {};
  const double pdf_area = cos_x / std::numbers::pi * cos_y / d2;
  return {x.beta * x.vertex.albedo * pdf_area, pdf_area};
}

// Returns whether the path of x might have found a second vertex of the owner's depth.
bool ReuseTwin::Counts(const Arrival& x, const Path& owner) const {
  const bool black = MaxChannel(x.beta * x.vertex.albedo) == 0;
  const bool other_depth = x.events != owner.first->events;
  return (!black || options.counts_black) &&
         (!other_depth || options.counts_other_depths);
}

// Gives every pixel of the block its part of what one second vertex sends.
void ReuseTwin::Share(const Path& owner, const std::vector<const Path*>& block,
                      std::vector<Rgb>& light) const {
  const Vertex& y = *owner.second;
  std::vector<Rgb> carried(block.size());
  double densities = options.counts_owner_twice ? Evaluate(*owner.first, y).pdf_area : 0;
  for (std::size_t i = 0; i < block.size(); ++i) {
    if (!block[i]->first || !Counts(*block[i]->first, owner)) continue;
    const Pair pair = Evaluate(*block[i]->first, y);
    if (pair.pdf_area == 0) continue;
    const bool seen = block[i] == &owner || Sees(block[i]->first->vertex, y);
    if (seen || options.forgets_visibility) {
      densities += pair.pdf_area;
    }
    if (seen && block[i]->first->events == owner.first->events) {
      carried[i] = pair.f * owner.sent;
    }
  }
  const double kept = options.forgets_roulette ? 1 : owner.q;
  for (std::size_t i = 0; i < block.size(); ++i)
    light[i] += carried[i] / (densities * kept);
}

// One number decides which second vertices are kept: of those with q < 1, the ones at
// which the sum of q passes the next integer.
void ReuseTwin::Connect(const std::vector<const Path*>& block,
                        std::vector<Rgb>& light) const {
  double sum = random.Uniform();
  for (const Path* owner : block) {
    if (owner->q == 0) continue;
    bool keeps = owner->q >= 1;
    if (!keeps) {
      const double before = sum;
      sum += owner->q;
      keeps = std::floor(sum) > std::floor(before);
    }
    if (keeps) Share(*owner, block, light);
  }
}

std::vector<int> Shuffled(int count, Random& random) {
  std::vector<int> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  for (int i = count; i > 1; --i) {
    std::swap(order[i - 1], order[static_cast<int>(random.Uniform() * i)]);
  }
  return order;
}

// One sample of each pixel.
std::vector<Rgb> SampleOfPixels(const ReuseTwin& twin, const CameraRays& camera) {
  const Film& film = twin.scene.film;
  std::vector<Path> paths;
  for (int i = 0; i < film.width * film.height; ++i) {
    const double x = i % film.width + twin.random.Uniform();
    const double y = i / film.width + twin.random.Uniform();
    paths.push_back(twin.Trace(camera.Sample(x, y, twin.random).ray));
  }
  const double certain = twin.CertainlyKept(paths);
  for (Path& path : paths) path.q = std::min(1.0, MaxChannel(path.sent) / certain);
  const std::vector<int> order = Shuffled(static_cast<int>(paths.size()), twin.random);
  std::vector<Rgb> sample(paths.size());
  for (std::size_t begin = 0; begin < paths.size(); begin += twin.options.block) {
    std::vector<const Path*> block;
    for (int i = 0; i < twin.options.block; ++i)
      block.push_back(&paths[order[begin + i]]);
    std::vector<Rgb> light(block.size());
    twin.Connect(block, light);
    for (std::size_t i = 0; i < block.size(); ++i) {
      sample[order[begin + i]] = film.imaging_ratio * (block[i]->own + light[i]);
    }
  }
  return sample;
}

}  // namespace
}  // namespace reference

ReferenceImage RenderReuseReference(const SceneDescription& scene,
                                    const ReuseTwinOptions& options) {
  const Film& film = scene.film;
  const auto pixels = static_cast<std::size_t>(film.width * film.height);
  LL_CHECK_EQ(pixels % options.block, 0u);
  const reference::Geometry geometry(scene, {});
  const reference::Lights lights(scene, geometry, {});
  const reference::CameraRays camera(scene.camera, film);
  reference::Random random(options.seed);
  const reference::ReuseTwin twin = {scene, options, geometry, lights, random};
  std::vector<Rgb> sums(pixels), squares(pixels);
  for (int s = 0; s < options.samples; ++s) {
    const std::vector<Rgb> sample = reference::SampleOfPixels(twin, camera);
    for (std::size_t i = 0; i < pixels; ++i) {
      sums[i] += sample[i];
      squares[i] += sample[i] * sample[i];
    }
  }
  ReferenceImage image;
  image.width = film.width;
  image.height = film.height;
  image.samples = options.samples;
  const double n = options.samples;
  for (std::size_t i = 0; i < pixels; ++i) {
    image.mean.push_back(sums[i] / n);
    image.variance_of_mean.push_back((squares[i] - sums[i] * sums[i] / n) /
                                     (n * (n - 1)));
  }
  return image;
}

}  // namespace lanelight
