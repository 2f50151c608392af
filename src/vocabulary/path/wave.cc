#include "src/vocabulary/path/wave.h"

#include <utility>

namespace lanelight {

ColumnLists::ColumnLists(const PathColumns& path, const FeatureSet& features) {
  const auto place = [&](Field field, std::uint32_t* column) {
    if (column == nullptr) return;
    const Lifetime lifetime = FieldLifetime(field, features);
    const FirstValue first = FieldFirstValue(field);
    if (IsCopied(lifetime)) copied.Add(column);
    if (lifetime == Lifetime::kGathered) {
      copy_values[begun_by_split_paths.count] = first.bits;
      begun_by_split_paths.Add(column);
    }
    if (!IsCarried(lifetime)) return;
    carried.Add(column);
    if (!first.any) return;
    first_values[begun.count] = first.bits;
    begun.Add(column);
  };
#define X(type, name, ...) \
  place(Field::name, reinterpret_cast<std::uint32_t*>(path.name));
  LANELIGHT_PATH_FIELDS(X)
#undef X
}

void Wave::Reset() {
  for (Queue& queue : queues) queue.size = 0;
  Queue& free = queue(QueueId::kFree);
  // The generate stage takes slots from the end: slot 0 first.
  for (std::uint32_t i = 0; i < capacity; ++i) free.items[i] = capacity - 1 - i;
  free.size = capacity;
}

void Wave::Begin(const TileWork& new_work, const SampleBuffer& new_buffer) {
  Reset();
  work = new_work;
  buffer = new_buffer;
}

void Wave::BeginWave() {
  std::swap(queue(QueueId::kActive), queue(QueueId::kScattered));
  for (int i = 0; i < kNumQueues; ++i) {
    const QueueId id = static_cast<QueueId>(i);
    if (id != QueueId::kFree && id != QueueId::kActive) queues[i].size = 0;
  }
}

}  // namespace lanelight
