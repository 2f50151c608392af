// One pilot pass: a few samples of some pixels, kept in memory as they are.
#pragma once

#include <vector>

#include "src/prepare/path_values.h"
#include "src/wavefront/plan.h"
#include "src/path/wave.h"

namespace lanelight {

/// Pixels of a pass, and samples of each: at least four, so that it shows the
/// variance within a pixel.
struct PilotWork {
  static constexpr std::uint32_t kLeastSpp = 4;
  std::vector<std::uint32_t> pixels;  // y * width + x
  std::uint32_t spp = kLeastSpp;

  std::size_t samples() const { return pixels.size() * spp; }
};

/// What a recording pass knows of a sample (kernels/roulette/record.cc).
struct PilotRecord {
  struct Vertex {
    std::uint32_t cell;
    float at, got;
  };
  Vertex vertices[kPilotVertices];
  float end, depth;
  float risk[3];

  /// What roulette on the throughput would add to the square of `end`, on average; zero
  /// where rounding could have made it.
  double Risk() const {
    const double square = double{end} * end * risk[0];
    const double added = square - 2.0 * end * risk[1] + risk[2];
    return added > 1e-5 * square ? added : 0;
  }
};

struct PilotSamples {
  std::vector<Vec3f> colors;         // of a pixel one after the other
  std::vector<PilotRecord> records;  // as many, if recorded
  std::uint64_t rays_closest = 0, rays_shadow = 0;

  /// Of a sample, in rays that find the closest hit and lead to shading there; one that
  /// only asks for a hit takes about half the time.
  double Cost() const {
    return (double(rays_closest) + 0.5 * double(rays_shadow)) / double(colors.size());
  }
};

/// About `samples` samples (at least four): spread evenly over the rendered window.
PilotWork MakePilotWork(const CompiledScene& scene, std::uint64_t samples);

/// About a sixteenth of it.
PilotWork FewOf(const PilotWork& work);

PilotSamples RunPilotPass(const CompiledScene& scene, const PlanOptions& options,
                          const RunParameters& run, const PilotWork& work);

}  // namespace lanelight
