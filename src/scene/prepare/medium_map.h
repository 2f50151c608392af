// Media at points of a scene, found by the surfaces that bound them.
#pragma once

#include <cstdint>
#include <vector>

#include "src/base/core/vec.h"
#include "src/scene/compiled/media.h"
#include "src/scene/compiled/scene.h"

namespace lanelight {

/// Finds media by rays in several directions: the next surface with media beside it says
/// in which one a ray is, as it does for paths that come from there. Tests all these
/// surfaces, up to a limit for all calls together. `scene` must outlive the map.
class MediumMap {
 public:
  /// Rays contradict each other, or the limit is reached.
  static constexpr std::int32_t kUnclear = -2;

  explicit MediumMap(const CompiledScene& scene);

  /// Returns whether the scene is consistent as far as rays from the camera can tell:
  /// each meets surfaces whose near side is the medium that it is in.
  bool IsConsistent() const { return consistent_; }
  /// Returns the index of the medium at a point in the scene, kVacuum or kUnclear.
  std::int32_t At(Vec3d p);
  /// Returns the medium behind all surfaces.
  std::int32_t Outside() const { return outside_; }

 private:
  // A ray passes from the medium `before` to the medium `after`.
  struct Crossing {
    double t = 0;
    std::int32_t before = kVacuum, after = kVacuum;
  };
  struct Ray {
    Vec3d o, d;
  };

  void FindSurfaces();
  void Bound(Vec3d low, Vec3d high);
  void LookFromCamera();
  // Returns all crossings of a ray, nearest first.
  std::vector<Crossing> Crossings(const Ray& ray);
  // Returns whether each surface's near side is the medium behind the one before it.
  static bool Agree(std::int32_t here, const std::vector<Crossing>& all);
  template <class Found>
  void CrossTriangles(const Ray& ray, std::size_t group, const Found& found) const;
  template <class Found>
  void CrossRound(const Ray& ray, const Found& found) const;
  template <class Found>
  void CrossFlat(const Ray& ray, const Found& found) const;

  const CompiledScene& scene_;
  // Primitives with media beside them: triangles by group, the others together.
  std::vector<std::vector<std::uint32_t>> triangles_;
  std::vector<std::uint32_t> others_;
  Vec3d low_{1, 1, 1}, high_{-1, -1, -1};  // bounds of these primitives
  bool bounded_ = true;
  std::uint64_t tests_left_;
  std::int32_t outside_ = kVacuum;
  bool consistent_ = true;
};

}  // namespace lanelight
