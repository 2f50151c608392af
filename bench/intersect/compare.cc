#include "bench/intersect/compare.h"

#include <algorithm>
#include <cmath>

#include "bench/intersect/agreement.h"

namespace lanelight::bench {
namespace {

constexpr double kKeep = 0.85;
constexpr int kScreen = 2;

double Mrays(const RaySet& set, double seconds) {
  return static_cast<double>(set.rays.size()) / seconds * 1e-6;
}

class Comparison {
 public:
  Comparison(const RaySet& set, OurTracer& ours, Peer& peer, const CompareOptions& o)
      : set_(set), ours_(ours), peer_(peer), options_(o), entries_(peer.Entries()) {}

  void Run(SetResult& result) {
    Screen();
    ratios_.resize(entries_.size());
    for (int r = 0; r < options_.repeat; ++r) {
      for (std::size_t e = 0; e < entries_.size(); ++e) {
        if (kept_[e]) Pair(e, r % 2 == 0);
      }
    }
    for (std::size_t e = 0; e < entries_.size(); ++e) result.entries.push_back(Result(e));
    result.best = Best(result.entries, false);
    result.best_robust = Best(result.entries, true);
    result.ours = MedianRangeOf(our_rates_).median;
  }

 private:
  double Rate(std::size_t e) {
    return Mrays(set_, peer_.Trace(e, set_, options_.wave, nullptr));
  }
  double OurRate() {
    our_rates_.push_back(Mrays(set_, ours_.Trace(set_, nullptr)));
    return our_rates_.back();
  }

  void Screen() {
    rates_.resize(entries_.size());
    double best[2] = {0, 0};
    for (std::size_t e = 0; e < entries_.size(); ++e) {
      for (int i = 0; i < kScreen; ++i) rates_[e].push_back(Rate(e));
      double& of_class = best[entries_[e].robust];
      of_class = std::max(of_class, std::ranges::max(rates_[e]));
    }
    for (std::size_t e = 0; e < entries_.size(); ++e) {
      kept_.push_back(std::ranges::max(rates_[e]) >= kKeep * best[entries_[e].robust]);
      if (kept_[e]) rates_[e].clear();
    }
  }

  void Pair(std::size_t e, bool ours_first) {
    double ours = ours_first ? OurRate() : 0;
    rates_[e].push_back(Rate(e));
    if (!ours_first) ours = OurRate();
    ratios_[e].push_back(ours / rates_[e].back());
  }

  EntryResult Result(std::size_t e) const {
    EntryResult out;
    out.entry = entries_[e];
    out.repetitions = static_cast<int>(rates_[e].size());
    out.mrays = MedianRangeOf(rates_[e]).median;
    if (!ratios_[e].empty()) out.ratio = MedianRangeOf(ratios_[e]);
    return out;
  }

  // The fastest is the one that ours gains least on: ratios are steadier than rates.
  std::optional<std::size_t> Best(const std::vector<EntryResult>& all,
                                  bool robust) const {
    std::optional<std::size_t> best;
    for (std::size_t e = 0; e < all.size(); ++e) {
      if (all[e].entry.robust != robust || !kept_[e]) continue;
      if (!best || all[e].ratio.median < all[*best].ratio.median) best = e;
    }
    return best;
  }

  const RaySet& set_;
  OurTracer& ours_;
  Peer& peer_;
  const CompareOptions& options_;
  std::vector<PeerEntry> entries_;
  std::vector<bool> kept_;
  std::vector<double> our_rates_;
  std::vector<std::vector<double>> rates_, ratios_;  // per entry
};

}  // namespace

MedianRange MedianRangeOf(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t n = values.size();
  return {(values[(n - 1) / 2] + values[n / 2]) / 2, values.front(), values.back()};
}

SetResult Compare(const Mesh& mesh, const CompiledScene& scene, const RaySet& whole,
                  Peer* peer, const CompareOptions& options) {
  OurTracer ours(scene, options.wave);
  const double seconds = ours.Trace(whole, nullptr);
  const auto step = static_cast<std::size_t>(std::ceil(seconds / options.max_seconds));
  const RaySet set = EveryWave(whole, static_cast<std::size_t>(options.wave), step);
  SetResult result;
  result.mesh = mesh.name;
  result.set = set.name;
  result.triangles = mesh.triangles.size();
  result.rays = set.rays.size();
  std::vector<BenchHit> hits;
  ours.Trace(set, &hits);
  result.agreement = CheckHits(scene, set, hits, peer, options.wave);
  if (peer) {
    Comparison(set, ours, *peer, options).Run(result);
    return result;
  }
  std::vector<double> rates;
  for (int r = 0; r < options.repeat; ++r) {
    rates.push_back(Mrays(set, ours.Trace(set, nullptr)));
  }
  result.ours = MedianRangeOf(rates).median;
  return result;
}

}  // namespace lanelight::bench
