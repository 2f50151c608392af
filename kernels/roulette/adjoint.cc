// roulette=adjoint: keeps the expected contribution nu of every path near that of its
// pixel, by roulette below a window around it and by splitting above.
//   nu          |beta / I(pixel)| Psi(cell), with Psi the brightness that a unit of
//               throughput is expected to gather from this vertex on (a coarse cache over
//               space and orientation), I the brightness of the pixel, both from a pilot
//               pass (src/render/train/train_path_values.cc), and || the root mean square
//               over channels
//   estimator   r = nu / (1/3) below the window [1/3, 5/3], nu / (5/3) above, else 1, so
//               that what remains is at its nearer edge; window-inl.h. (Moving it to the
//               middle plays harder and was measured to have up to twice the variance)
//   unbiased    for any Psi and I: they only steer r; the training's samples are not used
//   variance    paths into the dark end early, paths into the light are split; pays where
//               Psi varies much along paths (light behind a door), loses its training
//               pass and the noise of Psi where all paths are alike
//   no data     cells that no training path met: roulette on the throughput
//   cost        two gathers of tables and a hash per vertex; the training pass
//   source      Vorba and Krivanek 2016, "Adjoint-Driven Russian Roulette and Splitting
//               in Light Transport Simulation"
#include "kernels/simd/each_target-inl.h"

#include "kernels/queue/batch-inl.h"
#include "kernels/roulette/window-inl.h"

LANELIGHT_BEGIN_KERNELS

struct AdjointWindow {
  static HWY_INLINE VF Factor(const Wave& wave, const Slots& slots, V3 beta) {
    const PathValues& values = wave.run->tables->path_values;
    const VF psi = Gather(values.survive.data(), CellOf(values.grid, wave.path, slots));
    const VF nu = hn::Mul(WeightInImage(wave, slots, beta), psi);
    const VF r = hn::IfThenElse(hn::Lt(nu, Splat(1.0f)),
                                hn::Min(hn::Mul(nu, Splat(3.0f)), Splat(1.0f)),
                                hn::Max(hn::Mul(nu, Splat(3.0f / 5)), Splat(1.0f)));
    const MF known = hn::Ge(psi, hn::Zero(DF()));
    return hn::IfThenElse(known, r, ThroughputFactor(wave.path, slots, beta));
  }
};

Stage AdjointRouletteStage() {
  return WindowStage<AdjointWindow>("roulette_adjoint",
                                    "roulette and splitting on the expected contribution",
                                    Feature::kAdjointRoulette);
}

LANELIGHT_END_KERNELS
