#include "src/wavefront/block_reuse.h"

#include <algorithm>

#include "src/core/check.h"

namespace lanelight {
namespace {

// Of every kind of material that receives, a vector may be padded.
constexpr std::uint32_t kMostReceivers =
    kMostReusedPaths + kMostLanes * static_cast<std::uint32_t>(kNumShadeKinds);

std::uint32_t KindsOf(const FeatureSet& features) {
  std::uint32_t kinds = 0;
  for (int k = 0; k < kNumShadeKinds; ++k) {
    kinds += features.Has(ShadeFeature(static_cast<ShadeKind>(k)));
  }
  return kinds;
}

/// Columns one after the other, with a vector's room behind each.
class Placer {
 public:
  Placer(std::uint32_t* at, std::size_t entries)
      : at_(at), stride_((entries + 2 * kMostLanes - 1) / kMostLanes * kMostLanes) {}

  template <typename T>
  void Place(T*& column) {
    column = reinterpret_cast<T*>(at_);
    at_ += stride_;
  }
  std::size_t stride() const { return stride_; }

 private:
  std::uint32_t* at_;
  std::size_t stride_;
};

constexpr int kReuseColumns = static_cast<int>(sizeof(ReuseColumns) / sizeof(void*));
constexpr int kPairColumns = static_cast<int>(sizeof(PairColumns) / sizeof(void*));
constexpr int kRayColumns = 12;  // PlacePairs

}  // namespace

BlockReuse::BlockReuse(const Plan& plan, const Strategy& strategy)
    : plan_(plan), paths_(strategy.reused_paths), layout_(strategy.block_layout) {
  LL_CHECK(plan.features.Has(Feature::kReuse));
  block_.first = &first_;
  wave_.block = &block_;
  wave_.kernels = plan.ray_kernels;
  PlacePairs();
}

std::size_t BlockReuse::bytes() const {
  return (records_.size() + pairs_.size()) * sizeof(std::uint32_t);
}

void BlockReuse::PlacePairs() {
  const std::uint32_t receivers =
      std::min(kMostReceivers, paths_ + kMostLanes * KindsOf(plan_.features));
  const std::size_t most = std::size_t{receivers} * paths_;
  const std::size_t stride = Placer(nullptr, most).stride();
  const std::size_t small = Placer(nullptr, receivers).stride();
  // Kernels of shadow rays filter them into kScratch.
  pairs_.resize(stride * (kPairColumns + kRayColumns + 2) + small * 4);
  Placer placer(pairs_.data(), most);
#define X(type, name, meaning) placer.Place(block_.pairs.name);
  LANELIGHT_PAIR_COLUMNS(X)
#undef X
  PathColumns& ray = wave_.path;
  for (float** column :
       {&ray.p_x, &ray.p_y, &ray.p_z, &ray.ng_x, &ray.ng_y, &ray.ng_z, &ray.p_error,
        &ray.ls_x, &ray.ls_y, &ray.ls_z, &ray.ls_distance}) {
    placer.Place(*column);
  }
  placer.Place(ray.prim);
  for (const QueueId id : {QueueId::kShadow, QueueId::kScratch}) {
    placer.Place(wave_.queue(id).items);
  }
  Placer rest(pairs_.data() + stride * (kPairColumns + kRayColumns + 2), receivers);
  rest.Place(block_.receivers);
  for (float*& sums : block_.sums) rest.Place(sums);
  wave_.capacity = static_cast<std::uint32_t>(most);
}

void BlockReuse::MakeRoom(std::uint32_t samples, const PathColumns& paths) {
  if (samples <= room_) return;
  room_ = samples;
  const FieldSet kept = FirstVertexFields();
  std::size_t columns = kReuseColumns;
  for (const Field field : plan_.live_fields) columns += kept.Has(field);
  records_.resize(Placer(nullptr, samples).stride() * columns);
  Placer placer(records_.data(), samples);
#define X(type, name, meaning) placer.Place(block_.second.name);
  LANELIGHT_REUSE_COLUMNS(X)
#undef X
  block_.num_columns = 0;
  const auto keep = [&](const std::uint32_t* from, std::uint32_t* to) {
    block_.from[block_.num_columns] = from;
    block_.to[block_.num_columns++] = to;
  };
#define X(type, name, ...)                                    \
  if (paths.name != nullptr && kept.Has(Field::name)) {       \
    placer.Place(first_.path.name);                           \
    keep(reinterpret_cast<const std::uint32_t*>(paths.name),  \
         reinterpret_cast<std::uint32_t*>(first_.path.name)); \
  }
  LANELIGHT_PATH_FIELDS(X)
#undef X
}

void BlockReuse::Begin(const TileWork& work, Wave& paths) {
  const std::uint32_t samples = work.num_pixels * work.samples;
  LL_CHECK_LT(samples, 1u << 21);  // kernels/reuse/block-inl.h
  MakeRoom(samples, paths.path);
  std::fill_n(block_.second.state, samples,
              static_cast<std::uint32_t>(ReuseState::kNoVertex));
  first_.scene = wave_.scene = paths.scene;
  first_.run = wave_.run = paths.run;
  paths.block = &block_;
}

void BlockReuse::Connect(const PixelRect& tile, Wave& paths, StageClock* clock) {
  wave_.work = paths.work;
  wave_.buffer = paths.buffer;
  wave_.rays_shadow = 0;
  wave_.health = {};
  for (std::uint32_t s = 0; s < paths.work.samples; ++s) {
    ConnectSample({tile, paths.run->seed, paths.work.first_sample + s}, s, clock);
  }
  paths.rays_shadow += wave_.rays_shadow;
  paths.health.nan += wave_.health.nan;
  paths.health.infinite += wave_.health.infinite;
  paths.health.negative += wave_.health.negative;
}

// Of the second vertices of the tile that send light: its brightest channel.
float BlockReuse::MeanSent(std::uint32_t sample) const {
  const TileWork& work = wave_.work;
  const std::uint32_t* const states = block_.second.state + sample * work.num_pixels;
  const std::size_t stride = wave_.buffer.stride;
  double sum = 0, count = 0;
  for (std::uint32_t i = 0; i < work.num_pixels; ++i) {
    if (states[i] != static_cast<std::uint32_t>(ReuseState::kSecond)) continue;
    const float* color = wave_.buffer.samples + i * work.samples + sample;
    const float most = std::max({color[0], color[stride], color[2 * stride]});
    if (!(most > 0)) continue;
    sum += most;
    ++count;
  }
  return count > 0 ? static_cast<float>(sum / count) : 0;
}

void BlockReuse::ConnectSample(const BlockKey& key, std::uint32_t sample,
                               StageClock* clock) {
  LayOutBlocks(key, layout_, paths_, order_);
  members_.resize(order_.places.size() + kMostLanes);
  const std::uint32_t first = sample * wave_.work.num_pixels;
  for (std::size_t i = 0; i < order_.places.size(); ++i) {
    members_[i] = first + order_.places[i];
  }
  // Vectors read past the end.
  std::fill_n(members_.end() - kMostLanes, kMostLanes, first);
  block_.sample = sample;
  std::uint32_t begin = 0;
  block_.mean_sent = MeanSent(sample);
  std::size_t b = 0;
  for (const std::uint32_t end : order_.ends) {
    block_.records = members_.data() + begin;
    block_.size = end - begin;
    block_.u = order_.numbers[b++];
    begin = end;
    for (std::size_t i = 0; i < plan_.block_stages.size(); ++i) {
      wave_.lanes = {};
      plan_.block_stages[i].kernel(wave_);
      if (clock == nullptr) continue;
      clock->Finish(plan_.stages.size() + i, wave_.lanes.items, wave_.lanes.vectors);
    }
  }
}

}  // namespace lanelight
