#include "src/run/error_looks.h"

#include "src/run/schedule.h"

namespace lanelight {

std::uint64_t ErrorLooks::After(std::uint64_t done) const {
  if (!setting_.options.samples_needed) return kMostSamplesPerPixel;
  return LookFrom(done + 1, setting_.unit());
}

int ErrorLooks::Count() const {
  if (!setting_.options.samples_needed) return 0;
  return LooksUpTo(setting_.tasks.Done(), setting_.unit());
}

// Where pixels have shares of the samples, a run may have been at its last look already,
// and no pixel has had more since.
std::uint64_t ErrorLooks::LastLevel() const {
  const std::uint64_t done = setting_.tasks.Done();
  std::uint64_t look = done;
  for (auto next = After(0); next <= done; next = After(next)) look = next;
  return setting_.tasks.IsAt(look) ? look : done;
}

bool ErrorLooks::IsLook(std::uint64_t done) const {
  return done == LookFrom(done, setting_.unit()) || done == setting_.limit();
}

// A run that was put down within a round has taken its look before; what it says of an
// uneven film is not what one run would hear.
void ErrorLooks::LookIfDue(std::uint64_t done) {
  if (!setting_.options.samples_needed || done == 0) return;
  if (!setting_.tasks.IsAt(done) || !IsLook(done)) return;
  setting_.work.Gather();
  setting_.films.film().FitControl();
  needed_ = setting_.options.samples_needed(setting_.films.film(), done);
  hopeless_ = needed_ < 0;
  reached_ = !hopeless_ && needed_ <= double(done);
}

}  // namespace lanelight
