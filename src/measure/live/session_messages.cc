// Sends pictures, their progress and replies to a page.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "src/base/core/json_text.h"
#include "src/base/core/stopwatch.h"
#include "src/measure/live/session.h"
#include "src/measure/live/state_json.h"

namespace lanelight::live {
namespace {

constexpr double kStateInterval = 0.2;  // seconds, at least

}  // namespace

void Session::SendPreview(const Work& work) {
  Slot& slot = slots_[static_cast<std::size_t>(work.slot)];
  if (work.renderer->view().factor == 1) {
    SendPicture(work.slot, *work.renderer, slot.sent);
    return;
  }
  SentPicture sent;
  sent.view = view_;
  SendPicture(work.slot, *work.renderer, sent);
}

void Session::Publish() {
  for (int i = 0; i < kSlots; ++i) {
    Slot& slot = slots_[static_cast<std::size_t>(i)];
    if (!slot.renderer || !slot.drawn) continue;
    slot.renderer->Fit();
    SendPicture(i, *slot.renderer, slot.sent);
  }
  if (state_drawn_ && SecondsSince(last_state_) > kStateInterval) SendState();
}

double Session::Interval() const {
  return std::clamp(SecondsSince(began_) / 10, 0.1, 0.5);
}

void Session::SendPicture(int index, const PassRenderer& renderer, SentPicture& sent) {
  if (sent.view != view_ || sent.layer != layer_) sent = {view_, layer_, {}};
  const nlohmann::json head = {{"kind", "picture"},
                               {"slot", index},
                               {"view", view_},
                               {"factor", renderer.view().factor},
                               {"spp", renderer.spp()}};
  std::string message = EncodePicture(renderer, head, sent);
  if (message.empty()) return;
  slots_[static_cast<std::size_t>(index)].drawn = false;
  send_(std::move(message), true);
}

void Session::SendState() {
  StateOfPage state = {live_scene_, pose_, view_, pace_, paused_, {}};
  for (std::size_t i = 0; i < kSlots; ++i) {
    state.slots[i] = {slots_[i].name, slots_[i].refused, slots_[i].renderer.get()};
  }
  send_(StateText(state, command_), false);
  state_drawn_ = false;
  last_state_ = std::chrono::steady_clock::now();
}

void Session::SendPixel(int x, int y) {
  nlohmann::json slots = nlohmann::json::array();
  for (const Slot& slot : slots_) {
    slots.push_back(slot.renderer ? PixelJson(*slot.renderer, x, y) : nlohmann::json());
  }
  send_(DumpJson({{"kind", "pixel"}, {"x", x}, {"y", y}, {"slots", slots}}), false);
}

void Session::SendExr(int index) {
  const Slot& slot = slots_[static_cast<std::size_t>(index)];
  if (!slot.renderer || slot.renderer->spp() == 0) {
    SendText("refused", "there is no complete image to save yet");
    return;
  }
  slot.renderer->Fit();
  send_(ExrMessage(live_scene_, *slot.renderer), true);
}

void Session::SendText(const char* kind, const std::string& text) {
  send_(DumpJson({{"kind", kind}, {"text", text}}), false);
}

}  // namespace lanelight::live
