#include "src/render/run/convergence_checks.h"

#include "src/render/run/schedule.h"

namespace lanelight {

std::uint64_t ConvergenceChecks::After(std::uint64_t done) const {
  if (!setting_.options.samples_needed) return kMostSamplesPerPixel;
  return CheckFrom(done + 1, setting_.unit());
}

int ConvergenceChecks::Count() const {
  if (!setting_.options.samples_needed) return 0;
  return ChecksUpTo(setting_.tasks.Done(), setting_.unit());
}

// Where pixels have shares of the samples, a run may have been at its last check already,
// and no pixel has had more since.
std::uint64_t ConvergenceChecks::LastLevel() const {
  const std::uint64_t done = setting_.tasks.Done();
  std::uint64_t at = done;
  for (auto next = After(0); next <= done; next = After(next)) at = next;
  return setting_.tasks.IsAt(at) ? at : done;
}

bool ConvergenceChecks::IsCheck(std::uint64_t done) const {
  return done == CheckFrom(done, setting_.unit()) || done == setting_.limit();
}

// A run that was paused within a round has made its check before; what it says of an
// uneven film is not what one run would hear.
void ConvergenceChecks::CheckIfDue(std::uint64_t done) {
  if (!setting_.options.samples_needed || done == 0) return;
  if (!setting_.tasks.IsAt(done) || !IsCheck(done)) return;
  setting_.work.Gather();
  setting_.films.film().FitControl();
  needed_ = setting_.options.samples_needed(setting_.films.film(), done);
  hopeless_ = needed_ < 0;
  reached_ = !hopeless_ && needed_ <= double(done);
}

}  // namespace lanelight
