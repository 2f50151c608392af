#include "src/scene/parse/mesh_edges.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <span>
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
    if (from == to) SetProblem(fmt::format("face {} has vertex {} twice", i / 3, from));
    const std::uint64_t key =
        (std::uint64_t{std::min(from, to)} << 32) | std::max(from, to);
    const auto [it, is_new] =
        known_.emplace(key, static_cast<std::uint32_t>(out_.edges.size()));
    out_.of_side.push_back(it->second);
    if (is_new) return out_.edges.push_back({{from, to}, {opposite, opposite}, 1});
    MeshEdge& edge = out_.edges[it->second];
    edge.opposite[1] = opposite;
    if (++edge.faces > 2) {
      SetProblem(fmt::format("more than two faces have the edge of vertices {} and {}",
                             from, to));
    } else if (edge.ends[0] == from) {
      SetProblem(fmt::format(
          "the two faces along the edge of vertices {} and {} run in opposite directions",
          from, to));
    }
  }

  void SetProblem(std::string problem) {
    if (out_.problem.empty()) out_.problem = std::move(problem);
  }

  const TriangleMesh& mesh_;
  std::unordered_map<std::uint64_t, std::uint32_t> known_;
  MeshEdges out_;
};

}  // namespace

MeshEdges FindEdges(const TriangleMesh& mesh) { return EdgeFinder(mesh).Run(); }

VertexRings::VertexRings(const TriangleMesh& mesh)
    : first_(mesh.positions.size() + 1), links_(mesh.indices.size()) {
  for (std::uint32_t vertex : mesh.indices) ++first_[vertex + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  std::vector<std::size_t> at(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    const std::uint32_t* face = &mesh.indices[i - i % 3];
    links_[at[face[i % 3]]++] = {face[(i + 1) % 3], face[(i + 2) % 3]};
  }
}

std::vector<std::uint32_t> VertexRings::Around(std::uint32_t vertex) const {
  const std::span<const Link> links(links_.data() + first_[vertex],
                                    first_[vertex + 1] - first_[vertex]);
  if (links.empty()) return {};
  const auto find = [&](auto matches) {
    return std::find_if(links.begin(), links.end(), matches);
  };
  // On a boundary, the chain starts at the neighbour that ends no link.
  std::uint32_t start = links.front().first;
  for (const Link& link : links) {
    const bool is_end = find([&](const Link& other) {
                          return other.second == link.first;
                        }) == links.end();
    if (is_end) start = link.first;
  }
  std::vector<std::uint32_t> ring = {start};
  while (ring.size() <= links.size()) {
    const auto next = find([&](const Link& link) { return link.first == ring.back(); });
    if (next == links.end() || next->second == start) break;
    ring.push_back(next->second);
  }
  return ring;
}

std::string VertexRings::problem() const {
  for (std::uint32_t vertex = 0; vertex + 1 < first_.size(); ++vertex) {
    const std::size_t faces = first_[vertex + 1] - first_[vertex];
    const std::size_t around = Around(vertex).size();
    // A closed ring has as many neighbours as faces, an open one has one more.
    if (faces == 0 || around == faces || around == faces + 1) continue;
    return fmt::format("vertex {} joins faces that do not lie side by side", vertex);
  }
  return "";
}

}  // namespace lanelight
