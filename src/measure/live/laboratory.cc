#include "src/measure/live/laboratory.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "src/base/core/json_text.h"

namespace lanelight::live {
namespace {

using Clock = std::chrono::steady_clock;

std::int64_t Microseconds() {
  return std::chrono::duration_cast<std::chrono::microseconds>(
             Clock::now().time_since_epoch())
      .count();
}

// Pictures take this part of the time at most.
constexpr double kPictureShare = 0.1;

}  // namespace

Laboratory::Laboratory(const Stage& stage, std::string command)
    : stage_(stage), command_(std::move(command)), thread_([this] { Loop(); }) {}

Laboratory::~Laboratory() {
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
    stop_ = stop_all_ = true;
  }
  woken_.notify_all();
  thread_.join();
}

int Laboratory::Enter(Send send) {
  const auto shared = std::make_shared<Send>(std::move(send));
  int session = 0;
  {
    const std::lock_guard lock(mutex_);
    session = next_session_++;
    doors_[session] = shared;
  }
  Push({session, shared, std::nullopt});
  return session;
}

void Laboratory::Receive(int session, const std::string& message) {
  try {
    Push({session, nullptr, ParseMessage(message)});
  } catch (const InputError& error) {
    Tell(session, error.message());
  }
}

void Laboratory::Leave(int session) {
  {
    const std::lock_guard lock(mutex_);
    doors_.erase(session);
  }
  Push({session, nullptr, std::nullopt});
}

void Laboratory::Push(Wish wish) {
  {
    const std::lock_guard lock(mutex_);
    (wish.IsUrgent() ? stop_ : waiting_) = true;
    wishes_.push_back(std::move(wish));
  }
  woken_.notify_all();
}

void Laboratory::Tell(int session, const std::string& what) {
  const std::lock_guard lock(mutex_);
  const auto door = doors_.find(session);
  if (door == doors_.end()) return;
  (*door->second)(DumpJson({{"kind", "refused"}, {"text", what}}), false);
}

void Laboratory::TakeWishes(bool all) {
  std::vector<Wish> wishes;
  {
    const std::lock_guard lock(mutex_);
    std::vector<Wish> later;
    for (Wish& wish : wishes_) {
      (all || !wish.IsUrgent() ? wishes : later).push_back(std::move(wish));
    }
    wishes_ = std::move(later);
    waiting_ = false;
  }
  for (const Wish& wish : wishes) {
    try {
      Grant(wish);
    } catch (const InputError& error) {
      Tell(wish.session, error.message());
    }
  }
}

void Laboratory::Grant(const Wish& wish) {
  if (wish.enter) {
    // Whoever has left meanwhile is not there to be sent anything.
    Send send = [this, session = wish.session](std::string message, bool binary) {
      const std::lock_guard lock(mutex_);
      const auto door = doors_.find(session);
      if (door != doors_.end()) (*door->second)(std::move(message), binary);
    };
    sessions_[wish.session] =
        std::make_shared<Session>(stage_, command_, std::move(send));
    return;
  }
  const auto session = sessions_.find(wish.session);
  if (session == sessions_.end()) return;
  if (wish.command) {
    session->second->Do(*wish.command);
  } else {
    sessions_.erase(session);
  }
}

// Sessions take turns.
std::optional<Laboratory::Running> Laboratory::Choose() {
  auto at = sessions_.upper_bound(last_session_);
  for (std::size_t i = 0; i < sessions_.size(); ++i, ++at) {
    if (at == sessions_.end()) at = sessions_.begin();
    try {
      if (const auto work = at->second->Next()) {
        last_session_ = at->first;
        return Running{at->second, *work};
      }
    } catch (const InputError& error) {
      Tell(at->first, error.message());
    }
  }
  return std::nullopt;
}

void Laboratory::Render(const Running& running) {
  const Work& work = running.work;
  try {
    work.contender->Pass(work.spp, *this, work.preview ? stop_all_ : stop_);
    running.session->Done(work, work.contender->spp() < work.spp);
  } catch (const InputError& error) {
    running.session->Refuse(work.slot, error.message());
  }
}

void Laboratory::Wait(Clock::time_point since) {
  auto until = since + std::chrono::seconds(1);
  for (const auto& [number, session] : sessions_) {
    if (session->When() > since) until = std::min(until, session->When());
  }
  std::unique_lock lock(mutex_);
  woken_.wait_until(lock, until, [this] { return quit_ || !wishes_.empty(); });
}

void Laboratory::Loop() {
  while (true) {
    {
      const std::lock_guard lock(mutex_);
      if (quit_) return;
      stop_ = false;
    }
    TakeWishes(true);
    const auto now = Clock::now();
    const auto running = Choose();
    const bool first = running && running->work.contender->spp() == 0;
    if (running) Render(*running);
    // The first whole picture does not wait for its turn.
    if (!running || first || Microseconds() >= publish_at_) Publish();
    if (!running) Wait(now);
  }
}

bool Laboratory::Due() const { return waiting_ || Microseconds() >= publish_at_; }

void Laboratory::Attend() {
  TakeWishes(false);
  if (Microseconds() >= publish_at_) Publish();
}

void Laboratory::Publish() {
  const std::int64_t begin = Microseconds();
  double interval = 0.5;
  for (const auto& [number, session] : sessions_) {
    session->Publish();
    interval = std::min(interval, session->Interval());
  }
  const std::int64_t now = Microseconds();
  publish_at_ =
      now + std::max(static_cast<std::int64_t>(interval * 1e6),
                     static_cast<std::int64_t>(double(now - begin) / kPictureShare));
}

}  // namespace lanelight::live
