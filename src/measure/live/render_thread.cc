#include "src/measure/live/render_thread.h"

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
constexpr double kMaxPictureFraction = 0.1;

}  // namespace

RenderThread::RenderThread(const LiveScene& live_scene, std::string command)
    : live_scene_(live_scene),
      command_(std::move(command)),
      thread_([this] { Loop(); }) {}

RenderThread::~RenderThread() {
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
    stop_ = stop_all_ = true;
  }
  woken_.notify_all();
  thread_.join();
}

int RenderThread::Enter(Send send) {
  const auto shared = std::make_shared<Send>(std::move(send));
  int session = 0;
  {
    const std::lock_guard lock(mutex_);
    session = next_session_++;
    senders_[session] = shared;
  }
  Push({session, shared, std::nullopt});
  return session;
}

void RenderThread::Receive(int session, const std::string& message) {
  try {
    Push({session, nullptr, ParseMessage(message)});
  } catch (const InputError& error) {
    SendError(session, error.message());
  }
}

void RenderThread::RemoveSession(int session) {
  {
    const std::lock_guard lock(mutex_);
    senders_.erase(session);
  }
  Push({session, nullptr, std::nullopt});
}

void RenderThread::Push(Request request) {
  {
    const std::lock_guard lock(mutex_);
    (request.IsUrgent() ? stop_ : waiting_) = true;
    requests_.push_back(std::move(request));
  }
  woken_.notify_all();
}

void RenderThread::SendError(int session, const std::string& what) {
  const std::lock_guard lock(mutex_);
  const auto sender = senders_.find(session);
  if (sender == senders_.end()) return;
  (*sender->second)(DumpJson({{"kind", "refused"}, {"text", what}}), false);
}

void RenderThread::HandleRequests(bool all) {
  std::vector<Request> requests;
  {
    const std::lock_guard lock(mutex_);
    std::vector<Request> later;
    for (Request& request : requests_) {
      (all || !request.IsUrgent() ? requests : later).push_back(std::move(request));
    }
    requests_ = std::move(later);
    waiting_ = false;
  }
  for (const Request& request : requests) {
    try {
      Serve(request);
    } catch (const InputError& error) {
      SendError(request.session, error.message());
    }
  }
}

void RenderThread::Serve(const Request& request) {
  if (request.enter) {
    // Whoever has left meanwhile is not there to be sent anything.
    Send send = [this, session = request.session](std::string message, bool binary) {
      const std::lock_guard lock(mutex_);
      const auto sender = senders_.find(session);
      if (sender != senders_.end()) (*sender->second)(std::move(message), binary);
    };
    sessions_[request.session] =
        std::make_shared<Session>(live_scene_, command_, std::move(send));
    return;
  }
  const auto session = sessions_.find(request.session);
  if (session == sessions_.end()) return;
  if (request.command) {
    session->second->Do(*request.command);
  } else {
    sessions_.erase(session);
  }
}

// Sessions take turns.
std::optional<RenderThread::Running> RenderThread::Choose() {
  auto at = sessions_.upper_bound(last_session_);
  for (std::size_t i = 0; i < sessions_.size(); ++i, ++at) {
    if (at == sessions_.end()) at = sessions_.begin();
    try {
      if (const auto work = at->second->Next()) {
        last_session_ = at->first;
        return Running{at->second, *work};
      }
    } catch (const InputError& error) {
      SendError(at->first, error.message());
    }
  }
  return std::nullopt;
}

void RenderThread::Render(const Running& running) {
  const Work& work = running.work;
  try {
    work.renderer->Pass(work.spp, *this, work.preview ? stop_all_ : stop_);
    running.session->FinishWork(work, work.renderer->spp() < work.spp);
  } catch (const InputError& error) {
    running.session->Refuse(work.slot, error.message());
  }
}

void RenderThread::Wait(Clock::time_point since) {
  auto until = since + std::chrono::seconds(1);
  for (const auto& [number, session] : sessions_) {
    if (session->When() > since) until = std::min(until, session->When());
  }
  std::unique_lock lock(mutex_);
  woken_.wait_until(lock, until, [this] { return quit_ || !requests_.empty(); });
}

void RenderThread::Loop() {
  while (true) {
    {
      const std::lock_guard lock(mutex_);
      if (quit_) return;
      stop_ = false;
    }
    HandleRequests(true);
    const auto now = Clock::now();
    const auto running = Choose();
    const bool first = running && running->work.renderer->spp() == 0;
    if (running) Render(*running);
    // The first whole picture does not wait for its turn.
    if (!running || first || Microseconds() >= publish_at_) Publish();
    if (!running) Wait(now);
  }
}

bool RenderThread::IsDue() const { return waiting_ || Microseconds() >= publish_at_; }

void RenderThread::Observe() {
  HandleRequests(false);
  if (Microseconds() >= publish_at_) Publish();
}

void RenderThread::Publish() {
  const std::int64_t begin = Microseconds();
  double interval = 0.5;
  for (const auto& [number, session] : sessions_) {
    session->Publish();
    interval = std::min(interval, session->Interval());
  }
  const std::int64_t now = Microseconds();
  publish_at_ =
      now +
      std::max(static_cast<std::int64_t>(interval * 1e6),
               static_cast<std::int64_t>(double(now - begin) / kMaxPictureFraction));
}

}  // namespace lanelight::live
