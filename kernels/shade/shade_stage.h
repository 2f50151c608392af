// The declaration that all shading stages share.
#pragma once

#include "kernels/guide/guide_fields.h"
#include "src/path/stage.h"

namespace lanelight {

/// A shading stage of `kind`, present if the scene has it.
inline Stage MakeShadeStage(const char* name, const char* meaning, ShadeKind kind,
                            StageFn (*resolve)(const FeatureSet&)) {
  using namespace fields;
  const FieldSet points = {Field::u_lobe, Field::u_bsdf_0, Field::u_bsdf_1,
                           Field::u_guide};
  // Who the path is: its random walks inside a coat have numbers of their own.
  const FieldSet identity = {Field::pixel, Field::sample, Field::branch, Field::depth,
                             Field::material};
  const FieldSet direction = {Field::d_x, Field::d_y, Field::d_z};
  const FieldSet history = {Field::bsdf_pdf, Field::eta_scale, Field::depth, Field::t};
  return {.name = name,
          .meaning = meaning,
          .input = ShadeQueue(kind),
          .needs = {ShadeFeature(kind), Feature::kScatters},
          .reads = identity | direction | kThroughput | kPoint | kNormal | kTangent |
                   kParameters | points | kGuideProposal | kLightSample |
                   FieldSet{Field::eta_scale},
          .writes = kRay | kThroughput | kShadow | kStartNormal | history,
          .resolve = resolve};
}

}  // namespace lanelight
