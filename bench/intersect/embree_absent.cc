// Built instead of embree_*.cc where Embree 3 is not found.
#include "bench/intersect/build.h"
#include "bench/intersect/tracer.h"

namespace lanelight::bench {

std::unique_ptr<Peer> MakeEmbree(const Mesh&, const std::string&, const std::string&) {
  return nullptr;
}
std::vector<std::unique_ptr<Builder>> EmbreeBuilders(const Mesh&, const std::string&) {
  return {};
}

}  // namespace lanelight::bench
