// Built instead of embree_*.cc where Embree 3 is not found.
#include "bench/intersect/tracer.h"

namespace lanelight::bench {

std::unique_ptr<Peer> MakeEmbree(const Mesh&, const std::string&, const std::string&) {
  return nullptr;
}

}  // namespace lanelight::bench
