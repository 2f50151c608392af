#include "src/render/plan/plan_features.h"

#include "src/scene/compiled/lights.h"
#include "src/scene/compiled/scene.h"
#include "src/scene/prepare/prepared_scene.h"
#include "src/vocabulary/path/block.h"
#include "src/vocabulary/path/features.h"
#include "src/vocabulary/path/light_shapes.h"
#include "src/vocabulary/path/light_splats.h"

namespace lanelight {
namespace {

// Returns whether rays can hit a surface; otherwise they see only the environment.
bool HasSurfaces(const FeatureSet& f) {
  return f.HasAny({Feature::kTriangles, Feature::kSpheres, Feature::kLargeSpheres,
                   Feature::kDisks, Feature::kPlanes, Feature::kCurves});
}

// Only emission seen directly is left: nothing is shaded and no light is sampled.
void RemoveScattering(FeatureSet& f) {
  f.Remove({Feature::kLights, Feature::kManyLights, Feature::kMis, Feature::kRefraction});
  f.Remove({Feature::kTextures, Feature::kUv, Feature::kTangents, Feature::kVertexNormals,
            Feature::kTexturedRoughness, Feature::kTexturedColor1, Feature::kTexturedCoat,
            Feature::kTexturePlaces, Feature::kMix, Feature::kBumps, Feature::kNormalMaps,
            Feature::kTextureFootprints, Feature::kPlainSpectra, Feature::kSpectralColor1,
            Feature::kDispersion});
}

bool HasAnyOf(const FeatureSet& f, std::uint32_t shade_kinds) {
  FeatureSet kinds;
  for (int k = 0; k < kNumShadeKinds; ++k) {
    if ((shade_kinds >> k & 1) != 0) kinds.Add(ShadeFeature(static_cast<ShadeKind>(k)));
  }
  return f.HasAny(kinds);
}

// Adds path reuse where paths can be connected.
void AddReuse(const Strategy& strategy, const PlanOptions& options, FeatureSet& f) {
  // Vertices of other paths would be of other times.
  if (f.HasAny({Feature::kMedia, Feature::kMovingInstances})) return;
  if (options.max_depth < 2) return;
  if (!HasAnyOf(f, kEvenSidedKinds | kGlossyKinds)) return;
  f.Add(TurnsOn(strategy.reuse));
  if (f.Has(Feature::kReuse) && HasAnyOf(f, kGlossyKinds)) f.Add(Feature::kReuseGlossy);
}

// Adds light subpaths if some light emits them.
void AddLightPaths(const PreparedScene& scene, const Strategy& strategy, FeatureSet& f) {
  if (strategy.directions != Directions::kMis || !f.Has(Feature::kLights)) return;
  if (scene.chances->emission.empty() || !HasAnyOf(f, kSplattingKinds)) return;
  f.Add(TurnsOn(strategy.light_paths));
  if (f.Has(Feature::kLightPaths) && scene.chances->emission.HasAny(kFarLight)) {
    f.Add(Feature::kGuidedEmission);
  }
}

// Adds shared samples where pixel filters overlap.
void AddSharing(const PreparedScene& scene, const Strategy& strategy, FeatureSet& f) {
  const CompiledFilter& filter = scene.compiled->filter;
  if (filter.x_radius <= 0.5f && filter.y_radius <= 0.5f) return;
  f.Add(TurnsOn(strategy.pixel_samples));
}

bool HasDeltaLights(const FeatureSet& f) { return f.HasAny(LightsWith(kDeltaLight)); }

void AddLightSampling(const Strategy& strategy, FeatureSet& f) {
  f.Add(TurnsOn(strategy.directions));
  if (!strategy.SamplesHittableLights()) {
    // Scattered rays count in full, so they carry no density; what is left to sample are
    // the lights that no ray can hit.
    f.Remove(Feature::kMis);
    if (f.Has(Feature::kUnseenLights)) {
      f.Add(Feature::kSampledHittableLights);  // prepared_scene.cc: no other is selected
    } else if (!HasDeltaLights(f)) {
      f.Remove({Feature::kLights, Feature::kManyLights});
    }
  }
  if (f.Has(Feature::kManyLights)) {
    // Events in media have no normal, by which cells are told apart.
    const bool learns = strategy.light_selection == LightSelection::kLearned;
    f.Add(TurnsOn(learns && f.Has(Feature::kMedia) ? LightSelection::kPower
                                                   : strategy.light_selection));
  }
  if (!f.Has(Feature::kLights)) return;
  if (SamplesFlatLights(f)) f.Add(TurnsOn(strategy.light_points));
  // directions=light counts no hit of what it samples.
  if (f.Has(Feature::kProjectedLights) && f.Has(Feature::kMis) &&
      strategy.directions == Directions::kMis) {
    f.Add(Feature::kProjectedHits);
  }
  if (SamplesOfLightDiffer(f)) f.Add(TurnsOn(strategy.light_candidates));
}

}  // namespace

bool SamplesFlatLights(const FeatureSet& f) {
  return f.Has(Feature::kSampledHittableLights) &&
         f.HasAny({Feature::kTriangleLights, Feature::kRectangleLights});
}

bool SamplesOfLightDiffer(const FeatureSet& f) {
  return f.Has(Feature::kManyLights) || (f.Has(Feature::kLights) && !HasDeltaLights(f));
}

FeatureSet PlanFeatures(const PreparedScene& scene, const PlanOptions& options) {
  const Strategy strategy = PlannedStrategy(scene, options);
  FeatureSet f = scene.features();
  // Media dim what the camera sees, and need a surface's columns to find where they end.
  const bool media = f.Has(Feature::kMedia);
  if (media || (options.max_depth > 0 && HasSurfaces(f))) {
    f.Add(Feature::kScatters);
    AddLightSampling(strategy, f);
    if (media) f.Add(Feature::kOtherEvents);
    if (media && f.Has(Feature::kLights) && HasAnchors(strategy, *scene.compiled)) {
      f.Add(TurnsOn(strategy.distances));
    }
    if (f.Has(Feature::kLights) && !f.Has(Feature::kInterfaces)) {
      f.Add(Feature::kOpaqueShadows);
    }
    if (options.max_depth > 1) f.Add(TurnsOn(strategy.roulette));
    AddReuse(strategy, options, f);
    AddLightPaths(scene, strategy, f);
    // Trial runs do not compare strategies beside path reuse.
    if (!f.Has(Feature::kReuse)) f.Add(TurnsOn(strategy.decide));
  } else {
    RemoveScattering(f);
  }
  f.Add(AuxiliaryFeatures(options.auxiliary));
  if (f.Has(Feature::kGbuffer) && HasSurfaces(f)) f.Add(Feature::kUv);
  f.Add(TurnsOn(strategy.sampler));
  f.Add(TurnsOn(strategy.pairs));
  AddSharing(scene, strategy, f);
  if (strategy.control != Control::kNone && f.Has(Feature::kScatters)) {
    f.Add(TurnsOn(strategy.control));
  }
  if (options.spectral_film && !options.training) f.Add(Feature::kSpectralFilm);
  if (options.training) f.Add(*options.training);
  return f;
}

FeatureSet LightPathFeatures(FeatureSet f) {
  const bool plays_roulette = f.Has(Feature::kRoulette);
  // Shadow rays go to the camera, and lights are neither sampled nor hit.
  f.Remove({Feature::kManyLights, Feature::kMis, Feature::kProjectedHits,
            Feature::kLightCandidates, Feature::kLightTable, Feature::kLightTree,
            Feature::kLearnedLights, Feature::kSampledHittableLights,
            Feature::kAreaLights, Feature::kInfiniteLights, Feature::kEmissionImages,
            Feature::kPortals, Feature::kMediumEmission, Feature::kEquiangularDistances});
  for (int i = 0; i < int(LightShape::kCount); ++i) {
    f.Remove(LightFeature(static_cast<LightShape>(i)));
  }
  f.Remove({Feature::kPerspective, Feature::kLens, Feature::kFiltered,
            Feature::kSignedFilter, Feature::kAov, Feature::kGbuffer,
            Feature::kRegressionControl, Feature::kSharedPixelSamples});
  for (std::size_t i = 0; i < std::size(kSampleSequenceNames); ++i) {
    f.Remove(TurnsOn(static_cast<SampleSequence>(i)));
  }
  for (std::size_t i = 0; i < std::size(kPairsNames); ++i) {
    f.Remove(TurnsOn(static_cast<Pairs>(i)));
  }
  for (std::size_t i = 0; i < std::size(kRouletteNames); ++i) {
    f.Remove(TurnsOn(static_cast<Roulette>(i)));
  }
  if (plays_roulette) f.Add(TurnsOn(Roulette::kThroughput));
  f.Add({Feature::kIndependentSampleSequence, Feature::kLightSubpath});
  return f;
}

Strategy PlannedStrategy(const PreparedScene& scene, const PlanOptions& options) {
  Strategy strategy = options.strategy.value_or(scene.strategy);
  if (!options.training) return strategy;
  if (!options.has_own_sequences) {
    strategy.sampler = SampleSequence::kIndependent;
    strategy.reuse = Reuse::kNone;
    strategy.light_paths = LightPaths::kNone;
  }
  // Passes have single pixels, not whole images.
  strategy.pixel_samples = PixelSamples::kOwn;
  strategy.pairs = Pairs::kNone;
  strategy.control = Control::kNone;
  return strategy;
}

FeatureSet VisibleLightFeatures(const PreparedScene& scene, const PlanOptions& options) {
  const Strategy strategy = PlannedStrategy(scene, options);
  FeatureSet f = scene.features();
  RemoveScattering(f);
  f.Add(TurnsOn(strategy.sampler));
  f.Add(TurnsOn(strategy.pairs));
  AddSharing(scene, strategy, f);
  return f;
}

bool RendersLightsSeparately(const PreparedScene& scene) {
  const FeatureSet& f = scene.features();
  return scene.strategy.visible_lights == VisibleLights::kApart &&
         !f.Has(Feature::kMedia) &&              // which dim what is seen
         !f.Has(Feature::kMovingCamera) &&       // which blurs all edges
         !scene.view->film.response.limits() &&  // which are of single samples
         f.HasAny({Feature::kAreaLights, Feature::kInfiniteLights});
}

std::string UntrainedChanges(const PreparedScene& scene, const PlanOptions& options) {
  const Strategy& strategy = options.strategy ? *options.strategy : scene.strategy;
  const bool learns = strategy.light_selection == LightSelection::kLearned;
  return std::string("roulette=throughput,decide=none") +
         (learns ? ",light-selection=power" : "");
}

PlanOptions WithChanges(const PreparedScene& scene, PlanOptions options,
                        std::string_view changes) {
  if (!options.strategy) options.strategy = scene.strategy;
  ApplyStrategy(changes, {}, *options.strategy);
  return options;
}

}  // namespace lanelight
