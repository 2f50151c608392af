// Mrays per second of processor time of the intersect stages on ray sets of meshes, one
// thread, side by side with Embree 3 if it was found at build time. Every mode traces the
// same rays; modes are interleaved and the median of the repetitions is printed. Hits are
// compared with double precision on a sample and with Embree on all rays.
#include <fmt/format.h>

#include <algorithm>
#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>

#include "bench/cpu_clock.h"
#include "bench/mesh.h"
#include "bench/ray_sets.h"
#include "kernels/simd/target.h"
#include "src/core/parallel.h"
#include "tests/intersect/brute_force.h"
#ifdef LANELIGHT_BENCH_EMBREE
#include "bench/embree_peer.h"
#endif

namespace lanelight::bench {
namespace {

struct Options {
  std::string folder = "../shared/meshes", target;
  std::vector<std::string> meshes;
  int size = 384, repeat = 7, wave = 2048;
  bool embree = true;
  int few = -1;
};

double Median(std::vector<double> v) {
  std::nth_element(v.begin(), v.begin() + v.size() / 2, v.end());
  return v[v.size() / 2];
}

// Seconds in the stage over all waves; distances (closest) or 0 / inf (shadow).
double TraceOurs(const CompiledScene& scene, const RaySet& set, int wave,
                 std::vector<float>* t, std::vector<std::uint32_t>* prim) {
  static std::map<std::pair<const CompiledScene*, int>, std::unique_ptr<WaveFixture>>
      cache;
  auto& fixture = cache[{&scene, wave}];
  if (!fixture) fixture = std::make_unique<WaveFixture>(scene, wave);
  const Stage stage = set.shadow ? ShadowTrianglesStage() : IntersectTrianglesStage();
  const StageFn kernel = stage.resolve({});
  double seconds = 0;
  for (std::size_t at = 0; at < set.rays.size(); at += wave) {
    const std::size_t end = std::min(set.rays.size(), at + wave);
    const std::vector<TestRay> part(set.rays.begin() + at, set.rays.begin() + end);
    if (set.shadow) {
      fixture->SetShadowRays(part);
    } else {
      fixture->SetRays(part);
    }
    const CpuTimer timer;
    kernel(fixture->wave);
    seconds += timer.Seconds();
    if (!t) continue;
    const PathColumns& p = fixture->wave.path;
    if (set.shadow) {
      std::fill(t->begin() + at, t->begin() + end, 0.0f);
      const Queue& open = fixture->wave.queue(QueueId::kShadow);
      for (std::uint32_t i = 0; i < open.size; ++i) (*t)[at + open.items[i]] = INFINITY;
    } else {
      std::copy(p.t, p.t + part.size(), t->begin() + at);
      std::copy(p.prim, p.prim + part.size(), prim->begin() + at);
    }
  }
  return seconds;
}

// Share of a sample of rays whose hit differs from double precision by more than 1e-4.
int CountWrong(const CompiledScene& scene, const RaySet& set, const std::vector<float>& t,
               int sample) {
  int wrong = 0;
  const std::size_t step = std::max<std::size_t>(1, set.rays.size() / sample);
  for (std::size_t i = 0; i < set.rays.size(); i += step) {
    const TestRay& r = set.rays[i];
    const auto hit = brute::Closest(scene.geometry.triangles, brute::ToDouble(r.o),
                                    brute::ToDouble(r.d));
    if (set.shadow) {
      wrong += (hit.t < r.t_max) != (t[i] == 0);
    } else {
      wrong += std::isinf(hit.t) ? !std::isinf(t[i])
                                 : !(std::abs(hit.t - t[i]) <= 1e-4 * (1 + hit.t));
    }
  }
  return wrong;
}

double Mrays(const RaySet& set, double seconds) {
  return static_cast<double>(set.rays.size()) / seconds * 1e-6;
}

void BenchSet(const Options& o, const CompiledScene& scene, const RaySet& set,
              [[maybe_unused]] void* peer_pointer) {
  std::vector<float> t(set.rays.size());
  std::vector<std::uint32_t> prim(set.rays.size());
  TraceOurs(scene, set, o.wave, &t, &prim);
  const int sample =
      static_cast<int>(2e7 / static_cast<double>(scene.geometry.triangles.size() + 1e4));
  const int wrong = CountWrong(scene, set, t, sample);
  std::vector<double> ours;
  std::string peers = "", agreement;
#ifdef LANELIGHT_BENCH_EMBREE
  auto* peer = static_cast<EmbreePeer*>(peer_pointer);
  std::map<std::string, std::vector<double>> times;
  const auto modes =
      peer ? peer->Modes(set.shadow, set.name == "primary") : std::vector<std::string>();
  if (peer) {
    std::vector<PeerHit> hits;
    peer->Trace("high 1", set.shadow, set.rays, &hits);
    int differ = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
      const bool same = std::isinf(hits[i].t) == std::isinf(t[i]) &&
                        (set.shadow || std::isinf(t[i]) || hits[i].prim == prim[i]);
      differ += !same;
    }
    agreement = fmt::format("{:7.1f}", 1e6 * differ / static_cast<double>(hits.size()));
  }
#endif
  for (int r = 0; r < o.repeat; ++r) {
    ours.push_back(TraceOurs(scene, set, o.wave, nullptr, nullptr));
#ifdef LANELIGHT_BENCH_EMBREE
    for (const auto& mode : modes) {
      times[mode].push_back(peer->Trace(mode, set.shadow, set.rays, nullptr));
    }
#endif
  }
  const double mine = Mrays(set, Median(ours));
#ifdef LANELIGHT_BENCH_EMBREE
  std::string best_name;
  double best = 0, single = 0;
  for (const auto& [mode, seconds] : times) {
    const double rate = Mrays(set, Median(seconds));
    if (mode == "high 1") single = rate;
    if (rate > best) best = rate, best_name = mode;
  }
  if (peer) {
    peers = fmt::format("{:8.2f} {:8.2f} {:>13} {:6.2f}  {}", single, best, best_name,
                        mine / best, agreement);
  }
#endif
  fmt::print("{:10} {:8} {:8} {:8.2f} {:5}/{:<5} {}\n", "", set.name, set.rays.size(),
             mine, wrong, sample, peers);
  std::fflush(stdout);
}

void BenchMesh(const Options& o, const Mesh& mesh) {
  Geometry geometry = ToGeometry(mesh);
  AccelOptions accel;
  if (o.few >= 0) accel.few_triangles = static_cast<std::uint32_t>(o.few);
  const CompiledScene scene = MakeScene(std::move(geometry), accel);
  const ThreadLimit one(1);
  const CpuTimer timer;
  BuildAccel(scene.geometry, accel);
  const double seconds = timer.Seconds();
  const auto n = static_cast<double>(mesh.triangles.size());
  fmt::print("{:10} {} triangles, built in {:.3f} s (1 thread), {:.1f} bytes/triangle\n",
             mesh.name, mesh.triangles.size(), seconds,
             static_cast<double>(scene.accel.Bytes()) / n);
  void* peer = nullptr;
#ifdef LANELIGHT_BENCH_EMBREE
  std::unique_ptr<EmbreePeer> embree;
  if (o.embree) {
    embree = std::make_unique<EmbreePeer>(mesh);
    peer = embree.get();
  }
#endif
  for (const RaySet& set : RayMaker(mesh, scene).All(o.size))
    BenchSet(o, scene, set, peer);
}

Mesh Find(const Options& o, const std::string& name) {
  if (name == "cornell") return CornellBox();
  if (name.starts_with("ball")) return Ball(std::stoi(name.substr(4)));
  return LoadMesh(o.folder, name);
}

int Main(int argc, char** argv) {
  Options o;
  o.meshes = {"cornell", "ball200", "ball2000", "bunny", "igea", "nefertiti"};
  CLI::App app("Mrays/s of the intersect stages");
  app.add_option("--meshes", o.folder, "folder with NAME.ply and NAME.cam");
  app.add_option("--target", o.target, "SIMD target");
  app.add_option("--size", o.size, "image width and height, a multiple of 16");
  app.add_option("--repeat", o.repeat, "repetitions");
  app.add_option("--wave", o.wave, "rays per wave");
  app.add_option("--few", o.few, "largest triangle count without a tree");
  app.add_flag("!--no-embree", o.embree, "leave Embree out");
  app.add_option("names", o.meshes, "meshes; cornell and ballN are generated");
  CLI11_PARSE(app, argc, argv);
  ForceTarget(o.target);
  fmt::print("target {}, {} lanes, waves of {} rays, median of {}\n", CurrentTarget(),
             CurrentLanes(), o.wave, o.repeat);
#ifndef LANELIGHT_BENCH_EMBREE
  fmt::print("Embree 3 was not found when this was built: no comparison\n");
#endif
  fmt::print("{:10} {:8} {:>8} {:>8} {:>11} {:>8} {:>8} {:>13} {:>6}  {}\n", "mesh",
             "rays", "count", "Mray/s", "wrong", "embree 1", "best", "mode", "ratio",
             "differ/1e6");
  for (const std::string& name : o.meshes) BenchMesh(o, Find(o, name));
  return 0;
}

}  // namespace
}  // namespace lanelight::bench

int main(int argc, char** argv) {
  try {
    return lanelight::bench::Main(argc, argv);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
}
