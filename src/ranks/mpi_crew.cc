#include "src/ranks/mpi_crew.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <string_view>
#include <utility>

#include "src/core/check.h"
#include "src/core/error.h"
#include "src/core/parallel.h"
#include "src/ranks/batch_bytes.h"
#include "src/ranks/naps.h"
#include "src/ranks/workshop.h"
#include "src/wavefront/run_clock.h"

namespace lanelight {
namespace {

// Rounds become longer, up to this: at the end of each, ranks wait for each other.
constexpr double kRoundSeconds = 4;
constexpr double kLongestTask = HandOut::kBatchSeconds / 2;
constexpr std::uint32_t kMostWidened = 1024;

}  // namespace

MpiCrew::MpiCrew() : threads_(MaxThreads()) {
  char own[MPI_MAX_PROCESSOR_NAME] = {};
  int size = 0;
  MPI_Get_processor_name(own, &size);
  std::vector<char> hosts(sizeof(own) * static_cast<std::size_t>(ranks()));
  MPI_Allgather(own, sizeof(own), MPI_CHAR, hosts.data(), sizeof(own), MPI_CHAR,
                MPI_COMM_WORLD);
  for (int r = 0; r < ranks(); ++r) {
    Member& member = members_.emplace_back();
    member.name = fmt::format("rank {} on {}", r,
                              &hosts[sizeof(own) * static_cast<std::size_t>(r)]);
  }
}

void MpiCrew::Agree(const std::string& what, const std::string& text,
                    const Difference& difference) {
  if (!leads()) {
    std::string bytes;
    Write(std::int32_t{MaxThreads()}, bytes);
    mail_.Send(0, Tag::kText, bytes + text);
    return mail_.AwaitSent();
  }
  threads_ = MaxThreads();
  for (int r = 1; r < ranks(); ++r) {
    const Message message = AwaitText(r);
    std::string_view bytes = message.bytes;
    Member& member = members_[static_cast<std::size_t>(r)];
    member.threads = Read<std::int32_t>(bytes);
    threads_ += member.threads;
    const std::string differs = difference(text, std::string(bytes));
    if (differs.empty()) continue;
    throw InputError(fmt::format("{} {}:{}", member.name, what, differs));
  }
}

Message MpiCrew::AwaitText(int rank) {
  auto& texts = members_[static_cast<std::size_t>(rank)].texts;
  for (Naps naps;; naps.Take(false)) {
    TakeTexts();
    if (!texts.empty()) {
      Message message = std::move(texts.front());
      texts.pop_front();
      return message;
    }
    mail_.Sent();
  }
}

// Whoever has failed is heard at once, even while another one takes its time.
void MpiCrew::TakeTexts() {
  for (int r = 1; r < ranks(); ++r) {
    auto message = mail_.Receive(r);
    if (!message) continue;
    if (message->tag == Tag::kFailed) {
      throw RankFailure("error: " + Name(r) + ": " + message->bytes);
    }
    CheckTag(*message, Tag::kText);
    members_[static_cast<std::size_t>(r)].texts.push_back(std::move(*message));
  }
}

std::string MpiCrew::Share(const std::string& bytes) {
  if (!leads()) return mail_.Await(0).bytes;
  for (int r = 1; r < ranks(); ++r) mail_.Send(r, Tag::kShared, bytes);
  mail_.AwaitSent();
  return bytes;
}

Round MpiCrew::Widen(const Round& round) const {
  return {round.per_task, round.chunks * widen_};
}

void MpiCrew::RunRound(const RoundWork& work, Tasks& tasks, TaskWatcher& watcher,
                       Films& films) {
  const auto start = std::chrono::steady_clock::now();
  HandOut queue(tasks.Behind(work.limit), threads_, cost_);
  LeaderRound round(work, tasks, watcher, films, mail_, members_, queue);
  round.Run([this](const std::string& failure) {
    stopped_ = true;
    if (failure_.empty()) failure_ = failure;
  });
  cost_ = queue.cost();
  if (round.gave_up()) stopped_ = gave_up_ = true;
  if (SecondsSince(start) < kRoundSeconds / 2 && queue.LongestSeconds() < kLongestTask) {
    widen_ = std::min(2 * widen_, kMostWidened);
  }
}

void MpiCrew::Dismiss() {
  if (!failure_.empty()) throw RankFailure("error: " + failure_);
  for (int r = 1; r < ranks(); ++r) mail_.Send(r, Tag::kEnd, "");
  if (!gave_up_) mail_.AwaitSent();
}

void MpiCrew::Serve(const Service& service) {
  Workshop workshop(service);
  Naps naps;
  while (true) {
    const std::optional<Message> message = mail_.Receive(0);
    if (message && message->tag == Tag::kEnd) return;
    if (message) {
      CheckTag(*message, Tag::kWork);
      workshop.Add(message->bytes);
    }
    const std::optional<std::string> answer = workshop.Finished();
    if (answer) mail_.Send(0, Tag::kDone, *answer);
    mail_.Sent();
    naps.Take(message || answer);
  }
}

void MpiCrew::Confess(const std::string& message) {
  mail_.Send(0, Tag::kFailed, message);
  for (Naps naps;; naps.Take(false)) mail_.Sent();
}

}  // namespace lanelight
