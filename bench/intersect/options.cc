#include "bench/intersect/options.h"

#include <fmt/format.h>

#include <algorithm>

#include "src/base/core/error.h"
#include "tests/support/test_target.h"

namespace lanelight::bench {
namespace {

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

}  // namespace

AccelOptions Options::Accel() const {
  AccelOptions accel;
  if (fast) accel.quality = BuildQuality::kFast;
  accel.leaf_triangles = leaf > 0 ? leaf : LeafTrianglesFor(TestTarget().lanes());
  if (few >= 0) accel.few_triangles = static_cast<std::uint32_t>(few);
  return accel;
}

std::unique_ptr<Peer> Options::MakePeer(const Mesh& mesh) const {
  return embree ? MakeEmbree(mesh, TestTarget().name(), embree_config) : nullptr;
}

bool Options::Wants(const RaySet& set) const {
  return std::ranges::find(sets, set.name) != sets.end();
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

void CheckMeshes(const Options& o) {
  for (const std::string& name : o.meshes) {
    if (!IsBuiltIn(name)) FolderOf(o, FileName(name));
  }
}

void AddOptions(CLI::App& app, Options& o) {
  app.add_option("MESH", o.meshes,
                 "meshes: NAME of a folder, NAME4 or NAME16 (subdivided once or twice), "
                 "cornell, ballN (about N triangles)");
  app.add_option("--scene", o.scenes,
                 "pbrt scenes whose rays are recorded from a render, instead of meshes");
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
  app.add_option(
         "--leaf", o.leaf,
         "triangles of a leaf that shares vertices; default: what suits the target")
      ->check(CLI::IsMember({int{SmallLeaf::kLanes}, int{TriangleLeaf::kLanes}}))
      ->excludes("--scene");
  app.add_flag("--open", o.open, "leave the box around the meshes out");
  app.add_flag("--build", o.build,
               "builds instead of rays: time, memory, and 1 against 2 threads");
  app.add_flag("--fast", o.fast, "our fast build below the rays");
  app.add_flag("!--no-embree", o.embree, "leave Embree out");
  app.add_option("--embree-config", o.embree_config,
                 "more for rtcNewDevice, e.g. frequency_level=simd512");
  app.add_option("--csv", o.csv, "write every entry's figures here");
  app.add_option("--json", o.json, "the same as JSON");
}

}  // namespace lanelight::bench
