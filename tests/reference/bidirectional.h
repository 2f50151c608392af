// Bidirectional path tracing in double precision (Veach 1997, chapter 10): the estimators
// of light-paths=splats and all others that connect a camera subpath with a light
// subpath.
//
// Technique (s, t) makes a path of s vertices of a light subpath and t vertices of a
// camera subpath, which counts the camera itself. Shapes that emit on one side start
// light subpaths; other lights are refused, except shapes of two sides, which only (0, t)
// finds. Materials: diffuse, metal and dielectric, smooth or rough. Pinhole camera, box
// filter.
#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "src/scene/description/description.h"

namespace lanelight {

struct Technique {
  int s = 0, t = 0;
  friend auto operator<=>(const Technique&, const Technique&) = default;
};

/// Techniques that share the light of a path by the balance heuristic. In its densities
/// both directions at a smooth surface count as 1: the ratio of solid angles at a
/// refraction is left out, which cancels where a path leaves the glass it has entered.
using TechniqueSet = std::function<bool(Technique)>;

/// Faults, for tests that must find them.
enum class BidirectionalFault {
  kNone,
  kNoCosineAtLight,       // of connections with s = 1
  kNoCosineAtConnection,  // of connections with s > 1
  kNoCosineAtCamera,      // of the density of film positions
  kNoShadingCorrection,   // of importance at shading normals
  kWrongGlossyDensity,    // of light subpaths, twice too large
  kCountsMirrors,         // weights count connections to smooth surfaces
  kTwoLightSubpaths       // (s, 1) is divided by half the number of light subpaths
};

struct BidirectionalOptions {
  int samples = 64;  // per pixel: pairs of a camera subpath and a light subpath
  std::uint64_t seed = 1;
  /// Light subpaths of the whole image per camera sample of a pixel, in the weights of
  /// t = 1. 0: the number of pixels.
  double paths_per_sample = 0;
  std::vector<TechniqueSet> sets;
  BidirectionalFault fault = BidirectionalFault::kNone;
};

/// Pixels row by row.
using TechniqueImages = std::map<Technique, std::vector<Rgb>>;

struct BidirectionalImages {
  TechniqueImages unweighted;
  std::vector<TechniqueImages> weighted;  // by set
};

BidirectionalImages RenderBidirectional(const SceneDescription& scene,
                                        const BidirectionalOptions& options);

}  // namespace lanelight
