#include "src/ranks/workshop.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "src/core/check.h"
#include "src/core/clock.h"
#include "src/core/parallel.h"
#include "src/ranks/batch_bytes.h"
#include "src/wavefront/run_clock.h"
#include "src/wavefront/tasks.h"

namespace lanelight {

Workshop::Workshop(const Service& service)
    : service_(service),
      signal_(service.stop),
      rows_(service.films.Columns(), WindowOf(service.films)),
      thread_([this] { Work(); }) {}

Workshop::~Workshop() {
  End();
  thread_.join();
}

void Workshop::Add(std::string_view bytes) {
  const auto head = Read<WorkHead>(bytes);
  Batch batch;
  for (std::size_t i = 0; i < head.ranges; ++i) {
    batch.ranges.push_back(Read<TileRange>(bytes));
  }
  for (const TileRange& range : batch.ranges) Unpack(range, bytes);
  const std::lock_guard lock(mutex_);
  if (batches_.empty()) {
    // Of another round, perhaps; nobody reads these now.
    service_.begin(head.round.first);
    service_.tasks.BeginRound(head.round);
    cpu_ = ProcessCpuSeconds();
  }
  batches_.push_back(std::move(batch));
  more_.notify_all();
}

void Workshop::Unpack(const TileRange& range, std::string_view& bytes) {
  service_.tasks.Put(range.tile, range.begin);
  const PixelRect& rect = service_.tasks.rects().at(range.tile);
  if (range.begin > 0) {
    rows_.Put(rect, bytes.substr(0, rows_.BytesOf(rect)));
    bytes.remove_prefix(rows_.BytesOf(rect));
  }
  LL_CHECK_EQ(service_.films.film().Samples(rect.x0, rect.y0), range.begin);
}

std::optional<std::string> Workshop::Finished() {
  const std::lock_guard lock(mutex_);
  if (problem_) std::rethrow_exception(problem_);
  if (batches_.empty() || batches_.front().done < batches_.front().ranges.size()) {
    return std::nullopt;
  }
  const Batch batch = std::move(batches_.front());
  batches_.pop_front();
  return Answer(batch);
}

std::string Workshop::Answer(const Batch& batch) {
  DoneHead head;
  head.counts = batch.counts;
  const double now = ProcessCpuSeconds();
  head.counts.cpu_seconds = now - std::exchange(cpu_, now);
  head.ranges = batch.ranges.size();
  head.seconds = batch.seconds;
  head.interrupted = signal_.Stopped();
  std::string bytes;
  Write(head, bytes);
  for (const TileRange& range : batch.ranges) {
    Write(std::uint64_t{service_.tasks.Done(range.tile)}, bytes);
    rows_.Append(service_.tasks.rects()[range.tile], bytes);
  }
  return bytes;
}

void Workshop::End() {
  const std::lock_guard lock(mutex_);
  ended_ = true;
  more_.notify_all();
}

void Workshop::Work() {
  try {
    ParallelFor(static_cast<std::size_t>(MaxThreads()), [this](std::size_t) {
      try {
        WorkInThread();
      } catch (...) {
        End();
        throw;
      }
    });
  } catch (...) {
    const std::lock_guard lock(mutex_);
    problem_ = std::current_exception();
  }
}

void Workshop::WorkInThread() {
  std::unique_lock lock(mutex_);
  while (!ended_) {
    const auto open = std::find_if(batches_.begin(), batches_.end(), [](const Batch& b) {
      return b.begun < b.ranges.size();
    });
    if (open == batches_.end()) {
      more_.wait(lock);
    } else {
      BringOn(*open, lock);
    }
  }
}

// The next range of a batch; without the lock while it is rendered.
void Workshop::BringOn(Batch& batch, std::unique_lock<std::mutex>& lock) {
  const TileRange range = batch.ranges[batch.begun++];
  lock.unlock();
  const auto start = std::chrono::steady_clock::now();
  const RunCounts counts = service_.tasks.BringOn(range, signal_, service_.films);
  lock.lock();
  batch.counts.Add(counts);
  batch.seconds += SecondsSince(start);
  ++batch.done;
}

}  // namespace lanelight
