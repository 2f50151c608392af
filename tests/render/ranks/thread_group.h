// A group of ranks that are threads of one process.
#pragma once

#include <condition_variable>
#include <cstring>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "src/base/core/rank_group.h"

namespace lanelight {

/// The barrier of all ranks of a group.
class RankExchange {
 public:
  explicit RankExchange(int ranks) : messages_(static_cast<std::size_t>(ranks)) {}
  int ranks() const { return static_cast<int>(messages_.size()); }

  /// Returns what all have brought, by rank.
  std::vector<std::string> Exchange(int rank, std::string bytes) {
    std::unique_lock lock(mutex_);
    messages_[static_cast<std::size_t>(rank)] = std::move(bytes);
    const int round = round_;
    if (++arrived_ == ranks()) {
      all_ = messages_;
      arrived_ = 0;
      ++round_;
      changed_.notify_all();
    }
    changed_.wait(lock, [&] { return round_ != round; });
    return all_;
  }

  /// Returns what the partner has brought for `rank`.
  std::string Swap(int rank, int partner, std::string bytes) {
    std::unique_lock lock(mutex_);
    const auto own = std::pair(rank, partner), theirs = std::pair(partner, rank);
    changed_.wait(lock, [&] { return !letters_.contains(own); });
    letters_[own] = std::move(bytes);
    changed_.notify_all();
    changed_.wait(lock, [&] { return letters_.contains(theirs); });
    const auto letter = letters_.extract(theirs);
    changed_.notify_all();
    return letter.mapped();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::pair<int, int>, std::string> letters_;  // from, to
  std::vector<std::string> messages_, all_;
  int arrived_ = 0, round_ = 0;
};

class ThreadRank : public RankGroup {
 public:
  ThreadRank(RankExchange& exchange, int rank) : exchange_(exchange), rank_(rank) {}

  int rank() const override { return rank_; }
  int ranks() const override { return exchange_.ranks(); }
  std::string Name(int rank) const override { return "rank " + std::to_string(rank); }
  std::vector<int> AllGather(int number) override {
    std::vector<int> numbers;
    for (const std::string& text : exchange_.Exchange(rank_, std::to_string(number))) {
      numbers.push_back(std::stoi(text));
    }
    return numbers;
  }
  void Broadcast(std::span<char> bytes) override {
    const auto all = exchange_.Exchange(rank_, {bytes.begin(), bytes.end()});
    std::copy(all[0].begin(), all[0].end(), bytes.begin());
  }
  void Gather(std::string_view bytes, const Receiver& receive) override {
    const auto all = exchange_.Exchange(rank_, std::string(bytes));
    for (int r = 1; is_leader() && r < ranks(); ++r) {
      gathered_ += all[static_cast<std::size_t>(r)].size();
      receive(r, all[static_cast<std::size_t>(r)]);
    }
  }
  std::optional<RankStatus> Sum(const RankStatus& own,
                                const std::function<bool()>&) override {
    constexpr std::size_t kCount = sizeof(RankStatus) / sizeof(std::uint64_t);
    std::uint64_t sum[kCount] = {}, values[kCount];
    for (const std::string& bytes :
         exchange_.Exchange(rank_, {reinterpret_cast<const char*>(&own), sizeof(own)})) {
      std::memcpy(values, bytes.data(), sizeof(values));
      for (std::size_t i = 0; i < kCount; ++i) sum[i] += values[i];
    }
    RankStatus status;
    std::memcpy(&status, sum, sizeof(sum));
    return status;
  }
  std::optional<std::string> Swap(int partner, std::string bytes,
                                  const std::function<bool()>&) override {
    return exchange_.Swap(rank_, partner, std::move(bytes));
  }
  std::uint64_t bytes() const override { return gathered_; }
  int Leave(int exit_code) override { return exit_code; }
  int Fail(int exit_code, const std::string&) override { return exit_code; }

 private:
  RankExchange& exchange_;
  const int rank_;
  std::uint64_t gathered_ = 0;
};

/// Calls body(group) for each of so many ranks, the leader's on this thread; rethrows
/// what a worker has thrown, who must have come to the end of what is collective.
template <class Body>
void OnRanks(int ranks, const Body& body) {
  RankExchange exchange(ranks);
  std::vector<std::thread> workers;
  std::exception_ptr problem;
  for (int r = 1; r < ranks; ++r) {
    workers.emplace_back([&, r] {
      ThreadRank worker(exchange, r);
      try {
        body(worker);
      } catch (...) {
        problem = std::current_exception();
      }
    });
  }
  ThreadRank leader(exchange, 0);
  body(leader);
  for (std::thread& worker : workers) worker.join();
  if (problem) std::rethrow_exception(problem);
}

}  // namespace lanelight
