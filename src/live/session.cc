#include "src/live/session.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "src/core/json_text.h"
#include "src/core/stopwatch.h"
#include "src/scene/rendered_pixels.h"
#include "src/live/state_json.h"
#include "src/strategy/named_strategy.h"
#include "src/train/training.h"

namespace lanelight::live {
namespace {

using Clock = std::chrono::steady_clock;

// Of a preview, at most: it has to be there before the next move of the mouse.
constexpr double kPreviewSeconds = 0.04;
// The first one, of which no rate is known.
constexpr double kFirstPreviewSamples = 16384;
constexpr int kMostReduced = 16;
// Without a move for so long, the camera stands.
constexpr auto kSettles = std::chrono::milliseconds(120);
// Of strategies that have been left, so that coming back renders nothing again.
constexpr std::size_t kMostBytesAside = std::size_t{256} << 20;

// How many samples per pixel there are after the next pass of `seconds`; twice as many at
// most, since rates are not known well at first.
std::uint64_t NextSpp(const Contender& contender, double seconds) {
  const std::uint64_t unit = contender.film().groups().unit, spp = contender.spp();
  const double step = std::min(contender.rate() * seconds, std::max(1.0, double(spp)));
  const auto units = static_cast<std::uint64_t>(std::max(1.0, step / double(unit)));
  return spp + units * unit;
}

}  // namespace

Session::Session(Stage& stage, std::string command, Send send)
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
    const Strategy own = stage_.job.description.strategy;
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

int Session::PreviewFactor(const Slot& slot) const {
  const double samples =
      slot.preview_rate > 0 ? slot.preview_rate * kPreviewSeconds : kFirstPreviewSamples;
  const double pixels = double(RenderedPixels(stage_.job.description.film).pixels());
  return std::clamp(static_cast<int>(std::ceil(std::sqrt(pixels / samples))), 1,
                    kMostReduced);
}

std::optional<Work> Session::Next() {
  if (auto preview = NextPreview()) return preview;
  if (paused_ || Clock::now() < settled_) return std::nullopt;
  return NextPass();
}

// Where the first pass is as quick, it is the preview.
std::optional<Work> Session::NextPreview() {
  for (int i = 0; i < kSlots; ++i) {
    Slot& slot = slots_[static_cast<std::size_t>(i)];
    if (!slot.strategy || slot.previewed) continue;
    if (!slot.contender) slot.contender = Make(i);
    if (slot.contender->spp() > 0) {
      slot.previewed = true;
      continue;
    }
    const bool trains = NeedsTraining(slot.contender->plan());
    const int factor = PreviewFactor(slot);
    if (factor == 1 && !trains) {
      return Work{slot.contender, slot.contender->film().groups().unit, i, true};
    }
    // What has to be learned first would not be there in time.
    const Strategy strategy = trains ? Strategy{} : *slot.strategy;
    auto reduced =
        std::make_shared<Contender>(stage_, MakeView(stage_, eye_, factor), strategy);
    const std::uint64_t unit = reduced->film().groups().unit;
    return Work{std::move(reduced), unit, i, true};
  }
  return std::nullopt;
}

std::optional<Work> Session::NextPass() {
  const auto cost = [&](const Contender& c) {
    return pace_ == Pace::kTime ? c.cpu_seconds() : double(c.spp());
  };
  std::optional<Work> work;
  double other_spp = 0;
  for (int i = 0; i < kSlots; ++i) {
    Slot& slot = slots_[static_cast<std::size_t>(i)];
    if (!slot.strategy) continue;
    if (!slot.contender) slot.contender = Make(i);
    other_spp = std::max(other_spp, double(slot.contender->spp()));
    if (work && cost(*work->contender) <= cost(*slot.contender)) continue;
    work = Work{slot.contender, 0, i, false};
  }
  if (!work) return work;
  const double elapsed = SecondsSince(began_);
  work->spp = NextSpp(*work->contender, std::clamp(elapsed / 4, 0.2, 2.0));
  const auto most = static_cast<std::uint64_t>(other_spp);
  if (pace_ == Pace::kSamples && work->contender->spp() < most) {
    work->spp = std::min(work->spp, most);
  }
  if (work->spp > kMostSamplesPerPixel) return std::nullopt;
  return work;
}

void Session::Refuse(int index, const std::string& why) {
  Slot& slot = slots_[static_cast<std::size_t>(index)];
  slot.contender.reset();
  slot.strategy.reset();
  slot.refused = why;
}

void Session::Done(const Work& work, bool stopped) {
  if (!work.preview || stopped) return;
  Slot& slot = slots_[static_cast<std::size_t>(work.slot)];
  slot.previewed = true;
  const double pixels = double(work.contender->view().window.pixels());
  if (work.contender->rate() > 0) slot.preview_rate = work.contender->rate() * pixels;
  SendPreview(work);
}

void Session::SendPreview(const Work& work) {
  Slot& slot = slots_[static_cast<std::size_t>(work.slot)];
  if (work.contender->view().factor == 1) {
    SendPicture(work.slot, *work.contender, slot.sent);
    return;
  }
  SentPicture sent;
  sent.view = view_;
  SendPicture(work.slot, *work.contender, sent);
}

void Session::Publish() {
  for (int i = 0; i < kSlots; ++i) {
    Slot& slot = slots_[static_cast<std::size_t>(i)];
    if (!slot.contender || !slot.drawn) continue;
    slot.contender->Fit();
    SendPicture(i, *slot.contender, slot.sent);
  }
  if (state_drawn_ && SecondsSince(last_state_) > 0.2) SendState();
}

double Session::Interval() const {
  return std::clamp(SecondsSince(began_) / 10, 0.1, 0.5);
}

void Session::SendPicture(int index, const Contender& contender, SentPicture& sent) {
  if (sent.view != view_ || sent.layer != layer_) sent = {view_, layer_, {}};
  const nlohmann::json head = {{"kind", "picture"},
                               {"slot", index},
                               {"view", view_},
                               {"factor", contender.view().factor},
                               {"spp", contender.spp()}};
  std::string message = EncodePicture(contender, head, sent);
  if (message.empty()) return;
  slots_[static_cast<std::size_t>(index)].drawn = false;
  send_(std::move(message), true);
}

void Session::SendState() {
  StateOfPage state = {stage_, eye_, view_, pace_, paused_, {}};
  for (std::size_t i = 0; i < kSlots; ++i) {
    state.slots[i] = {slots_[i].name, slots_[i].refused, slots_[i].contender.get()};
  }
  send_(StateText(state, command_), false);
  state_drawn_ = false;
  last_state_ = Clock::now();
}

void Session::SendPixel(const Ask& ask) {
  nlohmann::json slots = nlohmann::json::array();
  for (const Slot& slot : slots_) {
    slots.push_back(slot.contender ? PixelJson(*slot.contender, ask.x, ask.y)
                                   : nlohmann::json());
  }
  send_(DumpJson({{"kind", "pixel"}, {"x", ask.x}, {"y", ask.y}, {"slots", slots}}),
        false);
}

void Session::SendExr(int index) {
  const Slot& slot = slots_[static_cast<std::size_t>(index)];
  if (!slot.contender || slot.contender->spp() == 0) {
    SendText("refused", "there is no whole picture yet to be saved");
    return;
  }
  slot.contender->Fit();
  send_(ExrMessage(stage_, *slot.contender), true);
}

void Session::SendText(const char* kind, const std::string& text) {
  send_(DumpJson({{"kind", kind}, {"text", text}}), false);
}

}  // namespace lanelight::live
