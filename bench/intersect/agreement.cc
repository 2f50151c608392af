#include "bench/intersect/agreement.h"

#include <algorithm>
#include <cmath>

#include "tests/support/brute_force.h"

namespace lanelight::bench {
namespace {

// Distances agree to this share of themselves, and of the coordinates relative to the
// origin of the triangle that was hit, divided by the cosine: what float arithmetic
// leaves of a ray at a large triangle close by.
constexpr double kDistance = 1e-4, kCoordinate = 1e-6;

double Tolerance(const TriangleRecord& hit, const TestRay& r, double t) {
  const Vec3d o = brute::ToDouble(r.o), d = brute::ToDouble(r.d);
  Vec3d p[3];
  double reach = Length(o);
  for (int k = 0; k < 3; ++k) {
    p[k] = Vec3d{hit.p[k][0], hit.p[k][1], hit.p[k][2]} - o;
    reach = std::max(reach, Length(p[k]));
  }
  const Vec3d n = Cross(p[1] - p[0], p[2] - p[0]);
  const double cosine = std::abs(Dot(n, d)) / (Length(n) * Length(d));
  return kDistance * t + kCoordinate * reach / cosine;
}

bool IsWrong(const CompiledScene& scene, const TestRay& r, bool shadow,
             const BenchHit& ours) {
  const auto truth = brute::Closest(scene.geometry.triangles, brute::ToDouble(r.o),
                                    brute::ToDouble(r.d));
  if (shadow) return (truth.t < r.t_max) != (ours.t == 0);
  if (std::isinf(truth.t)) return !std::isinf(ours.t);
  const double maximum = Tolerance(scene.geometry.triangles[truth.prim], r, truth.t);
  return !(std::abs(truth.t - ours.t) <= maximum);
}

enum class Match { kSame, kTie, kDiffer };

Match Compare(const BenchHit& a, const BenchHit& b, bool shadow) {
  if (std::isinf(a.t) != std::isinf(b.t)) return Match::kDiffer;
  if (shadow || std::isinf(a.t) || a.prim == b.prim) return Match::kSame;
  return std::abs(a.t - b.t) <= 1e-5f * b.t ? Match::kTie : Match::kDiffer;
}

// {differences, ties} per million rays.
std::pair<double, double> PerMillion(const std::vector<BenchHit>& ours,
                                     const std::vector<BenchHit>& theirs, bool shadow) {
  double differ = 0, ties = 0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const Match match = Compare(ours[i], theirs[i], shadow);
    differ += match == Match::kDiffer;
    ties += match == Match::kTie;
  }
  const double unit = 1e6 / static_cast<double>(ours.size());
  return {differ * unit, ties * unit};
}

}  // namespace

Agreement CheckHits(const CompiledScene& scene, const RaySet& set,
                    const std::vector<BenchHit>& hits, Peer* peer, int wave) {
  Agreement out;
  // About half a second.
  constexpr double kTests = 5e7;
  const double maximum = kTests / (double(scene.geometry.triangles.size()) + 1e4);
  const auto step = static_cast<std::size_t>(
      std::max(1.0, std::ceil(double(set.rays.size()) / std::max(maximum, 10.0))));
  for (std::size_t i = 0; i < set.rays.size(); i += step) {
    ++out.sample;
    out.wrong += IsWrong(scene, set.rays[i], set.shadow, hits[i]);
  }
  if (!peer) return out;
  const std::vector<PeerEntry> entries = peer->Entries();
  std::vector<BenchHit> theirs;
  for (std::size_t e = 0; e < entries.size(); ++e) {
    const bool robust = entries[e].name == "high robust 1";
    if (!robust && entries[e].name != "high 1") continue;
    peer->Trace(e, set, wave, &theirs);
    const auto [differ, ties] = PerMillion(hits, theirs, set.shadow);
    (robust ? out.differ_robust : out.differ) = differ;
    (robust ? out.ties_robust : out.ties) = ties;
  }
  return out;
}

}  // namespace lanelight::bench
