// Media that vary within a box, for a vector of rays in the same medium: the cells of the
// majorant grid along rays, and the coefficients at a point.
#ifndef LANELIGHT_MEDIA_GRID_INL_H_
#define LANELIGHT_MEDIA_GRID_INL_H_

#include <limits>

#include "kernels/media/voxels-inl.h"

LANELIGHT_BEGIN_KERNELS

/// Absorption and scattering at a point.
struct Coefficients {
  V3 sigma_a, sigma_s;
};

/// One grid and the medium it belongs to.
struct GridMedium {
  const MediumGrid& grid;
  const MediumRecord& medium;
  V3 sigma_t, sigma_s;  // of a density of 1, as the paths carry them
  V3 place = {};        // of their wavelengths, where colours are by voxel
  bool spectral;        // they carry wavelengths

  /// Medium `i` of the table, which has a grid, for a batch of paths.
  LANELIGHT_INLINE GridMedium(const Wave& wave, std::size_t i, const Slots& slots)
      : grid(wave.media->grids[static_cast<std::size_t>(wave.media->media[i].grid)]),
        medium(wave.media->media[i]),
        spectral(wave.path.wavelength != nullptr) {
    if (spectral && IsColored()) place = Places(wave, slots);
    const Media lanes(*wave.media, hn::Set(DI(), static_cast<int32_t>(i)));
    sigma_t = lanes.SigmaT(wave, slots);
    sigma_s = lanes.SigmaS(wave, slots);
  }

  LANELIGHT_INLINE bool IsColored() const { return grid.source == MediumSource::kColors; }
  /// Majorants of the channels are the cell's value times these.
  LANELIGHT_INLINE V3 MajorantScale() const {
    if (IsColored()) return Splat3(1, 1, 1);
    return sigma_t;
  }
  LANELIGHT_INLINE V3 Map(V3 v, bool point) const {
    const float* m = grid.box_from_scene;
    const auto row = [&](int r) HWY_ATTR {
      const VF linear =
          Dot(V3{Splat(m[4 * r]), Splat(m[4 * r + 1]), Splat(m[4 * r + 2])}, v);
      return point ? hn::Add(linear, Splat(m[4 * r + 3])) : linear;
    };
    return {row(0), row(1), row(2)};
  }
  /// Returns the coefficients at `p` of the box, in the lanes of `mask`.
  LANELIGHT_INLINE Coefficients At(V3 p, MF mask) const {
    if (IsColored() && spectral) {
      V3 v[2];
      InterpolateSpectra<2>(grid.size, grid.values.data(), place, p, v);
      return {v[0], v[1]};
    }
    if (IsColored()) {
      VF v[6];
      Interpolate(grid.size, grid.values.data(), 6, p, v);
      return {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
    }
    const VF density = Density(p, mask);
    const V3 t = Mul(sigma_t, density), s = Mul(sigma_s, density);
    return {t - s, s};
  }

 private:
  LANELIGHT_INLINE VF Density(V3 p, MF mask) const {
    if (grid.source == MediumSource::kCloud) return CloudDensity(grid.cloud, p);
    if (grid.source == MediumSource::kSparse) return SparseValue(grid.sparse, p, mask);
    VF density;
    Interpolate(grid.size, grid.values.data(), 1, p, &density);
    return density;
  }
};

/// Rays on their way through the cells of a majorant grid (Amanatides and Woo 1987).
/// Distances are those of the scene.
struct CellWalk {
  V3 o, d;      // in the box
  VF t, end;    // position of the ray, and of its end or its exit from the box
  VF next[3];   // position of the next crossing along each axis
  VF delta[3];  // distance between crossings
  VI cell[3], step[3];

  LANELIGHT_INLINE CellWalk(const GridMedium& medium, V3 origin, V3 direction,
                            VF length) {
    o = medium.Map(origin, true), d = medium.Map(direction, false);
    t = hn::Zero(DF()), end = length;
    const VF from[3] = {o.x, o.y, o.z}, along[3] = {d.x, d.y, d.z};
    for (int a = 0; a < 3; ++a) Clip(from[a], along[a]);
    for (int a = 0; a < 3; ++a) Start(a, from[a], along[a]);
  }
  LANELIGHT_INLINE MF IsInside() const { return hn::Lt(t, end); }
  LANELIGHT_INLINE V3 Point(VF at) const { return MulAdd(d, at, o); }
  LANELIGHT_INLINE VF Majorant(const MediumGrid& grid) const {
    const DI di;
    const VI size = hn::Set(di, kMajorantCells), zero = hn::Zero(di);
    const VI last = hn::Set(di, kMajorantCells - 1);
    const auto in = [&](int a) HWY_ATTR { return hn::Min(hn::Max(cell[a], zero), last); };
    const VI index = hn::Add(in(0), hn::Mul(size, hn::Add(in(1), hn::Mul(size, in(2)))));
    return Gather(grid.majorants.data(), index);
  }
  /// Advances to a collision in dt, in the lanes of `mask`, where `sigma` is the density
  /// of collisions. If collisions are closer together than distances are rounded, adding
  /// dt would change nothing and the walk would not end. It then advances by at least 8
  /// ulps, or by an invisible fraction of the box.
  LANELIGHT_INLINE void Advance(MF mask, VF sigma, VF dt) {
    const VF across = hn::Mul(Splat(static_cast<float>(kMajorantCells)),
                              hn::Min(delta[0], hn::Min(delta[1], delta[2])));
    const MF stuck = hn::Gt(hn::Mul(sigma, hn::Max(t, across)), Splat(0x1p25f));
    const VF minimum =
        hn::Max(hn::Mul(t, Splat(0x1p-20f)), hn::Mul(across, Splat(0x1p-16f)));
    const VF step = hn::Max(dt, hn::IfThenElseZero(stuck, minimum));
    t = hn::IfThenElse(mask, hn::Add(t, step), t);
  }
  /// Returns the distance at which the ray leaves the cell.
  LANELIGHT_INLINE VF Exit() const {
    return hn::Min(end, hn::Min(next[0], hn::Min(next[1], next[2])));
  }
  /// Advances to the exit of the cell, in the lanes of `mask`. The walk ends more than a
  /// cell behind the box, which only rounding reaches: cells may be smaller than an ulp.
  LANELIGHT_INLINE void Cross(MF mask) {
    const DI di;
    const VI before = hn::Set(di, -1), behind = hn::Set(di, kMajorantCells);
    const VF exit = Exit();
    t = hn::IfThenElse(mask, exit, t);
    for (int a = 0; a < 3; ++a) {
      const MF crosses = hn::And(mask, hn::Le(next[a], exit));
      const auto only = hn::RebindMask(di, crosses);
      cell[a] = hn::Add(cell[a], hn::IfThenElseZero(only, step[a]));
      next[a] = hn::Add(next[a], hn::IfThenElseZero(crosses, delta[a]));
      const auto off = hn::Or(hn::Lt(cell[a], before), hn::Gt(cell[a], behind));
      end = hn::IfThenElse(hn::RebindMask(DF(), off), t, end);
    }
  }

 private:
  LANELIGHT_INLINE void Clip(VF from, VF along) {
    const VF zero = hn::Zero(DF()), one = Splat(1.0f);
    const MF moves = hn::Ne(along, zero);
    const VF inverse = hn::Div(one, along);
    const VF a = hn::Mul(hn::Neg(from), inverse);
    const VF b = hn::Mul(hn::Sub(one, from), inverse);
    const MF within = hn::And(hn::Ge(from, zero), hn::Le(from, one));
    const VF stays = hn::IfThenElse(within, end, zero);  // no box for the others
    t = hn::IfThenElse(moves, hn::Max(t, hn::Min(a, b)), t);
    end = hn::IfThenElse(moves, hn::Min(end, hn::Max(a, b)), stays);
  }
  LANELIGHT_INLINE void Start(int a, VF from, VF along) {
    const DI di;
    const VF cells = Splat(static_cast<float>(kMajorantCells));
    const VF at = hn::Mul(hn::MulAdd(along, t, from), cells);
    const VF floor = hn::Clamp(hn::Floor(at), Splat(0), Splat(kMajorantCells - 1.0f));
    const MF forward = hn::Gt(along, hn::Zero(DF()));
    const VF far = Splat(std::numeric_limits<float>::infinity());
    const MF moves = hn::Ne(along, hn::Zero(DF()));
    const VF edge = hn::Add(floor, hn::IfThenElseZero(forward, Splat(1.0f)));
    const VF crossing = hn::Div(hn::Sub(hn::Div(edge, cells), from), along);
    next[a] = hn::IfThenElse(moves, hn::Max(crossing, t), far);
    delta[a] = hn::Div(Splat(1.0f / kMajorantCells), hn::Abs(along));
    cell[a] = hn::ConvertTo(di, floor);
    step[a] =
        hn::IfThenElse(hn::RebindMask(di, forward), hn::Set(di, 1), hn::Set(di, -1));
  }
};

LANELIGHT_END_KERNELS

#endif
