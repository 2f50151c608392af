// The one thread that renders for all pages, and their requests on the way to it.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "src/measure/live/session.h"

namespace lanelight::live {

class RenderThread : private PassObserver {
 public:
  /// `command`: as of Session.
  RenderThread(const LiveScene& live_scene, std::string command);
  /// Stops what is being rendered.
  ~RenderThread() override;
  RenderThread(const RenderThread&) = delete;
  RenderThread& operator=(const RenderThread&) = delete;

  // From any thread, and none of them waits for a render:
  /// A page opens; the number of its session. `send` is called by the render_thread's
  /// thread, until RemoveSession has returned.
  int Enter(Send send);
  /// A message of the page. Sends an error back if it is invalid.
  void Receive(int session, const std::string& message);
  /// The page is closed: what it has asked for is stopped and forgotten.
  void RemoveSession(int session);

 private:
  struct Request {
    int session = 0;
    std::shared_ptr<Send> enter;            // a new session
    std::optional<nlohmann::json> command;  // neither: it leaves

    bool IsUrgent() const { return command ? ChangesWork(*command) : enter == nullptr; }
  };
  struct Running {
    std::shared_ptr<Session> session;
    Work work;
  };

  void Loop();
  void Push(Request request);
  /// Handles all requests, or only those that do not change the current render.
  void HandleRequests(bool all);
  void Serve(const Request& request);
  std::optional<Running> Choose();
  void Render(const Running& running);
  /// Until something is asked for, or a session is due that was not at `since`.
  void Wait(std::chrono::steady_clock::time_point since);
  bool IsDue() const override;
  void Observe() override;
  void Publish();
  void SendError(int session, const std::string& what);

  const LiveScene& live_scene_;
  const std::string command_;

  std::mutex mutex_;  // of the next five
  std::condition_variable woken_;
  std::vector<Request> requests_;
  std::map<int, std::shared_ptr<Send>> senders_;  // of sessions that have not left
  int next_session_ = 1;
  bool quit_ = false;

  std::atomic<bool> stop_{false};            // ends the pass
  std::atomic<bool> stop_all_{false};        // and previews, which are short, too
  std::atomic<bool> waiting_{false};         // requests are
  std::atomic<std::int64_t> publish_at_{0};  // microseconds of the steady clock
  // Only the thread uses these:
  std::map<int, std::shared_ptr<Session>> sessions_;
  int last_session_ = 0;  // that something was rendered for
  std::thread thread_;    // the last to be made
};

}  // namespace lanelight::live
