#include "src/wavefront/crew.h"

#include "src/core/check.h"
#include "src/core/parallel.h"
#include "src/wavefront/schedule.h"
#include "src/wavefront/tasks.h"

namespace lanelight {

int OneProcess::threads() const { return MaxThreads(); }

Round OneProcess::Widen(const Round& round) const { return round; }

void OneProcess::RunRound(const RoundWork& work, Tasks& tasks, TaskWatcher& watcher,
                          Films& films) {
  tasks.RunRound(work, watcher, films);
}

void OneProcess::Serve(const Service&) { LL_CHECK(!"a process alone serves nobody"); }

}  // namespace lanelight
