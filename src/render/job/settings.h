// Settings of a render that are not in the scene file, and the limits of both.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "src/render/plan/plan.h"
#include "src/render/run/run.h"
#include "src/vocabulary/path/scene_kinds.h"
#include "src/vocabulary/strategy/strategy.h"

namespace lanelight {

struct CompileOptions;    // src/scene/compile/compile.h
struct Film;              // src/scene/description/film.h
struct CachedBvh;         // src/scene/accel/build.h
struct SceneDescription;  // src/scene/description/description.h

/// True if decide=pilot is the default of a render that is asked for no strategy, neither
/// by its settings nor by the scene.
enum class DefaultDecision {
  kNever,
  kIfLong,  // if the pilot takes a small share of it: see DecidesByDefault
  kAlways,
};

/// The requested transport; kByScene: see ChooseTransport (src/render/job/transport.h).
enum class TransportSetting { kRgb, kSpectral, kByScene };

/// Default limit of triangles of instances that are copied into the world: about 25 MB.
inline constexpr std::uint64_t kCopiedTriangles = 1u << 17;
inline constexpr std::uint64_t kMaxCopiedTriangles = 1u << 30;

/// Format of written images.
struct ImageSettings {
  bool half = false;    // colours of the EXR in 16 bits
  bool png = false;     // in a sweep: beside each EXR
  double exposure = 0;  // of the PNG, stops
};

/// Overrides of the scene file; what is empty stays as the scene says.
struct RenderSettings {
  std::optional<std::uint64_t> spp;
  std::optional<double> seconds;  // time budget instead of samples
  /// Errors at which to stop; samples and seconds then are the most that it may take.
  std::optional<double> target_relmse, target_rmse;
  std::optional<std::array<int, 2>> resolution;
  std::optional<std::array<int, 4>> crop;  // x0, y0, x1, y1 in pixels, end exclusive
  std::optional<int> max_depth;
  std::optional<std::uint64_t> seed;
  std::optional<SampleSequence> sampler;
  StrategyChanges strategy;  // to the scene's
  DefaultDecision decision = DefaultDecision::kNever;
  std::optional<Scattering> scattering;
  std::optional<TransportSetting> transport;
  /// Strategies that will be rendered in turn (WithStrategy), besides the scene's:
  /// kByScene chooses a transport that none of them refuses.
  std::vector<Strategy> compared;
  std::optional<BuildQuality> build;                  // of the BVHs
  std::shared_ptr<const CachedBvh> cached_bvh;        // as in CompileOptions
  std::uint64_t copied_triangles = kCopiedTriangles;  // as in CompileOptions
  std::uint32_t wavefront = 0;                        // paths; 0 = chosen by the plan
  bool aov = false;
  std::optional<Gbuffer> gbuffer;
  bool skip_unsupported = false;
  ImageSettings image;
  int threads = 0;     // 0: all cores
  std::string target;  // SIMD; empty: the best available
};

bool HasTarget(const RenderSettings& settings);

/// The maximum that may be requested.
inline constexpr std::uint64_t kMaxSpp = kMaxSamplesPerPixel;
inline constexpr std::uint32_t kMaxWavefront = 1u << 20;
inline constexpr int kMaxDepth = 1 << 20;
inline constexpr int kMaxThreads = 1024;

/// Applies the overrides to the description; with kByScene it has no transport
/// afterwards. Scales a crop window of the scene to a new resolution. Throws InputError
/// for sizes, windows, depths and sample counts out of range, of either source.
void ApplySettings(const RenderSettings& settings, SceneDescription& scene);

/// Returns whether light-paths=splats is the default of this render, for the integrator
/// of the scene.
bool StartsAtLights(const RenderSettings& settings, const SceneDescription& scene);

/// Returns whether decide=pilot is the default of this render: with kIfLong, from 4
/// seconds on, or from the samples that the trial run is planned for (DecidedBy).
bool DecidesByDefault(const RenderSettings& settings, const SceneDescription& scene);
inline constexpr double kMinSecondsForTrial = 4;

/// Returns the auxiliary planes of such a render.
Auxiliary AuxiliaryOf(const RenderSettings& settings, const Film& film);

CompileOptions CompileOptionsOf(const RenderSettings& settings);
PlanOptions PlanOptionsOf(const RenderSettings& settings, const SceneDescription& scene);

}  // namespace lanelight
