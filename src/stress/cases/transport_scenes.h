// Scenes that cases on transport and on strategies share, with their closed forms.
#pragma once

#include <string>

#include "src/stress/cases/transport_setup.h"

namespace lanelight::stress {

/// The inside of a sphere of radius 4 that emits `emission` and reflects `albedo`.
std::string Walls(double emission, double albedo);
/// The same with a camera in it: ClosedRoom() is what it sees.
std::string Room(double emission, double albedo);

/// Sheets of diffuse transmission 1e-3 (and one of the rest) between a sky of radiance 1
/// and the camera: it sees `transmitted`, at most 1.
std::string Sheets(double transmitted);

/// Point lights on a ring above a diffuse plane, whose intensities go through six
/// decades, and what the plane shows of them.
struct LightRing {
  std::string text;
  double expected = 0;
};
LightRing RingOfLights(int lights);

}  // namespace lanelight::stress
