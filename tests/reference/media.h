// Participating media of the reference tracer: analog random walks in one colour channel
// at a time, so that no weight between channels is needed.
#pragma once

#include "tests/reference/geometry.h"

namespace lanelight::reference {

/// One component of a colour.
inline double Channel(Rgb c, int channel) {
  return channel == 0 ? c.x : channel == 1 ? c.y : c.z;
}

/// Three times the channel, the others black: what a path that was lost to this channel
/// with probability 1/3 counts for.
inline Rgb OnlyChannel(int channel) {
  return {channel == 0 ? 3.0 : 0.0, channel == 1 ? 3.0 : 0.0, channel == 2 ? 3.0 : 0.0};
}

/// Absorption and scattering at a point; of a collision, what is emitted as well, as
/// Medium::emission.
struct Coefficients {
  Rgb sigma_a, sigma_s, emission;
};

/// At a point of the world; a grid is interpolated linearly between the centres of
/// voxels, one of NanoVDB between its points, and zero outside of its box.
Coefficients MediumAt(const Medium& medium, Vec3d p);

/// A collision of a ray in a medium.
struct Collision {
  double t = kInfinity;
  Coefficients at;
};

/// The first collision of a channel before t_max, if there is one; grids by null
/// collisions against the largest value of all.
Collision NextCollision(const SceneDescription& scene, Index medium, const Ray& ray,
                        double t_max, int channel, Random& random);

/// exp(-integral of sigma_a + sigma_s) of each channel over the first `length` of the
/// ray, 1 in empty space (kNone): exact where the medium is the same everywhere, else 1
/// or 0, whether a channel meets nothing.
Rgb MediumTransmittance(const SceneDescription& scene, Index medium, const Ray& ray,
                        double length, Random& random);

/// Henyey and Greenstein 1941: density per solid angle of turning by an angle with this
/// cosine.
double PhaseFunction(double g, double cosine);

/// A direction with that density about `forward`.
Vec3d SamplePhaseFunction(double g, Vec3d forward, Random& random);

/// The medium behind a surface, for a ray with direction d; `here` if it bounds none.
Index MediumBehind(const Primitive& primitive, Vec3d normal, Vec3d d, Index here);

}  // namespace lanelight::reference
