// Images of the bidirectional reference tracer and of the renderer, in tests that compare
// them. Errors come from the scatter of renders with different seeds.
#pragma once

#include "src/base/core/parallel.h"
#include "tests/reference/bidirectional.h"
#include "tests/vocabulary/strategy/tiles.h"

namespace lanelight::test::bidirectional {

inline constexpr int kSide = 8, kRenders = 32;

using Renders = std::vector<stat::ImageEstimate>;

struct Comparison {
  bool same = true;
  double detectable_bias = 0;  // of the whole image
  std::string text;
};

/// Compares the image as a whole and tile by tile, each by itself: the pixels of a render
/// depend on each other.
Comparison Compare(const Renders& a, const Renders& b);
void CheckSame(const Comparison& result, double power, const std::string& what);

/// Calls render(seed) for each seed of a comparison.
template <class Render>
auto Repeat(const Render& render) {
  std::vector<decltype(render(std::uint64_t{0}))> out(kRenders);
  ParallelFor(out.size(), [&](std::size_t i) { out[i] = render(i); });
  return out;
}

/// An image of the first pixels of `mean`, without an error.
stat::ImageEstimate Image(std::vector<Rgb> mean);

/// Sums the images of the techniques `of`.
stat::ImageEstimate Sum(const TechniqueImages& images, const TechniqueSet& of);

std::vector<BidirectionalImages> RenderTwin(const SceneDescription& scene,
                                            BidirectionalOptions options);

/// Light that camera paths find, and that of light subpaths which the camera sees.
bool WithLightSamples(Technique of);
bool IsSplat(Technique of);
/// Those that light-paths=splats has.
bool OfProduct(Technique of);

/// Images of the renderer with light-paths=splats:N: light of its light subpaths, of its
/// camera paths, and both.
struct LightPathParts {
  Renders splats, camera, all;
};
LightPathParts RenderParts(const SceneDescription& scene, std::uint64_t spp, int n);

/// A parallelogram with tilted normals.
TriangleMesh Tilted(Vec3d corner, Vec3d e1, Vec3d e2);
/// A room with a box, balls of metal and glass, a panel with tilted normals, and lamps of
/// several shapes, one with two sides.
SceneDescription LampRoom(int max_depth);
/// A lamp close over a floor with tilted normals, which lights a wall. The camera sees
/// the lamp in a mirror.
SceneDescription TiltedFloor();

}  // namespace lanelight::test::bidirectional
