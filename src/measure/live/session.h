// One page: what it looks at, what it compares, and what it has been sent. Only the
// thread of the render_thread knows it.
#pragma once

#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "src/measure/live/pass_renderer.h"
#include "src/measure/live/picture.h"
#include "src/measure/live/score.h"
#include "src/measure/live/state_json.h"

namespace lanelight::live {

/// To the page; `binary`: no text.
using Send = std::function<void(std::string message, bool binary)>;

/// The next work of the session's thread.
struct Work {
  std::shared_ptr<PassRenderer> renderer;
  std::uint64_t spp = 0;  // that all of its pixels are to have then
  int slot = 0;
  bool preview = false;  // at reduced resolution, to be shown at once
};

class Session {
 public:
  /// `command`: the words of a command line that renders the scene, without how much and
  /// with what strategy.
  Session(const LiveScene& live_scene, std::string command, Send send);

  /// Does what the page asks for (docs/live.md): {"do": "camera", "eye": {...}};
  /// "strategy" with "slot" and "name", as --strategies takes it or empty; "pace" by
  /// "time" or "samples"; "pause" on true; "layer" with a name of LayersJson; "ask" for
  /// the pixel "x", "y"; "seen" of the slot "what", or 2 for the state: the next may
  /// come; "exr" of a "slot"; "camera-text". A strategy that is refused is told as such.
  /// Throws InputError that says what is wrong and what would be right.
  void Do(const nlohmann::json& message);

  /// Returns the next work; nothing if the page waits for nothing, or not before When().
  std::optional<Work> Next();
  /// While the camera moves, nothing but previews is rendered: until then.
  std::chrono::steady_clock::time_point When() const { return settled_; }
  /// The work has been done, or stopped.
  void FinishWork(const Work& work, bool stopped);
  /// Marks the work of this slot as impossible.
  void Refuse(int slot, const std::string& why);

  /// Sends pictures that have changed, and the state, if the page has drawn those before.
  void Publish();
  /// Seconds between two of them: often at first, then seldom.
  double Interval() const;

 private:
  struct Slot {
    std::string name;  // as the page has it; empty: nothing is rendered
    std::optional<Strategy> strategy;
    std::string refused;                     // why there is none
    std::shared_ptr<PassRenderer> renderer;  // of the present view; null: not begun
    SentPicture sent;
    bool drawn = true;        // the page has drawn what it was sent
    bool previewed = false;   // the present view has been shown
    double preview_rate = 0;  // samples per second of previews
  };

  void HandleCommand(const std::string& what, const nlohmann::json& message);
  void Choose(int slot, const std::string& name);
  void Move(const CameraPose& pose);
  void DropOldRenders();
  std::shared_ptr<PassRenderer> Make(int slot);
  std::optional<Work> NextPreview();
  std::optional<Work> NextPass();
  int PreviewFactor(const Slot& slot) const;
  void SendPreview(const Work& work);
  void SendPicture(int slot, const PassRenderer& renderer, SentPicture& sent);
  void SendState();
  void SendPixel(int x, int y);
  void SendExr(int slot);
  void SendText(const char* kind, const std::string& text);

  const LiveScene& live_scene_;
  std::string command_;
  Send send_;
  CameraPose pose_;
  std::uint64_t view_ = 0;  // counts eyes
  std::array<Slot, kSlots> slots_;
  std::vector<std::shared_ptr<PassRenderer>> others_;  // of this view, put aside
  Pace pace_ = Pace::kTime;
  bool paused_ = false, state_drawn_ = true;
  Layer layer_ = Layer::kNone;
  std::chrono::steady_clock::time_point began_, settled_, last_state_;
};

}  // namespace lanelight::live
