// A training pass: records the light that paths gather after their first vertices. For
// vertex i:
//   estimate    (Y(l at the end) - Y(l before i)) / Y(beta at i): the brightness gathered
//               after i per unit of throughput; its expectation is the adjoint Psi there.
//               Y weighs the channels by PathValues::channel
//
// The stages keep cell, Y(beta) and Y(l) in columns and write them behind the colour of
// the finished path; src/render/train/train_path_values.cc adds them up in the order of
// the samples, so that the sums depend on no order of execution.
#include "kernels/simd/each_target-inl.h"

#include "kernels/roulette/cell-inl.h"

LANELIGHT_BEGIN_KERNELS

struct VertexColumns {
  uint32_t *cell[kRecordedVertices], *light[kRecordedVertices];
  float *at[kRecordedVertices], *got[kRecordedVertices], *direct[kRecordedVertices];

  explicit VertexColumns(const PathColumns& p)
      : cell{p.cell_0, p.cell_1, p.cell_2, p.cell_3},
        light{p.lit_by_0, p.lit_by_1, p.lit_by_2, p.lit_by_3},
        at{p.at_0, p.at_1, p.at_2, p.at_3},
        got{p.got_0, p.got_1, p.got_2, p.got_3},
        direct{p.direct_0, p.direct_1, p.direct_2, p.direct_3} {}
};

void RecordVertex(Wave& wave) {
  const PathColumns& p = wave.path;
  const VertexColumns v(p);
  const PathValues& values = wave.run->tables->path_values;
  ForEachBatch(wave, wave.queue(QueueId::kVertex), [&](const Slots& slots, MF) HWY_ATTR {
    const VI depth = Gather(p.depth, slots);
    const VI cell = CellOf(values.grid, p, slots);
    const VF at = Brightness(values, Gather3(p.beta_r, p.beta_g, p.beta_b, slots));
    const VF got = Brightness(values, Gather3(p.l_r, p.l_g, p.l_b, slots));
    for (int k = 0; k < kRecordedVertices; ++k) {
      const auto here = hn::Eq(depth, hn::Set(DI(), k));
      const MF mine = hn::RebindMask(DF(), here);
      Scatter(hn::IfThenElse(here, cell, Gather(v.cell[k], slots)), v.cell[k], slots);
      Scatter(hn::IfThenElse(mine, at, Gather(v.at[k], slots)), v.at[k], slots);
      Scatter(hn::IfThenElse(mine, got, Gather(v.got[k], slots)), v.got[k], slots);
    }
  });
}

// Records what unoccluded light samples add.
void RecordLight(Wave& wave) {
  const PathColumns& p = wave.path;
  const VertexColumns v(p);
  const PathValues& values = wave.run->tables->path_values;
  ForEachBatch(wave, wave.queue(QueueId::kShadow), [&](const Slots& slots, MF) HWY_ATTR {
    const VI next = Gather(p.depth, slots);  // the path has been scattered
    const VI light = p.ls_light == nullptr ? hn::Zero(DI()) : Gather(p.ls_light, slots);
    const VF direct = Brightness(values, Gather3(p.sh_r, p.sh_g, p.sh_b, slots));
    for (int k = 0; k < kRecordedVertices; ++k) {
      const auto here = hn::Eq(next, hn::Set(DI(), k + 1));
      const MF mine = hn::RebindMask(DF(), here);
      Scatter(hn::IfThenElse(here, light, Gather(v.light[k], slots)), v.light[k], slots);
      Scatter(hn::IfThenElse(mine, direct, Gather(v.direct[k], slots)), v.direct[k],
              slots);
    }
  });
}

// In the order of PlaneGroup::kRecord.
void RecordPath(Wave& wave) {
  const PathColumns& p = wave.path;
  const VertexColumns v(p);
  const PathValues& values = wave.run->tables->path_values;
  ForEachBatch(wave, wave.queue(QueueId::kDone), [&](const Slots& slots, MF) HWY_ATTR {
    const VI output = Gather(p.output, slots);
    float* plane =
        wave.buffer.samples +
        std::size_t(wave.run->planes.First(PlaneGroup::kRecord)) * wave.buffer.stride;
    const auto store = [&](VF value) HWY_ATTR {
      Scatter(value, plane, output);
      plane += wave.buffer.stride;
    };
    for (int k = 0; k < kRecordedVertices; ++k) {
      store(hn::BitCast(DF(), Gather(v.cell[k], slots)));
      store(Gather(v.at[k], slots));
      store(Gather(v.got[k], slots));
      store(hn::BitCast(DF(), Gather(v.light[k], slots)));
      store(Gather(v.direct[k], slots));
    }
    store(Brightness(values, Gather3(p.l_r, p.l_g, p.l_b, slots)));
  });
}

Stage RecordVertexStage() {
  return {.name = "record_vertex",
          .meaning = "records a vertex of a training path",
          .input = QueueId::kVertex,
          .role = StageRole::kRecord,
          .needs = {Feature::kRecordsPaths, Feature::kScatters},
          .reads = fields::kThroughput | fields::kRadiance | fields::kRay |
                   fields::kPoint | fields::kNormal | fields::kVertices |
                   FieldSet{Field::depth},
          .writes = fields::kVertices,
          .resolve = Always<RecordVertex>};
}
Stage RecordLightStage() {
  return {.name = "record_light",
          .meaning = "records what light samples add",
          .input = QueueId::kShadow,
          .role = StageRole::kRecord,
          .needs = {Feature::kRecordsPaths, Feature::kLights, Feature::kScatters},
          .reads = fields::kShadow | fields::kVertices |
                   FieldSet{Field::depth, Field::ls_light},
          .writes = fields::kVertices,
          .resolve = Always<RecordLight>};
}
Stage RecordPathStage() {
  return {.name = "record_path",
          .meaning = "writes the training sample of a finished path",
          .input = QueueId::kDone,
          .role = StageRole::kRecord,
          .needs = {Feature::kRecordsPaths},
          .reads = fields::kVertices | fields::kRadiance | FieldSet{Field::output},
          .resolve = Always<RecordPath>};
}

LANELIGHT_END_KERNELS
