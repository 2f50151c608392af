#include "src/render/run/film_show.h"

#include <limits>

namespace lanelight {

void FilmShow::Start() {
  const bool shown = setting_.options.on_film && setting_.options.group == nullptr;
  const double expected = kShowSeconds * double(setting_.tasks.pixels());
  due_ = shown ? setting_.clock.Elapsed() + expected / kShowShare
               : std::numeric_limits<double>::infinity();
}

void FilmShow::Show() {
  const double since = due_;
  setting_.films.film().FitControl();
  setting_.options.on_film(setting_.films.film());
  const double now = setting_.clock.Elapsed();
  due_ = now + (now - since) / kShowShare;
}

}  // namespace lanelight
