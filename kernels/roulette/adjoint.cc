// roulette=adjoint: keeps the expected contribution nu of every path near that of its
// pixel, by roulette below a window around it and by splitting above.
//   nu          |beta / I(pixel)| Psi(cell). Psi is the expected brightness per unit of
//               throughput from this vertex on (a coarse cache over space and
//               orientation), and I the brightness of the pixel, both from a training
//               pass (src/render/train/train_path_values.cc). || is the root mean square
//               over channels
//   estimator   r = nu / (1/3) below the window [1/3, 5/3], nu / (5/3) above, else 1, so
//               that the result is at its nearer edge; window-inl.h. (The middle of the
//               window had up to twice the variance)
//   unbiased    for any Psi and I: they only steer r; the training's samples are not used
//   variance    dark paths end early, bright paths are split; more efficient if Psi
//               varies much along paths (light behind a door). The training pass and the
//               noise of Psi are lost if all paths are alike
//   no data     cells that no training path met: roulette on the throughput
//   cost        two gathers of tables and a hash per vertex; the training pass
//   source      Vorba and Krivanek 2016, "Adjoint-Driven Russian Roulette and Splitting
//               in Light Transport Simulation"
#include "kernels/simd/each_target-inl.h"

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
  return WindowStage<AdjointWindow>(
      "roulette_adjoint", "plays roulette and splitting on the expected contribution",
      Feature::kAdjointRoulette);
}

LANELIGHT_END_KERNELS
