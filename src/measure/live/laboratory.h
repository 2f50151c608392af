// The one thread that renders for all pages, and their wishes on the way to it.
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

class Laboratory : private Attendant {
 public:
  /// `command`: as of Session.
  Laboratory(const Stage& stage, std::string command);
  /// Stops what is being rendered.
  ~Laboratory() override;
  Laboratory(const Laboratory&) = delete;
  Laboratory& operator=(const Laboratory&) = delete;

  // From any thread, and none of them waits for a render:
  /// A page opens; the number of its session. `send` is called by the laboratory's
  /// thread, until Leave has returned.
  int Enter(Send send);
  /// A message of the page. What is wrong with it is sent back.
  void Receive(int session, const std::string& message);
  /// The page is closed: what it has asked for is stopped and forgotten.
  void Leave(int session);

 private:
  struct Wish {
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
  void Push(Wish wish);
  /// Those that do not change what is being rendered, or all.
  void TakeWishes(bool all);
  void Grant(const Wish& wish);
  std::optional<Running> Choose();
  void Render(const Running& running);
  /// Until something is asked for, or a session is due that was not at `since`.
  void Wait(std::chrono::steady_clock::time_point since);
  bool Due() const override;
  void Attend() override;
  void Publish();
  void Tell(int session, const std::string& what);

  const Stage& stage_;
  const std::string command_;

  std::mutex mutex_;  // of the next five
  std::condition_variable woken_;
  std::vector<Wish> wishes_;
  std::map<int, std::shared_ptr<Send>> doors_;  // of sessions that have not left
  int next_session_ = 1;
  bool quit_ = false;

  std::atomic<bool> stop_{false};            // ends the pass
  std::atomic<bool> stop_all_{false};        // and previews, which are short, too
  std::atomic<bool> waiting_{false};         // wishes are
  std::atomic<std::int64_t> publish_at_{0};  // microseconds of the steady clock
  // Of the thread alone:
  std::map<int, std::shared_ptr<Session>> sessions_;
  int last_session_ = 0;  // that something was rendered for
  std::thread thread_;    // the last to be made
};

}  // namespace lanelight::live
