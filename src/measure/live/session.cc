#include "src/measure/live/session.h"

#include <algorithm>
#include <utility>

#include "src/measure/live/state_json.h"
#include "src/vocabulary/strategy/named_strategy.h"

namespace lanelight::live {
namespace {

using Clock = std::chrono::steady_clock;

// Without a move for so long, the camera stands.
constexpr auto kSettles = std::chrono::milliseconds(120);
// Of strategies that have been left, so that coming back renders nothing again.
constexpr std::size_t kMostBytesAside = std::size_t{256} << 20;

}  // namespace

Session::Session(const Stage& stage, std::string command, Send send)
    : stage_(stage),
      command_(std::move(command)),
      send_(std::move(send)),
      eye_(stage.eye),
      began_(Clock::now()),
      settled_(began_) {
  send_(HelloText(stage_), false);
}

void Session::Do(const Command& command) {
  if (const auto* move = std::get_if<MoveEye>(&command)) Move(move->eye);
  if (const auto* choice = std::get_if<ChooseStrategy>(&command)) Choose(*choice);
  if (const auto* pace = std::get_if<ChoosePace>(&command)) pace_ = pace->pace;
  if (const auto* pause = std::get_if<Pause>(&command)) paused_ = pause->on;
  if (const auto* layer = std::get_if<ChooseLayer>(&command)) {
    layer_ = layer->layer;
    for (Slot& slot : slots_) slot.sent = {};
  }
  if (const auto* ask = std::get_if<Ask>(&command)) SendPixel(*ask);
  if (const auto* seen = std::get_if<Seen>(&command)) {
    (seen->what < kSlots ? slots_[static_cast<std::size_t>(seen->what)].drawn
                         : state_drawn_) = true;
  }
  if (const auto* save = std::get_if<SaveExr>(&command)) SendExr(save->slot);
  if (std::holds_alternative<TellCamera>(command)) {
    SendText("camera-text", PbrtText(MakeView(stage_, eye_, 1).described));
  }
}

void Session::Move(const Eye& eye) {
  if (eye == eye_) return;
  MakeView(stage_, eye, 1);  // throws if there is no such camera
  eye_ = eye;
  ++view_;
  others_.clear();
  for (Slot& slot : slots_) {
    slot.contender.reset();
    slot.previewed = false;
  }
  began_ = Clock::now();
  settled_ = began_ + kSettles;
}

void Session::Choose(const ChooseStrategy& choice) {
  Slot& slot = slots_[static_cast<std::size_t>(choice.slot)];
  if (slot.contender) others_.push_back(std::move(slot.contender));
  KeepFew();
  const double rate = slot.preview_rate;
  slot = {};
  slot.preview_rate = rate;
  slot.name = choice.name;
  began_ = Clock::now();
  if (choice.name.empty()) return;
  try {
    const Strategy own = stage_.job.loaded->description.strategy;
    slot.strategy = StrategyNamed(choice.name, {}, own);
    slot.contender = Make(choice.slot);
  } catch (const InputError& error) {
    Refuse(choice.slot, error.message());
  }
}

void Session::KeepFew() {
  std::size_t bytes = 0;
  for (const auto& other : others_) bytes += other->Bytes();
  while (!others_.empty() && bytes > kMostBytesAside) {
    bytes -= others_.front()->Bytes();
    others_.erase(others_.begin());
  }
}

// The one that was put aside, if there is one. Both slots may have the same.
std::shared_ptr<Contender> Session::Make(int slot) {
  const Strategy& strategy = *slots_[static_cast<std::size_t>(slot)].strategy;
  for (std::size_t i = 0; i < others_.size(); ++i) {
    if (!(others_[i]->strategy() == strategy)) continue;
    const auto found = others_[i];
    others_.erase(others_.begin() + static_cast<std::ptrdiff_t>(i));
    return found;
  }
  for (const Slot& other : slots_) {
    if (other.contender && other.contender->strategy() == strategy)
      return other.contender;
  }
  return std::make_shared<Contender>(stage_, MakeView(stage_, eye_, 1), strategy);
}

void Session::Refuse(int index, const std::string& why) {
  Slot& slot = slots_[static_cast<std::size_t>(index)];
  slot.contender.reset();
  slot.strategy.reset();
  slot.refused = why;
}

}  // namespace lanelight::live
