#include "src/render/train/rank_passes.h"

#include <cstring>
#include <string>
#include <string_view>

#include "src/base/core/check.h"

namespace lanelight {
namespace {

// Calls copy(values, count) for the colours and for the records of each task that
// `rank` of so many renders.
template <class Samples, class Copy>
void ForEachTask(const std::vector<std::size_t>& begins, int rank, int ranks,
                 Samples& samples, const Copy& copy) {
  const auto planes = std::size_t(samples.planes);
  for (auto task = std::size_t(rank); task + 1 < begins.size();
       task += std::size_t(ranks)) {
    const std::size_t first = begins[task], count = begins[task + 1] - first;
    copy(samples.colors.data() + first, count);
    if (planes > 0) copy(samples.recorded.data() + first * planes, count * planes);
  }
}

}  // namespace

// Precedes the samples of a rank, and of all ranks.
struct RankPasses::Head {
  std::uint64_t rays_closest = 0, rays_shadow = 0, stopped = 0;

  void Add(const Head& other) {
    rays_closest += other.rays_closest;
    rays_shadow += other.rays_shadow;
    stopped += other.stopped;
  }
};

RankPasses::Head RankPasses::OwnHeader(const TrainingSamples& samples) const {
  return {samples.rays_closest, samples.rays_shadow, signal_.IsStopped()};
}

std::string RankPasses::OwnPart(const std::vector<std::size_t>& begins,
                                const TrainingSamples& samples) const {
  const Head head = OwnHeader(samples);
  std::string bytes(reinterpret_cast<const char*>(&head), sizeof(head));
  ForEachTask(begins, group_.rank(), group_.ranks(), samples,
              [&bytes](const auto* values, std::size_t count) {
                bytes.append(reinterpret_cast<const char*>(values),
                             count * sizeof(*values));
              });
  return bytes;
}

void RankPasses::Exchange(const std::vector<std::size_t>& begins,
                          TrainingSamples& samples) {
  Head sum = OwnHeader(samples);
  group_.Gather(group_.is_leader() ? "" : OwnPart(begins, samples),
                [&](int rank, std::string_view bytes) {
                  const auto read = [&bytes](auto* to, std::size_t count) {
                    const std::size_t size = count * sizeof(*to);
                    LL_CHECK_GE(bytes.size(), size);
                    std::memcpy(to, bytes.data(), size);
                    bytes.remove_prefix(size);
                  };
                  Head head;
                  read(&head, 1);
                  sum.Add(head);
                  ForEachTask(begins, rank, group_.ranks(), samples, read);
                  LL_CHECK(bytes.empty());
                });
  const auto broadcast = [this](auto* values, std::size_t count) {
    group_.Broadcast({reinterpret_cast<char*>(values), count * sizeof(*values)});
  };
  broadcast(&sum, 1);
  broadcast(samples.colors.data(), samples.colors.size());
  if (samples.planes > 0) broadcast(samples.recorded.data(), samples.recorded.size());
  samples.rays_closest = sum.rays_closest, samples.rays_shadow = sum.rays_shadow;
  if (sum.stopped > 0) stop_ = true;
}

}  // namespace lanelight
