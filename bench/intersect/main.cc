// Measures rays per second of processor time of the intersect stages on ray sets of
// meshes, on one thread. Every entry of Embree 3 is measured too, if it was found at
// build time. bench/README.md describes the method.
#include <fmt/format.h>

#include <cstdio>
#include <fstream>

#include "bench/intersect/options.h"
#include "bench/intersect/results.h"
#include "bench/intersect/scene_rays.h"
#include "src/base/core/parallel.h"
#include "src/render/job/machine_json.h"
#include "tests/support/test_target.h"

namespace lanelight::bench {
namespace {

class RayBench {
 public:
  explicit RayBench(const Options& o) : o_(o) {}

  void BenchMesh(const std::string& name) {
    const Mesh mesh = FindMesh(o_, name);
    const CompiledScene scene = MakeScene(ToGeometry(mesh), o_.Accel());
    std::vector<RaySet> sets = MakeRaySets(mesh, scene, o_.size);
    std::erase_if(sets, [&](const RaySet& set) { return !o_.Wants(set); });
    Bench(mesh, scene, sets);
  }
  void BenchScene(const std::string& path) {
    const auto pixels = static_cast<std::size_t>(o_.size) * std::size_t(o_.size);
    const SceneRays rays = RecordRays(path, pixels);
    Bench(rays.mesh, *rays.scene, rays.sets);
  }

 private:
  void Bench(const Mesh& mesh, const CompiledScene& scene,
             const std::vector<RaySet>& sets) {
    const std::unique_ptr<Peer> peer = o_.MakePeer(mesh);
    for (const RaySet& set : sets) {
      results_.push_back(Compare(mesh, scene, set, peer.get(), o_.compare));
      PrintSet(results_.back());
    }
    Write();  // a long run may be cut short
  }

  void Write() const {
    if (!o_.csv.empty()) WriteSetsCsv(o_.csv, TestTarget().name(), results_);
    if (o_.json.empty()) return;
    const nlohmann::json out = {{"schema", 1},
                                {"target", TestTarget().name()},
                                {"wave", o_.compare.wave},
                                {"repeat", o_.compare.repeat},
                                {"closed", !o_.open},
                                {"sets", SetsJson(results_)}};
    std::ofstream(o_.json) << out.dump(2) << '\n';
  }

  const Options& o_;
  std::vector<SetResult> results_;
};

void BenchBuild(const Options& o, const std::string& name, nlohmann::json& out) {
  const Mesh mesh = FindMesh(o, name);
  const CompiledScene scene = MakeScene(ToGeometry(mesh), o.Accel());
  const std::vector<BuildResult> builds = BenchBuilds(
      mesh, scene.geometry, o.Accel(), TestTarget().name(), o.embree, o.compare.repeat);
  for (const BuildResult& r : builds) PrintBuild(r);
  std::vector<ThreadsResult> threads;
  for (const RaySet& set : MakeRaySets(mesh, scene, o.size)) {
    if (!o.Wants(set)) continue;
    threads.push_back(BenchThreads(mesh, scene, set, o.compare));
    PrintThreads(threads.back());
  }
  AddBuilds(builds, threads, out);
}

int MainBuild(const Options& o) {
  fmt::print(
      "{}; CPU seconds of one thread: median of {}; wall clock with 1 and 2 "
      "threads: least\n",
      TestTarget().name(), o.compare.repeat);
  PrintBuildHeader();
  nlohmann::json out = {
      {"schema", 1}, {"target", TestTarget().name()}, {"machine", ToJson(ThisMachine())}};
  for (const std::string& name : o.meshes) BenchBuild(o, name, out);
  if (!o.json.empty()) std::ofstream(o.json) << out.dump(2) << '\n';
  return 0;
}

void PrintSetting(const Options& o) {
  const std::unique_ptr<Peer> peer = o.MakePeer(CornellBox());
  fmt::print("ours: {}, {} lanes; peer: {}\n", TestTarget().name(), TestTarget().lanes(),
             peer       ? peer->Name()
             : o.embree ? "none, Embree 3 was not found at build time"
                        : "none");
  fmt::print(
      "one thread, waves of {} rays, {}; ratio: ours / entry, median of {} pairs "
      "and [least, largest]\n",
      o.compare.wave, o.open ? "open" : "each mesh in a closed box", o.compare.repeat);
}

int MainRays(const Options& o) {
  const ThreadLimit one(1);
  PrintSetting(o);
  PrintSetHeader();
  RayBench bench(o);
  for (const std::string& path : o.scenes) bench.BenchScene(path);
  for (const std::string& name : o.meshes) bench.BenchMesh(name);
  return 0;
}

int Main(int argc, char** argv) {
  Options o;
  CLI::App app("Mrays/s of the intersect stages, beside Embree 3", "bench_intersect");
  AddOptions(app, o);
  CLI11_PARSE(app, argc, argv);
  if (o.meshes.empty() && o.scenes.empty()) {
    o.meshes = {"bunny", "igea",  "nefertiti", "igea4",   "igea16", "terrain",
                "soup",  "flake", "sticks",    "needles", "stadium"};
  }
  CheckMeshes(o);
  ForceTarget(o.target);
  fmt::print("{}\n", MachineText(ThisMachine()));
  return o.build ? MainBuild(o) : MainRays(o);
}

}  // namespace
}  // namespace lanelight::bench

int main(int argc, char** argv) {
  try {
    return lanelight::bench::Main(argc, argv);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "bench_intersect: %s\n", e.what());
    return 1;
  }
}
