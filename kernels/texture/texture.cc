// The texture stage: material parameters of every surface hit, from the material's
// constants or its textures.
#include "kernels/simd/each_target-inl.h"

#include <limits>

#include "kernels/queue/batch-inl.h"
#include "kernels/texture/texture-inl.h"
#include "src/scene/compiled/materials.h"
#include "src/scene/compiled/texture_table.h"

LANELIGHT_BEGIN_KERNELS

// Hits grouped by texture: a vector of neighbours may need several textures, each in a
// few of its lanes.
class TexturedHits {
 public:
  static constexpr uint32_t kMaxHits = 2048;

  LANELIGHT_INLINE void Add(VI slots, VI ids, MF mask) {
    const uint32_t end = size_;
    Append(slots, mask, slots_, end);
    size_ = end + Append(ids, mask, ids_, end);
  }
  LANELIGHT_INLINE bool empty() const { return size_ == 0; }

  /// Moves the hits with the texture of the first one to `selected`; returns that
  /// texture.
  LANELIGHT_INLINE int32_t SelectTexture(Queue& selected) {
    const DI di;
    const uint32_t lanes = static_cast<uint32_t>(hn::Lanes(di));
    const int32_t first = ids_[0];
    uint32_t left = 0;
    selected.size = 0;
    for (uint32_t i = 0; i < size_; i += lanes) {
      // Appended slots lie before the end of this vector, so they have been read already.
      const VI slots = hn::LoadU(di, slots_ + i), ids = hn::LoadU(di, ids_ + i);
      const MF valid = hn::FirstN(DF(), size_ - i);
      const MF same = hn::RebindMask(DF(), hn::Eq(ids, hn::Set(di, first)));
      const MF others = hn::AndNot(same, valid);
      Push(selected, slots, hn::And(same, valid));
      Append(slots, others, slots_, left);
      left += Append(ids, others, ids_, left);
    }
    size_ = left;
    PadTail(selected);
    return first;
  }

 private:
  // Returns the number appended.
  LANELIGHT_INLINE static uint32_t Append(VI values, MF mask, int32_t* to, uint32_t end) {
    hn::StoreU(hn::Compress(values, hn::RebindMask(DI(), mask)), DI(), to + end);
    return static_cast<uint32_t>(hn::CountTrue(DF(), mask));
  }

  static constexpr std::size_t kRoom = kMaxHits + hn::MaxLanes(DI());
  HWY_ALIGN int32_t slots_[kRoom], ids_[kRoom];
  uint32_t size_ = 0;
};

LANELIGHT_INLINE Slots SlotsAt(const Queue& queue, uint32_t i) {
  return Slots(hn::BitCast(DI(), hn::LoadU(DU(), queue.items + i)));
}

// `places`: the texture depends on the position.
template <class Point>
LANELIGHT_INLINE Point LoadPoint(const PathColumns& path, const Slots& slots,
                                 bool places) {
  const VF u = Gather(path.uv_u, slots), v = Gather(path.uv_v, slots);
  if constexpr (Point::kHasPlace) {
    Point at;
    at.u = u, at.v = v;
    at.p = Gather3(path.p_x, path.p_y, path.p_z, slots);
    at.n = Gather3(path.ng_x, path.ng_y, path.ng_z, slots);
    if constexpr (Point::kHasFootprint) {
      at.footprint = LoadFootprint(path, slots);
      at.step_x = at.step_y = Splat3(0, 0, 0);
      if (places) {
        at.SetSteps(Gather3(path.tg_x, path.tg_y, path.tg_z, slots),
                    Gather3(path.tv_x, path.tv_y, path.tv_z, slots));
      }
    }
    return at;
  } else {
    return Point{u, v};
  }
}

// A parameter of materials has `textures` by material, the constant of a material, and
// one column or three, to which Store() writes constants and StoreTextured() texture
// values.
template <class Point, class Parameter>
HWY_NOINLINE void EvalParameter(Wave& wave, const Parameter& parameter) {
  const PathColumns& path = wave.path;
  const TextureTable& table = *wave.textures;
  const Queue& queue = wave.queue(QueueId::kSurface);
  const uint32_t lanes = static_cast<uint32_t>(hn::Lanes(DI()));
  HWY_ALIGN uint32_t room[TexturedHits::kMaxHits + hn::MaxLanes(DI())];
  Queue selected = {room, 0};
  for (uint32_t begin = 0; begin < queue.size; begin += TexturedHits::kMaxHits) {
    const uint32_t end = HWY_MIN(queue.size, begin + TexturedHits::kMaxHits);
    TexturedHits hits;
    for (uint32_t i = begin; i < end; i += lanes) {
      const StoreSlots slots = SlotsAt(queue, i);
      const VI material = Gather(path.material, slots);
      parameter.Store(slots, material, parameter.Constant(material));
      const VI ids = Lookup(parameter.textures, material);
      const MF textured = hn::RebindMask(DF(), hn::Gt(ids, hn::Set(DI(), -1)));
      if (hn::AllFalse(DF(), textured)) continue;
      hits.Add(slots, ids, hn::And(textured, hn::FirstN(DF(), end - i)));
    }
    while (!hits.empty()) {
      const int32_t texture = hits.SelectTexture(selected);
      const bool places = table.programs[texture].uses_place;
      for (uint32_t i = 0; i < selected.size; i += lanes) {
        const StoreSlots slots = SlotsAt(selected, i);
        const V3 value =
            EvalTexture(table, texture, LoadPoint<Point>(path, slots, places));
        parameter.StoreTextured(slots, Gather(path.material, slots), value);
      }
    }
  }
}

// Returns the upper bound of a colour parameter: 1 for reflectances, none for indices.
LANELIGHT_INLINE VF ColorLimit(const MaterialTable& materials, VI material) {
  const VI kind = Lookup(materials.kind, material);
  const auto is = [&](ShadeKind k) HWY_ATTR {
    return hn::Eq(kind, hn::Set(DI(), static_cast<int32_t>(k)));
  };
  const auto index_of_refraction = hn::Or(
      hn::Or(is(ShadeKind::kConductorSmooth), is(ShadeKind::kConductorRough)),
      hn::Or(is(ShadeKind::kCoatedConductor), is(ShadeKind::kCoatedConductorMedium)));
  return hn::IfThenElse(hn::RebindMask(DF(), index_of_refraction), Splat(3e38f),
                        Splat(1.0f));
}

struct ColorParameter {
  const MaterialTable& materials;
  bool reflects;  // a reflectance, for all materials
  const AlignedVector<int32_t>& textures;
  const AlignedVector<float>*constant_r, *constant_g, *constant_b;
  float *r, *g, *b;

  LANELIGHT_INLINE V3 Constant(VI material) const {
    return {Lookup(*constant_r, material), Lookup(*constant_g, material),
            Lookup(*constant_b, material)};
  }
  LANELIGHT_INLINE void Store(const StoreSlots& slots, VI material, V3 color) const {
    const VF zero = Splat(0.0f);
    const VF limit = reflects ? Splat(1.0f) : ColorLimit(materials, material);
    const auto clamped = [&](VF c) HWY_ATTR { return hn::Min(hn::Max(c, zero), limit); };
    Scatter3({clamped(color.x), clamped(color.y), clamped(color.z)}, r, g, b, slots);
  }
  LANELIGHT_INLINE void StoreTextured(const StoreSlots& slots, VI material,
                                      V3 value) const {
    Store(slots, material, value);
  }
};

// GGX alpha: the constant, or from the texture, remapped as the material asks and at
// least 1e-4, as in pbrt.
struct AlphaParameter {
  const MaterialTable& materials;
  const AlignedVector<int32_t>& textures;
  const AlignedVector<float>& constants;
  float* alpha;

  LANELIGHT_INLINE VF Constant(VI material) const { return Lookup(constants, material); }
  LANELIGHT_INLINE void Store(const StoreSlots& slots, VI, VF constant) const {
    Scatter(constant, alpha, slots);
  }
  LANELIGHT_INLINE void StoreTextured(const StoreSlots& slots, VI material,
                                      V3 value) const {
    const VF roughness = hn::Max(value.x, Splat(0.0f));
    const VI remap = Lookup(materials.alpha_remap, material);
    const MF remapped = hn::RebindMask(DF(), hn::Ne(remap, hn::Zero(DI())));
    const VF of_texture = hn::IfThenElse(remapped, hn::Sqrt(roughness), roughness);
    Scatter(hn::Max(of_texture, Splat(1e-4f)), alpha, slots);
  }
};

// A number of a coat, between limits.
struct CoatParameter {
  const AlignedVector<int32_t>& textures;
  const AlignedVector<float>& constants;
  float* column;
  float minimum, maximum;

  LANELIGHT_INLINE VF Constant(VI material) const { return Lookup(constants, material); }
  LANELIGHT_INLINE void Store(const StoreSlots& slots, VI, VF value) const {
    Scatter(hn::Min(hn::Max(value, Splat(minimum)), Splat(maximum)), column, slots);
  }
  LANELIGHT_INLINE void StoreTextured(const StoreSlots& slots, VI material,
                                      V3 value) const {
    Store(slots, material, value.x);
  }
};

// Everything that the plan has columns for.
template <class Point>
void Textures(Wave& wave) {
  const PathColumns& path = wave.path;
  const MaterialTable& m = *wave.materials;
  const auto eval = [&](const auto& parameter)
                        HWY_ATTR { EvalParameter<Point>(wave, parameter); };
  LL_DCHECK(HoldsSlots(wave, wave.queue(QueueId::kSurface)));
  PadTail(wave.queue(QueueId::kSurface));
  eval(ColorParameter{m, false, m.color0_texture, &m.color0_r, &m.color0_g, &m.color0_b,
                      path.color0_r, path.color0_g, path.color0_b});
  if (path.color1_r != nullptr) {
    eval(ColorParameter{m, false, m.color1_texture, &m.color1_r, &m.color1_g, &m.color1_b,
                        path.color1_r, path.color1_g, path.color1_b});
  }
  if (path.alpha_x != nullptr) {
    eval(AlphaParameter{m, m.alpha_x_texture, m.alpha_x, path.alpha_x});
    eval(AlphaParameter{m, m.alpha_y_texture, m.alpha_y, path.alpha_y});
  }
  if (path.coat_thickness != nullptr) {
    eval(AlphaParameter{m, m.alpha2_x_texture, m.alpha2_x, path.alpha2_0});
    eval(AlphaParameter{m, m.alpha2_y_texture, m.alpha2_y, path.alpha2_1});
    eval(CoatParameter{m.thickness_texture, m.coat_thickness, path.coat_thickness, 0,
                       std::numeric_limits<float>::infinity()});
  }
  if (path.coat_g != nullptr) {
    eval(ColorParameter{m, true, m.coat_albedo_texture, &m.coat_albedo_r,
                        &m.coat_albedo_g, &m.coat_albedo_b, path.coat_albedo_r,
                        path.coat_albedo_g, path.coat_albedo_b});
    eval(CoatParameter{m.coat_g_texture, m.coat_g, path.coat_g, -kMaxCoatAsymmetry,
                       kMaxCoatAsymmetry});
  }
  CountBatches(wave, wave.queue(QueueId::kSurface));
}

Stage TextureStage() {
  return {.name = "texture",
          .meaning = "evaluates textured material parameters",
          .input = QueueId::kSurface,
          .role = StageRole::kTexture,
          .needs = {Feature::kTextures},
          .reads = FieldSet{Field::material} | fields::kUv | fields::kPoint |
                   fields::kNormal | fields::kFootprint | fields::kTangents,
          .writes = fields::kParameters,
          .resolve = [](const FeatureSet& features) -> StageFn {
            LL_CHECK(features.Has(Feature::kUv));
            if (features.Has(Feature::kTextureFootprints)) return Textures<FilteredPoint>;
            return features.Has(Feature::kTexturePlaces) ? Textures<PlacedPoint>
                                                         : Textures<UvPoint>;
          }};
}

LANELIGHT_END_KERNELS
