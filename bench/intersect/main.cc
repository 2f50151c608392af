// Mrays per second of processor time of the intersect stages on ray sets of meshes, one
// thread, side by side with every entry of Embree 3 if it was found at build time. See
// bench/README.md for what is measured and how.
#include <fmt/format.h>

#include <algorithm>
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>

#include "bench/intersect/results.h"
#include "kernels/simd/target.h"
#include "src/core/error.h"
#include "src/core/parallel.h"

namespace lanelight::bench {
namespace {

struct Options {
  std::string folder = "../shared/meshes", generated = "out/meshes";
  std::string target, embree_config, csv, json;
  std::vector<std::string> meshes = {"bunny",  "igea",    "nefertiti", "igea4",
                                     "igea16", "terrain", "soup",      "flake",
                                     "sticks", "needles", "stadium"};
  std::vector<std::string> sets = kRaySets;
  CompareOptions compare;
  int size = 384;
  bool embree = true, open = false, build = false;
  int few = -1;

  AccelOptions Accel() const {
    AccelOptions accel;
    if (few >= 0) accel.few_triangles = static_cast<std::uint32_t>(few);
    return accel;
  }
  std::unique_ptr<Peer> MakePeer(const Mesh& mesh) const {
    return embree ? MakeEmbree(mesh, CurrentTarget(), embree_config) : nullptr;
  }
};

// NAME4, NAME16: subdivided once or twice.
int Levels(const std::string& name) {
  return name.ends_with("16") ? 2 : name.ends_with("4") ? 1 : 0;
}
std::string FileName(const std::string& name) {
  return name.substr(0, name.size() - static_cast<std::size_t>(Levels(name)));
}
bool IsBuiltIn(const std::string& name) {
  return name == "cornell" || name.starts_with("ball");
}

std::string FolderOf(const Options& o, const std::string& name) {
  for (const std::string& folder : {o.folder, o.generated}) {
    if (HasMesh(folder, name)) return folder;
  }
  throw InputError(fmt::format(
      "no {}.ply in {} or {}. Write one of the generated meshes with "
      "`scenes/generate {} --size 1000000 --out {}`, or name a folder with --meshes",
      name, o.folder, o.generated, name, o.generated));
}

Mesh FindMesh(const Options& o, const std::string& name) {
  if (name == "cornell") return CornellBox();
  if (IsBuiltIn(name)) return Ball(std::stoi(name.substr(4)));
  Mesh mesh = LoadMesh(FolderOf(o, FileName(name)), FileName(name));
  for (int i = 0; i < Levels(name); ++i) Subdivide(mesh);
  mesh.name = name;
  if (!o.open) Enclose(mesh);
  return mesh;
}

std::vector<SetResult> BenchMesh(const Options& o, const std::string& name) {
  const Mesh mesh = FindMesh(o, name);
  const CompiledScene scene = MakeScene(ToGeometry(mesh), o.Accel());
  const std::unique_ptr<Peer> peer = o.MakePeer(mesh);
  std::vector<SetResult> results;
  for (const RaySet& set : MakeRaySets(mesh, scene, o.size)) {
    if (std::ranges::find(o.sets, set.name) == o.sets.end()) continue;
    results.push_back(Compare(mesh, scene, set, peer.get(), o.compare));
    PrintSet(results.back());
  }
  return results;
}

void BenchBuild(const Options& o, const std::string& name, nlohmann::json& out) {
  const Mesh mesh = FindMesh(o, name);
  const CompiledScene scene = MakeScene(ToGeometry(mesh), o.Accel());
  const std::vector<BuildResult> builds =
      BenchBuilds(mesh, scene.geometry, CurrentTarget(), o.embree, o.compare.repeat);
  for (const BuildResult& r : builds) PrintBuild(r);
  std::vector<ThreadsResult> threads;
  for (const RaySet& set : MakeRaySets(mesh, scene, o.size)) {
    if (std::ranges::find(o.sets, set.name) == o.sets.end()) continue;
    threads.push_back(BenchThreads(mesh, scene, set, o.compare));
    PrintThreads(threads.back());
  }
  AddBuilds(builds, threads, out);
}

int MainBuild(const Options& o) {
  fmt::print(
      "{}; CPU seconds of one thread: median of {}; wall clock with 1 and 2 "
      "threads: least\n",
      CurrentTarget(), o.compare.repeat);
  PrintBuildHeader();
  nlohmann::json out = {{"schema", 1}, {"target", CurrentTarget()}};
  for (const std::string& name : o.meshes) BenchBuild(o, name, out);
  if (!o.json.empty()) std::ofstream(o.json) << out.dump(2) << '\n';
  return 0;
}

void PrintSetting(const Options& o) {
  const std::unique_ptr<Peer> peer = o.MakePeer(CornellBox());
  fmt::print("ours: {}, {} lanes; peer: {}\n", CurrentTarget(), CurrentLanes(),
             peer       ? peer->Name()
             : o.embree ? "none, Embree 3 was not found at build time"
                        : "none");
  fmt::print(
      "one thread, waves of {} rays, {}; ratio: ours / entry, median of {} pairs "
      "and [least, largest]\n",
      o.compare.wave, o.open ? "open" : "each mesh in a closed box", o.compare.repeat);
}

void Write(const Options& o, const std::vector<SetResult>& results) {
  if (!o.csv.empty()) WriteSetsCsv(o.csv, CurrentTarget(), results);
  if (o.json.empty()) return;
  const nlohmann::json out = {{"schema", 1},
                              {"target", CurrentTarget()},
                              {"wave", o.compare.wave},
                              {"repeat", o.compare.repeat},
                              {"closed", !o.open},
                              {"sets", SetsJson(results)}};
  std::ofstream(o.json) << out.dump(2) << '\n';
}

void AddOptions(CLI::App& app, Options& o) {
  app.add_option("MESH", o.meshes,
                 "meshes: NAME of a folder, NAME4 or NAME16 (subdivided once or twice), "
                 "cornell, ballN (about N triangles)");
  app.add_option("--meshes", o.folder, "folder with NAME.ply and NAME.cam");
  app.add_option("--generated", o.generated, "second folder, of scenes/generate");
  app.add_option("--sets", o.sets, "ray sets")
      ->delimiter(',')
      ->check(CLI::IsMember(kRaySets));
  app.add_option("--target", o.target, "SIMD target; limits Embree likewise");
  app.add_option("--size", o.size, "image width and height")
      ->check(CLI::Range(16, 8192) & CLI::Validator(
                                         [](std::string& text) {
                                           return std::stoi(text) % 16 == 0
                                                      ? ""
                                                      : "not a multiple of 16";
                                         },
                                         "MULTIPLE OF 16"));
  app.add_option("--repeat", o.compare.repeat, "pairs of runs")
      ->check(CLI::Range(1, 999));
  app.add_option("--wave", o.compare.wave, "rays per wave")
      ->check(CLI::Range(1, 1 << 20));
  app.add_option("--few", o.few, "largest triangle count without a tree");
  app.add_flag("--open", o.open, "leave the box around the meshes out");
  app.add_flag("--build", o.build,
               "builds instead of rays: time, memory, and 1 against 2 threads");
  app.add_flag("!--no-embree", o.embree, "leave Embree out");
  app.add_option("--embree-config", o.embree_config,
                 "more for rtcNewDevice, e.g. frequency_level=simd512");
  app.add_option("--csv", o.csv, "write every entry's figures here");
  app.add_option("--json", o.json, "the same as JSON");
}

int Main(int argc, char** argv) {
  Options o;
  CLI::App app("Mrays/s of the intersect stages, beside Embree 3", "bench_intersect");
  AddOptions(app, o);
  CLI11_PARSE(app, argc, argv);
  ForceTarget(o.target);
  for (const std::string& name : o.meshes) {
    if (!IsBuiltIn(name)) FolderOf(o, FileName(name));  // better now than in an hour
  }
  if (o.build) return MainBuild(o);
  const ThreadLimit one(1);
  PrintSetting(o);
  PrintSetHeader();
  std::vector<SetResult> results;
  for (const std::string& name : o.meshes) {
    for (SetResult& r : BenchMesh(o, name)) results.push_back(std::move(r));
    Write(o, results);  // after each mesh: a long run may be cut short
  }
  return 0;
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
