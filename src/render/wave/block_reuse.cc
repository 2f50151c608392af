#include "src/render/wave/block_reuse.h"

#include <algorithm>
#include <limits>

#include "src/base/core/check.h"
#include "src/render/wave/phase_driver.h"
#include "src/vocabulary/path/sent.h"

namespace lanelight {
namespace {

// The vectors of every kind of receiving material may be padded.
constexpr std::uint32_t kMaxReceivers =
    kMaxReusedPaths + kMaxLanes * std::uint32_t(kNumShadeKinds);

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
      : at_(at), stride_((entries + 2 * kMaxLanes - 1) / kMaxLanes * kMaxLanes) {}

  template <typename T>
  void Place(T*& column) {
    column = reinterpret_cast<T*>(at_);
    at_ += stride_;
  }
  std::size_t stride() const { return stride_; }
  std::uint32_t* end() const { return at_; }

 private:
  std::uint32_t* at_;
  std::size_t stride_;
};

// Copies live columns of `paths` that are in `fields` to columns of `to`.
StoredColumns Keep(FieldSet fields, const PathColumns& paths, PathColumns& to,
                   Placer& placer) {
  StoredColumns kept;
#define X(type, name, ...)                                                      \
  if (paths.name != nullptr && fields.Has(Field::name)) {                       \
    placer.Place(to.name);                                                      \
    kept.from[kept.count] = reinterpret_cast<const std::uint32_t*>(paths.name); \
    kept.to[kept.count++] = reinterpret_cast<std::uint32_t*>(to.name);          \
  }
  LANELIGHT_PATH_FIELDS(X)
#undef X
  return kept;
}

template <class Columns>
constexpr std::size_t kColumnsOf = sizeof(Columns) / sizeof(void*);
constexpr std::size_t kRayColumns = 14;  // PlacePairs

// Part of the second vertices with light that roulette keeps.
constexpr double kKeptSuffixes = 0.5;

}  // namespace

BlockReuse::BlockReuse(const Plan& plan, const Strategy& strategy)
    : plan_(plan), paths_(strategy.reused_paths), layout_(strategy.block_layout) {
  LL_CHECK(plan.features.Has(Feature::kReuse));
  block_.first = &first_;
  block_.glossy_surface = &glossy_;
  wave_.block = &block_;
  wave_.kernels = plan.ray_kernels;
  PlacePairs();
}

void BlockReuse::PlacePairs() {
  const std::uint32_t receivers =
      std::min(kMaxReceivers, paths_ + kMaxLanes * KindsOf(plan_.features));
  const std::uint32_t rows =
      plan_.features.Has(Feature::kReuseGlossy) ? 2 * paths_ : paths_;
  const std::size_t maximum = std::size_t{receivers} * paths_;
  const std::size_t stride = Placer(nullptr, maximum).stride();
  const std::size_t of_pairs = Placer(nullptr, std::size_t{receivers} * rows).stride();
  const std::size_t small = Placer(nullptr, receivers).stride();
  pairs_.resize(of_pairs * kColumnsOf<PairColumns> + stride * kRayColumns + small * 4);
  Placer placer(pairs_.data(), std::size_t{receivers} * rows);
#define X(type, name, meaning) placer.Place(block_.pairs.name);
  LANELIGHT_PAIR_COLUMNS(X)
#undef X
  Placer rays(placer.end(), maximum);
  PathColumns& ray = wave_.path;
  for (float** column :
       {&ray.p_x, &ray.p_y, &ray.p_z, &ray.ng_x, &ray.ng_y, &ray.ng_z, &ray.p_error,
        &ray.ls_x, &ray.ls_y, &ray.ls_z, &ray.ls_distance}) {
    rays.Place(*column);
  }
  rays.Place(ray.prim);
  // Kernels of shadow rays filter them into kScratch.
  for (const QueueId id : {QueueId::kShadow, QueueId::kScratch}) {
    rays.Place(wave_.queue(id).items);
  }
  Placer rest(rays.end(), receivers);
  rest.Place(block_.receivers);
  for (float*& sums : block_.sums) rest.Place(sums);
  wave_.capacity = std::uint32_t(maximum);
}

void BlockReuse::MakeRoom(std::uint32_t samples, const PathColumns& paths) {
  if (samples <= room_) return;
  room_ = samples;
  const FieldSet first = FirstVertexFields(plan_.features.Has(Feature::kHair),
                                           plan_.features.Has(Feature::kMeasured));
  const FieldSet glossy = GlossyVertexFields();
  const bool any_glossy = plan_.features.Has(Feature::kReuseGlossy);
  std::size_t columns = kColumnsOf<ReuseColumns>;
  if (any_glossy) columns += kColumnsOf<GlossyColumns>;
  for (const Field field : plan_.live_fields) {
    columns += first.Has(field);
    columns += any_glossy && glossy.Has(field);
  }
  records_.resize(Placer(nullptr, samples).stride() * columns);
  Placer placer(records_.data(), samples);
#define X(type, name, meaning) placer.Place(block_.second.name);
  LANELIGHT_REUSE_COLUMNS(X)
#undef X
  block_.first_columns = Keep(first, paths, first_.path, placer);
  if (!any_glossy) return;
#define X(type, name, meaning) placer.Place(block_.glossy.name);
  LANELIGHT_GLOSSY_COLUMNS(X)
#undef X
  block_.glossy_columns = Keep(glossy, paths, glossy_.path, placer);
}

void BlockReuse::Begin(const TileWork& work, Wave& paths) {
  const std::uint32_t samples = work.num_pixels * work.samples;
  LL_CHECK_LT(samples, 1u << 21);  // kernels/reuse/block-inl.h
  MakeRoom(samples, paths.path);
  std::fill_n(block_.second.state, samples, std::uint32_t(ReuseState::kNoVertex));
  for (Wave* wave : {&first_, &glossy_, &wave_}) {
    static_cast<SceneParts&>(*wave) = paths;
    wave->run = paths.run;
  }
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

// The brightness c for which the sum of min(1, sent / c) over the second vertices of the
// tile is kKeptSuffixes of those that send light. A multiple of their mean is not it: a
// rare bright one would have all others played for.
float BlockReuse::CertainlyKept(std::uint32_t sample) {
  const std::uint32_t pixels = wave_.work.num_pixels;
  sent_.clear();
  for (std::uint32_t i = 0; i < pixels; ++i) {
    const float maximum = MaxSent(wave_, sample * pixels + i);
    if (maximum > 0) sent_.push_back(maximum);
  }
  const double kept = kKeptSuffixes * double(sent_.size());
  double c = std::numeric_limits<double>::infinity();
  for (;;) {
    double dim = 0, bright = 0;
    for (const float maximum : sent_) {
      if (maximum < c) {
        dim += maximum;
      } else {
        ++bright;
      }
    }
    if (!(dim > 0 && bright < kept)) return float(c);
    const double next = dim / (kept - bright);
    if (!(next < c)) return float(c);
    c = next;
  }
}

void BlockReuse::ConnectSample(const BlockKey& key, std::uint32_t sample,
                               StageClock* clock) {
  LayOutBlocks(key, layout_, paths_, order_);
  members_.resize(order_.places.size() + kMaxLanes);
  const std::uint32_t first = sample * wave_.work.num_pixels;
  for (std::size_t i = 0; i < order_.places.size(); ++i) {
    members_[i] = first + order_.places[i];
  }
  // Vectors read past the end.
  std::fill_n(members_.end() - kMaxLanes, kMaxLanes, first);
  block_.sample = sample;
  block_.records = members_.data();
  block_.size = wave_.work.num_pixels;
  // Only glossy second vertices are prepared for the whole tile.
  const Phase* const tile = plan_.Find(PhaseId::kTile);
  if (tile != nullptr) RunPhase(wave_, *tile, clock);
  block_.certainly_kept = CertainlyKept(sample);
  const Phase& blocks = *plan_.Find(PhaseId::kBlock);
  std::uint32_t begin = 0;
  std::size_t b = 0;
  for (const std::uint32_t end : order_.ends) {
    block_.records = members_.data() + begin;
    block_.size = end - begin;
    block_.u = order_.numbers[b++];
    begin = end;
    RunPhase(wave_, blocks, clock);
  }
}

}  // namespace lanelight
