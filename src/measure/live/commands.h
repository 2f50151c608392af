// What a page may ask for, as messages of its socket: JSON objects with a member "do".
#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "src/measure/live/eye.h"
#include "src/measure/live/picture.h"
#include "src/measure/live/score.h"

namespace lanelight::live {

inline constexpr int kSlots = 2;  // A and B
/// Bytes of a message, at most.
inline constexpr std::size_t kLongestMessage = 1u << 14;

/// {"do": "camera", "eye": ...}
struct MoveEye {
  Eye eye;
};
/// {"do": "strategy", "slot": 0, "name": "points=sobol"}: as --strategies takes it; an
/// empty name: nothing is rendered there.
struct ChooseStrategy {
  int slot = 0;
  std::string name;
};
/// {"do": "pace", "by": "time"} or "samples"
struct ChoosePace {
  Pace pace = Pace::kTime;
};
/// {"do": "pause", "on": true}
struct Pause {
  bool on = false;
};
/// {"do": "layer", "name": "error"}
struct ChooseLayer {
  Layer layer = Layer::kNone;
};
/// {"do": "ask", "x": 10, "y": 20}: the numbers of a pixel of the image.
struct Ask {
  int x = 0, y = 0;
};
/// {"do": "seen", "what": 0}: the last picture of this slot has been drawn, or, with 2,
/// the last state has; the next may come.
struct Seen {
  int what = 0;
};
/// {"do": "exr", "slot": 0}: the file that `lanelight render` would write now.
struct SaveExr {
  int slot = 0;
};
/// {"do": "camera-text"}: as pbrt has it.
struct TellCamera {};

using Command = std::variant<MoveEye, ChooseStrategy, ChoosePace, Pause, ChooseLayer, Ask,
                             Seen, SaveExr, TellCamera>;

/// Throws InputError that says what is wrong and what would be right.
Command ParseCommand(std::string_view text);

/// What is being rendered may not be wanted any more.
bool ChangesWork(const Command& command);

}  // namespace lanelight::live
