#include "src/scene/compile/camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "src/base/core/error.h"
#include "src/base/core/parallel.h"
#include "src/base/core/vec.h"

namespace lanelight {
namespace {

constexpr int kRings = 64;
constexpr int kGrid = 96;  // tried points of the rear plane per side
constexpr double kMillimetres = 1000;

// As LensSurface, in double precision.
struct LensElement {
  double z = 0, radius = 0, eta_ratio = 1, aperture = 0;
};

// A ray in millimetres from the middle of the film; not normalised.
struct LensPath {
  Vec3d o, d;
};

bool PassStop(const LensElement& stop, LensPath& ray) {
  const double t = (stop.z - ray.o.z) / ray.d.z;
  if (!(t >= 0)) return false;
  ray.o += t * ray.d;
  return std::hypot(ray.o.x, ray.o.y) <= stop.aperture;
}

// As kernels/generate/realistic.cc.
bool PassSurface(const LensElement& e, LensPath& ray) {
  const Vec3d d = Normalize(ray.d), p = ray.o - Vec3d{0, 0, e.z};
  const double k = 1 / e.radius, b = k * Dot(p, d) - d.z, c = k * Dot(p, p) - 2 * p.z;
  const double discriminant = b * b - k * c;
  if (!(discriminant >= 0)) return false;
  const double t = c / (std::sqrt(discriminant) - b);
  const Vec3d q = p + t * d;
  if (!(t >= 0) || std::hypot(q.x, q.y) > e.aperture) return false;
  const Vec3d n = Normalize(k * q - Vec3d{0, 0, 1});
  const double cos_i = -Dot(d, n);
  const double sin2_t = e.eta_ratio * e.eta_ratio * (1 - cos_i * cos_i);
  if (!(sin2_t < 1)) return false;
  ray.o = q + Vec3d{0, 0, e.z};
  ray.d = e.eta_ratio * d + (e.eta_ratio * cos_i - std::sqrt(1 - sin2_t)) * n;
  return true;
}

// Through all surfaces, from lower to higher z. False where the ray is stopped: beside an
// aperture or by total reflection.
bool TraceElements(std::span<const LensElement> elements, LensPath& ray) {
  return std::ranges::all_of(elements, [&](const LensElement& e) {
    return e.radius == 0 ? PassStop(e, ray) : PassSurface(e, ray);
  });
}

// Returns the surfaces from the film outwards; files list them from front to rear. A row
// has the radius (positive if the centre lies towards the film), the distance to the next
// surface or the film, the index of what follows, and the diameter.
std::vector<LensElement> ElementsOf(const Camera& camera) {
  const std::vector<double>& file = camera.lens;
  const auto index_of = [](double eta) { return eta == 0 ? 1 : eta; };
  std::vector<LensElement> elements;
  double z = 0;
  for (std::size_t i = file.size(); i >= 4; i -= 4) {
    const double* row = &file[i - 4];
    z += row[1];
    const double beyond = i > 4 ? index_of(row[-2]) : 1;
    const bool stop = row[0] == 0;
    elements.push_back(
        {z, -row[0], index_of(row[2]) / beyond,
         (stop ? std::min(row[3], camera.aperture_diameter) : row[3]) / 2});
  }
  return elements;
}

std::vector<LensElement> Reversed(const std::vector<LensElement>& elements) {
  std::vector<LensElement> out;
  for (auto e = elements.rbegin(); e != elements.rend(); ++e) {
    out.push_back({-e->z, -e->radius, 1 / e->eta_ratio, e->aperture});
  }
  return out;
}

// Focal point and principal plane of a ray parallel to the axis.
struct Cardinal {
  double focus, principal;  // z
};
Cardinal CardinalOf(const Camera& camera, const std::vector<LensElement>& elements) {
  const double height = 0.001 * camera.film_diagonal;
  LensPath ray = {{height, 0, elements.front().z - 1}, {0, 0, 1}};
  if (!TraceElements(elements, ray) || ray.d.x == 0) {
    throw InputError(camera.where,
                     "no off-axis ray passes the lenses, so they cannot be focused; "
                     "check whether the aperture is too small");
  }
  return {ray.o.z - ray.o.x / ray.d.x * ray.d.z,
          ray.o.z + (height - ray.o.x) / ray.d.x * ray.d.z};
}

// Returns how far the lenses move towards the scene. With s' and s from the principal
// planes to film and object, 1 / s' + 1 / s = 1 / f. s' + s is the distance of film and
// object less that of the planes, wherever the lenses are.
double FocusShift(const Camera& camera, const std::vector<LensElement>& elements) {
  const Cardinal scene_side = CardinalOf(camera, elements);
  const Cardinal mirrored = CardinalOf(camera, Reversed(elements));
  const double near_film = -mirrored.principal;
  const double f = near_film + mirrored.focus;
  const double between =
      camera.focal_distance * kMillimetres - (scene_side.principal - near_film);
  const double root2 = between * (between - 4 * f);
  if (!(root2 > 0) || !(f > 0)) {
    throw InputError(camera.where,
                     fmt::format("lenses of focal length {:.4g} mm cannot be focused at "
                                 "a distance of {:.4g} mm",
                                 f, camera.focal_distance * kMillimetres));
  }
  return (between - std::sqrt(root2)) / 2 - near_film;
}

struct Bounds {
  double x0 = 1e300, x1 = -1e300, y0 = 1e300, y1 = -1e300;

  bool empty() const { return x1 < x0; }
  void Add(double x, double y) {
    x0 = std::min(x0, x), x1 = std::max(x1, x);
    y0 = std::min(y0, y), y1 = std::max(y1, y);
  }
  // Grows by this many steps of a grid over `of`.
  void Grow(const Bounds& of, double steps) {
    const double x = steps * (of.x1 - of.x0) / kGrid, y = steps * (of.y1 - of.y0) / kGrid;
    x0 -= x, x1 += x, y0 -= y, y1 += y;
  }
};

// Points of a grid over `within` that rays from the ring's film points come through.
Bounds Passing(const std::vector<LensElement>& elements, double r0, double r1,
               const Bounds& within) {
  Bounds found;
  for (const double r : {r0, r1}) {
    for (int i = 0; i < kGrid * kGrid; ++i) {
      const double x = within.x0 + (within.x1 - within.x0) * (i % kGrid + 0.5) / kGrid;
      const double y = within.y0 + (within.y1 - within.y0) * (i / kGrid + 0.5) / kGrid;
      LensPath ray = {{r, 0, 0}, Vec3d{x, y, elements.front().z} - Vec3d{r, 0, 0}};
      if (TraceElements(elements, ray)) found.Add(x, y);
    }
  }
  return found;
}

// The second grid covers the bounds that the first one has found.
LensSystem::Pupil PupilOf(const std::vector<LensElement>& elements, double r0,
                          double r1) {
  const double side = 1.5 * elements.front().aperture;
  const Bounds all = {-side, side, -side, side};
  Bounds coarse = Passing(elements, r0, r1, all);
  if (coarse.empty()) return {0, 0, 0, 0};
  coarse.Grow(all, 1);
  Bounds fine = Passing(elements, r0, r1, coarse);
  if (fine.empty()) fine = coarse;
  fine.Grow(coarse, 2);
  return {static_cast<float>(fine.x0), static_cast<float>(fine.x1),
          static_cast<float>(fine.y0), static_cast<float>(fine.y1)};
}

}  // namespace

LensSystem CompileLenses(const Camera& camera, double unit) {
  std::vector<LensElement> elements = ElementsOf(camera);
  const double shift = FocusShift(camera, elements);
  for (LensElement& e : elements) e.z += shift;
  LensSystem out;
  for (const LensElement& e : elements) {
    out.surfaces.push_back({static_cast<float>(e.z), static_cast<float>(e.radius),
                            static_cast<float>(e.eta_ratio),
                            static_cast<float>(e.aperture)});
  }
  StoreAperture(camera, out);
  // Stops become circles around all that the image of the aperture transmits.
  for (LensElement& e : elements) {
    if (e.radius == 0) e.aperture *= ApertureReach(out);
  }
  const double ring = camera.film_diagonal / 2 / kRings;
  out.pupils.resize(kRings);
  ParallelFor(kRings, [&](std::size_t i) {
    out.pupils[i] = PupilOf(elements, double(i) * ring, double(i + 1) * ring);
  });
  const bool dark =
      std::ranges::all_of(out.pupils, [](const auto& p) { return p.x1 <= p.x0; });
  if (dark)
    throw InputError(camera.where,
                     "the lenses let no light through to the film: check "
                     "\"focusdistance\", \"aperturediameter\" and the lens file");
  out.rings_per_mm = static_cast<float>(1 / ring);
  out.rear = static_cast<float>(elements.front().z);
  out.scene_from_mm = static_cast<float>(unit / kMillimetres);
  return out;
}

}  // namespace lanelight
