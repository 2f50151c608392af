// Training passes of a guide: what the first scattered rays of a path have brought. Of
// ray k, which leaves the vertex of depth k:
//   start       the hit point, the normal on the side that the path sees, the direction
//   pdf_sa      with which the strategy has chosen it; 0: a specular vertex, no record
//   estimate    (Y(l at the end) - Y(l before)) / Y(beta), of the radiance that arrives
//               along the ray; Y: mean of the channels, beta: with the ray's own weight
// What the light sample of the vertex has found is in `l before`: the estimate is of what
// light samples leave to scattered rays (by MIS), and of all that is indirect, and so is
// what the guide proposes. Roulette is played after the ray has been recorded: a path
// that ends is an estimate of zero, one that goes on is of what counts more, so that the
// directions on record have the density pdf_sa, whatever roulette prefers.
//
// The stages keep the rays in columns and write them behind the colour of the finished
// path; src/train/train_guide.cc reads them in the order of the samples.
#include "kernels/simd/each_target-inl.h"

#include "kernels/queue/batch-inl.h"
#include "kernels/simd/vec3-inl.h"

LANELIGHT_BEGIN_KERNELS

struct RayColumns {
  float *x[kRecordedVertices], *y[kRecordedVertices], *z[kRecordedVertices];
  uint32_t *normal[kRecordedVertices], *toward[kRecordedVertices];
  float *pdf[kRecordedVertices], *sent[kRecordedVertices], *before[kRecordedVertices];

  explicit RayColumns(const PathColumns& p)
      : x{p.from_x_0, p.from_x_1, p.from_x_2, p.from_x_3},
        y{p.from_y_0, p.from_y_1, p.from_y_2, p.from_y_3},
        z{p.from_z_0, p.from_z_1, p.from_z_2, p.from_z_3},
        normal{p.from_n_0, p.from_n_1, p.from_n_2, p.from_n_3},
        toward{p.toward_0, p.toward_1, p.toward_2, p.toward_3},
        pdf{p.sent_pdf_0, p.sent_pdf_1, p.sent_pdf_2, p.sent_pdf_3},
        sent{p.sent_0, p.sent_1, p.sent_2, p.sent_3},
        before{p.before_0, p.before_1, p.before_2, p.before_3} {}
};

// Writes what belongs to this ray, and leaves the others as they are.
HWY_INLINE void Keep(MF here, VF value, float* column, const Slots& slots) {
  Scatter(hn::IfThenElse(here, value, Gather(column, slots)), column, slots);
}
HWY_INLINE void Keep(MF here, VI value, uint32_t* column, const Slots& slots) {
  const auto mine = hn::RebindMask(DI(), here);
  Scatter(hn::IfThenElse(mine, value, Gather(column, slots)), column, slots);
}

/// A unit vector as a point of the octahedron, 16 bits a coordinate (Cigolle et al. 2014;
/// UnpackDirection of src/prepare/guide_records.h is the inverse).
HWY_INLINE VI PackDirection(V3 d) {
  const VF one = Splat(1.0f), zero = hn::Zero(DF());
  const VF size = hn::Add(hn::Abs(d.x), hn::Add(hn::Abs(d.y), hn::Abs(d.z)));
  const VF u = hn::Div(d.x, size), v = hn::Div(d.y, size);
  const MF below = hn::Lt(d.z, zero);
  const VF folded_u = hn::CopySign(hn::Sub(one, hn::Abs(v)), u);
  const VF folded_v = hn::CopySign(hn::Sub(one, hn::Abs(u)), v);
  const auto coordinate = [&](VF c) HWY_ATTR {
    const VF scaled = hn::MulAdd(c, Splat(32767.5f), Splat(32767.5f));
    return hn::NearestInt(hn::Min(hn::Max(scaled, zero), Splat(65535.0f)));
  };
  const VI low = coordinate(hn::IfThenElse(below, folded_u, u));
  const VI high = coordinate(hn::IfThenElse(below, folded_v, v));
  return hn::Or(low, hn::ShiftLeft<16>(high));
}

HWY_INLINE VF MeanChannel(V3 c) {
  return hn::Mul(hn::Add(c.x, hn::Add(c.y, c.z)), Splat(1.0f / 3));
}

HWY_INLINE MF IsRay(const PathColumns& p, const Slots& slots, int32_t depth) {
  return hn::RebindMask(DF(), hn::Eq(Gather(p.depth, slots), hn::Set(DI(), depth)));
}

void RecordStart(Wave& wave) {
  const PathColumns& p = wave.path;
  const RayColumns rays(p);
  ForEachBatch(wave, wave.queue(QueueId::kVertex), [&](const Slots& slots, MF) HWY_ATTR {
    const V3 at = Gather3(p.p_x, p.p_y, p.p_z, slots);
    const V3 d = Gather3(p.d_x, p.d_y, p.d_z, slots);
    const V3 ng = Gather3(p.ng_x, p.ng_y, p.ng_z, slots);
    const VI n = PackDirection(IfThenElse(hn::Gt(Dot(ng, d), hn::Zero(DF())), -ng, ng));
    for (int k = 0; k < kRecordedVertices; ++k) {
      const MF here = IsRay(p, slots, k);
      Keep(here, at.x, rays.x[k], slots);
      Keep(here, at.y, rays.y[k], slots);
      Keep(here, at.z, rays.z[k], slots);
      Keep(here, n, rays.normal[k], slots);
    }
  });
}

void RecordRay(Wave& wave) {
  const PathColumns& p = wave.path;
  const RayColumns rays(p);
  ForEachBatch(
      wave, wave.queue(QueueId::kScattered), [&](const Slots& slots, MF) HWY_ATTR {
        const VI toward = PackDirection(Gather3(p.d_x, p.d_y, p.d_z, slots));
        const VF pdf = Gather(p.bsdf_pdf, slots);
        const VF sent = MeanChannel(Gather3(p.beta_r, p.beta_g, p.beta_b, slots));
        const VF before = MeanChannel(Gather3(p.l_r, p.l_g, p.l_b, slots));
        for (int k = 0; k < kRecordedVertices; ++k) {
          // The vertex that the ray has left has been counted.
          const MF here = IsRay(p, slots, k + 1);
          Keep(here, toward, rays.toward[k], slots);
          Keep(here, pdf, rays.pdf[k], slots);
          Keep(here, sent, rays.sent[k], slots);
          Keep(here, before, rays.before[k], slots);
        }
      });
}

// In the order of PlaneGroup::kGuideRecord.
void RecordRays(Wave& wave) {
  const PathColumns& p = wave.path;
  const RayColumns rays(p);
  ForEachBatch(wave, wave.queue(QueueId::kDone), [&](const Slots& slots, MF) HWY_ATTR {
    const VI output = Gather(p.output, slots);
    float* plane = wave.buffer.samples +
                   std::size_t(wave.run->planes.First(PlaneGroup::kGuideRecord)) *
                       wave.buffer.stride;
    const auto store = [&](VF value) HWY_ATTR {
      Scatter(value, plane, output);
      plane += wave.buffer.stride;
    };
    for (int k = 0; k < kRecordedVertices; ++k) {
      for (const float* column : {rays.x[k], rays.y[k], rays.z[k]}) {
        store(Gather(column, slots));
      }
      store(hn::BitCast(DF(), Gather(rays.normal[k], slots)));
      store(hn::BitCast(DF(), Gather(rays.toward[k], slots)));
      for (const float* column : {rays.pdf[k], rays.sent[k], rays.before[k]}) {
        store(Gather(column, slots));
      }
    }
    store(MeanChannel(Gather3(p.l_r, p.l_g, p.l_b, slots)));
  });
}

namespace {

constexpr FieldSet kStarts = {
    Field::from_x_0, Field::from_x_1, Field::from_x_2, Field::from_x_3,
    Field::from_y_0, Field::from_y_1, Field::from_y_2, Field::from_y_3,
    Field::from_z_0, Field::from_z_1, Field::from_z_2, Field::from_z_3,
    Field::from_n_0, Field::from_n_1, Field::from_n_2, Field::from_n_3};
constexpr FieldSet kRays = {
    Field::toward_0,   Field::toward_1,   Field::toward_2,   Field::toward_3,
    Field::sent_pdf_0, Field::sent_pdf_1, Field::sent_pdf_2, Field::sent_pdf_3,
    Field::sent_0,     Field::sent_1,     Field::sent_2,     Field::sent_3,
    Field::before_0,   Field::before_1,   Field::before_2,   Field::before_3};

}  // namespace

Stage RecordStartStage() {
  return {.name = "guide_record_start",
          .meaning = "records where a ray of a training pass will start",
          .input = QueueId::kVertex,
          .needs = {Feature::kRecordsGuide, Feature::kScatters},
          .reads = fields::kRay | fields::kPoint | fields::kNormal | kStarts |
                   FieldSet{Field::depth},
          .writes = kStarts,
          .resolve = Always<RecordStart>};
}
Stage RecordRayStage() {
  return {.name = "guide_record_ray",
          .meaning = "records a scattered ray of a training pass",
          .input = QueueId::kScattered,
          .needs = {Feature::kRecordsGuide, Feature::kScatters},
          .reads = fields::kRay | fields::kThroughput | fields::kRadiance | kRays |
                   FieldSet{Field::depth, Field::bsdf_pdf},
          .writes = kRays,
          .resolve = Always<RecordRay>};
}
Stage RecordRaysStage() {
  return {.name = "guide_record_path",
          .meaning = "writes the rays of a finished path of a training pass",
          .input = QueueId::kDone,
          .needs = {Feature::kRecordsGuide},
          .reads = kStarts | kRays | fields::kRadiance | FieldSet{Field::output},
          .resolve = Always<RecordRays>};
}

LANELIGHT_END_KERNELS
