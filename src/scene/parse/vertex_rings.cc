#include "src/scene/parse/vertex_rings.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <span>

#include "src/base/core/error.h"

namespace lanelight {

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
  // On a boundary one neighbour is the end of no link: the chain starts there.
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
    // A closed ring has as many neighbours as faces, an open one another.
    if (faces == 0 || around == faces || around == faces + 1) continue;
    return fmt::format("vertex {} joins faces that do not lie side by side", vertex);
  }
  return "";
}

}  // namespace lanelight
