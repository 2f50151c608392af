#include "src/scene/parse/mesh_edges.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "src/base/core/error.h"

namespace lanelight {
namespace {

class EdgeFinder {
 public:
  explicit EdgeFinder(const TriangleMesh& mesh) : mesh_(mesh) {}

  MeshEdges Run() {
    const std::size_t sides = mesh_.indices.size();
    known_.reserve(sides);
    out_.of_side.reserve(sides);
    for (std::size_t i = 0; i < sides; ++i) AddSide(i);
    return std::move(out_);
  }

 private:
  void AddSide(std::size_t i) {
    const std::uint32_t* face = &mesh_.indices[i - i % 3];
    const std::uint32_t from = face[i % 3], to = face[(i + 1) % 3];
    const std::uint32_t opposite = face[(i + 2) % 3];
    if (from == to) Complain(fmt::format("face {} has vertex {} twice", i / 3, from));
    const std::uint64_t key =
        (std::uint64_t{std::min(from, to)} << 32) | std::max(from, to);
    const auto [it, is_new] =
        known_.emplace(key, static_cast<std::uint32_t>(out_.edges.size()));
    out_.of_side.push_back(it->second);
    if (is_new) return out_.edges.push_back({{from, to}, {opposite, opposite}, 1});
    MeshEdge& edge = out_.edges[it->second];
    edge.opposite[1] = opposite;
    if (++edge.faces > 2) {
      Complain(fmt::format("more than two faces have the edge of vertices {} and {}",
                           from, to));
    } else if (edge.ends[0] == from) {
      Complain(
          fmt::format("the two faces along the edge of vertices {} and {} run in "
                      "opposite directions",
                      from, to));
    }
  }

  void Complain(std::string problem) {
    if (out_.problem.empty()) out_.problem = std::move(problem);
  }

  const TriangleMesh& mesh_;
  std::unordered_map<std::uint64_t, std::uint32_t> known_;
  MeshEdges out_;
};

}  // namespace

MeshEdges FindEdges(const TriangleMesh& mesh) { return EdgeFinder(mesh).Run(); }

}  // namespace lanelight
