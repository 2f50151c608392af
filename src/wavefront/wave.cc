#include "src/wavefront/wave.h"

namespace lanelight {

const char* QueueName(QueueId id) {
  static constexpr const char* kNames[] = {
#define X(name, meaning) #name,
      LANELIGHT_QUEUES(X)
#undef X
#define X(name) "Shade" #name,
          LANELIGHT_SHADE_KINDS(X)
#undef X
  };
  return kNames[static_cast<int>(id)];
}

}  // namespace lanelight
