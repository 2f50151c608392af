#include "src/render/wave/stage_clock.h"

#include <algorithm>
#include <cerrno>
#include <numeric>

namespace lanelight {

StageClock::StageClock(std::size_t stages, const ProfileOptions& options)
    : rows_(stages + kNumTaskParts),
      stages_(stages),
      totals_(stages + kNumTaskParts),
      events_(options.trace_events),
      use_counters_(options.counters),
      bounces_(options.bounces ? kMaxBounces : 0) {
  next_event_ = events_.data();
  end_event_ = next_event_ + events_.size();
}

UntouchedVector<TraceEvent> StageClock::ReleaseEvents() {
  if (!events_.empty()) {
    events_.resize(std::size_t(next_event_ - events_.data()));
  }
  next_event_ = end_event_ = nullptr;
  return std::move(events_);
}

void StageClock::StartTask() {
  if (use_counters_ && thread_ != std::this_thread::get_id()) {
    thread_ = std::this_thread::get_id();
    group_.emplace(HardwareEvents());
    if (group_->error() != 0) counter_error_ = group_->error();
    use_counters_ = group_->available();
  }
  counting_ = false;
  task_cpu_ = ThreadCpuSeconds();
  task_start_ = last_ = Ticks();
}

double StageClock::EndTask() {
  const std::uint64_t ticks = std::max<std::uint64_t>(Ticks() - task_start_, 1);
  const double cpu = ThreadCpuSeconds() - task_cpu_;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    totals_[i].seconds += cpu * double(rows_[i].ticks) / double(ticks);
    rows_[i].ticks = 0;
  }
  for (std::size_t i = 0; i < bounces_.size(); ++i) {
    bounces_[i][kBounceSeconds] += cpu * bounce_ticks_[i] / double(ticks);
    bounce_ticks_[i] = 0;
  }
  ticks_ += ticks;
  cpu_seconds_ += cpu;
  return cpu;
}

BounceProfile StageClock::CostsSoFar(const Wave& wave) const {
  BounceProfile sum = {double(last_ - task_start_), double(wave.rays_closest),
                       double(wave.rays_shadow)};
  for (const StageCounters& row : rows_) {
    sum[kBounceItems] += double(row.items);
    sum[kBounceSlots] += double(row.lane_slots);
  }
  return sum;
}

void StageClock::StartBounces(Wave& wave) {
  if (bounces_.empty()) return;
  paths_ = {};
  const Queue& active = wave.queue(QueueId::kActive);
  for (std::uint32_t i = 0; i < active.size; ++i) {
    ++paths_[std::min<std::size_t>(wave.path.depth[active.items[i]], kMaxBounces - 1)];
  }
  last_ = Ticks();  // no stage is charged with the counting
  wave_start_ = CostsSoFar(wave);
}

void StageClock::EndBounces(Wave& wave) {
  if (bounces_.empty()) return;
  paths_[0] += wave.queue(QueueId::kCamera).size;
  const double all = std::max(1.0, std::accumulate(paths_.begin(), paths_.end(), 0.0));
  const BounceProfile end = CostsSoFar(wave);
  for (std::size_t i = 0; i < kMaxBounces; ++i) {
    const double part = paths_[i] / all;
    bounce_ticks_[i] += part * (end[kBounceSeconds] - wave_start_[kBounceSeconds]);
    for (std::size_t k = kBounceSeconds + 1; k < end.size(); ++k) {
      bounces_[i][k] += part * (end[k] - wave_start_[k]);
    }
  }
  last_ = Ticks();
}

void StageClock::StartWave() {
  if (!use_counters_) return;
  random_ = random_ * 6364136223846793005u + 1442695040888963407u;
  counting_ = first_ || (random_ >> 59) == 0;
  first_ = false;
  if (!counting_) return;
  counting_ = ReadCounters(&at_);
  last_ = Ticks();
}

void StageClock::Count(std::size_t row, std::uint64_t items) {
  StageTotals& c = totals_[row];
  CounterValues now;
  counting_ = ReadCounters(&now);
  if (!counting_) return;
  for (std::size_t i = 0; i < now.size(); ++i) c.counted[i] += now[i] - at_[i];
  c.counted_items += items;
  // Read again: what reading takes belongs to no stage.
  counting_ = ReadCounters(&at_);
  last_ = Ticks();
}

bool StageClock::ReadCounters(CounterValues* values) {
  if (group_->Read(values)) return true;
  counter_error_ = EBUSY;
  return false;
}

}  // namespace lanelight
