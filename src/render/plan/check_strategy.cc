#include "src/base/core/error.h"
#include "src/render/plan/plan_features.h"
#include "src/scene/compiled/lights.h"
#include "src/scene/compiled/view.h"
#include "src/scene/prepare/prepared_scene.h"
#include "src/vocabulary/path/features.h"

namespace lanelight {
namespace {

using Notes = std::vector<std::string>;

[[noreturn]] void ThrowUnsupported(const std::string& message) {
  throw InputError("strategy: " + message);
}

// Refuses what path reuse does not work with: samples then are not those of one path.
void CheckReuse(const Strategy& s, const FeatureSet& plan) {
  if (s.reuse == Reuse::kNone) return;
  if (plan.HasAll({Feature::kReuse, Feature::kSpectralFilm})) {
    ThrowUnsupported(
        "reuse=block does not work with Film \"spectral\": its blocks share colours, not "
        "wavelengths; use reuse=none, or Film \"rgb\"");
  }
  if (plan.HasAll({Feature::kReuse, Feature::kDispersion})) {
    ThrowUnsupported(
        "reuse=block does not support dispersive glass with --transport spectral; use "
        "--transport rgb");
  }
  if (s.Splits()) {
    ThrowUnsupported(std::string("reuse=block does not support split paths (roulette=") +
                     Name(s.roulette) + "); use roulette=throughput");
  }
  if (s.control != Control::kNone) {
    ThrowUnsupported(
        std::string("control=") + Name(s.control) +
        " needs samples of single paths, which reuse=block combines: use one of the two");
  }
}

// Refuses what needs samples of single pixels.
void CheckSharing(const Strategy& s, const FeatureSet& plan, const FilmResponse& film) {
  if (!plan.Has(Feature::kSharedPixelSamples)) return;
  const char* const why = plan.Has(Feature::kRegressionControl)
                              ? "control=regression, which fits samples of single pixels"
                          : plan.Has(Feature::kSpectralFilm)
                              ? "Film \"spectral\", whose buckets have samples of single "
                                "pixels"
                          : film.limits()
                              ? "\"maxcomponentvalue\" of the film, which limits single "
                                "samples"
                              : nullptr;
  if (why == nullptr) return;
  ThrowUnsupported(std::string("pixel-samples=") + Name(s.pixel_samples) +
                   " does not support " + why + ": use pixel-samples=own");
}

// Features that light-paths=splats does not support, and what to use instead.
struct Unsupported {
  FeatureSet any;
  const char* what;
};

const Unsupported kWithoutLightPaths[] = {
    {{Feature::kSubsurface}, "materials with an inside"},
    {{Feature::kMotion, Feature::kMovingInstances, Feature::kMovingCamera},
     "shapes or cameras that move"},
    {{Feature::kOrthographic, Feature::kSphericalCamera, Feature::kRealisticCamera},
     "cameras other than \"perspective\""},
    {{Feature::kSpectralFilm}, "Film \"spectral\""},
    {{Feature::kHair, Feature::kCurves}, "hair and curves"},
    {{Feature::kRegularizes}, "\"bool regularize\""},
    {KindsWith(kWalks), "coats over rough conductors, and coats with a medium"},
};

// Refuses what light subpaths do not work with.
void CheckLightPaths(const Strategy& s, const FeatureSet& plan,
                     const FilmResponse& film) {
  if (!plan.Has(Feature::kLightPaths)) return;
  const std::string key = std::string("light-paths=") + Name(s.light_paths);
  for (const Unsupported& no : kWithoutLightPaths) {
    if (!plan.HasAny(no.any)) continue;
    ThrowUnsupported(key + " does not support " + no.what + ": use light-paths=none");
  }
  if (film.limits()) {
    ThrowUnsupported(
        key +
        " does not support \"maxcomponentvalue\" of the film, which limits whole "
        "samples: use light-paths=none, or remove the limit");
  }
  if (s.reuse != Reuse::kNone) {
    ThrowUnsupported(key + " and reuse=" + Name(s.reuse) +
                     " cannot be combined: use one of the two");
  }
  if (s.decide != Decide::kNone) {
    ThrowUnsupported(key + " and decide=pilot cannot be combined: use decide=none");
  }
  if (s.Splits()) {
    ThrowUnsupported(key + " needs paths that do not split, unlike those of roulette=" +
                     Name(s.roulette) + ": use roulette=throughput");
  }
}

// Refuses a trial of light-selection=learned in a scene that has been prepared for a
// light tree, and has no probabilities by power.
void CheckLearnedLights(const PreparedScene& scene, const Strategy& s,
                        const FeatureSet& plan) {
  if (s.light_selection == LightSelection::kLearned && plan.Has(Feature::kManyLights) &&
      scene.chances->alias.empty()) {
    ThrowUnsupported("light-selection=learned cannot replace light-selection=tree");
  }
}

// Inputs of the checks of single keys.
struct Checked {
  const Strategy& strategy;
  const FeatureSet &scene, &plan;  // features
  const PlanOptions& options;
  Notes& notes;

  void Note(const std::string& choice, const std::string& why) const {
    notes.push_back(choice + " has no effect" + why);
  }
};

void NoteLights(const Checked& c) {
  const Strategy& s = c.strategy;
  if (s.light_selection != LightSelection::kPower && !c.scene.Has(Feature::kManyLights)) {
    c.Note(std::string("light-selection=") + Name(s.light_selection),
           ": the scene has fewer than two lights");
  } else if (s.light_selection == LightSelection::kLearned &&
             c.scene.Has(Feature::kMedia)) {
    c.Note("light-selection=learned", ": there are media; lights are selected by power");
  }
  if (s.light_points != LightPoints::kArea && !SamplesFlatLights(c.plan)) {
    c.Note(std::string("light-points=") + Name(s.light_points),
           ": no triangle or rectangle that emits is sampled");
  }
  if (s.light_candidates != LightCandidates::kSingle && !SamplesOfLightDiffer(c.plan)) {
    c.Note("light-candidates=resampled", c.plan.Has(Feature::kLights)
                                             ? ": all samples of the only light are alike"
                                             : ": no light is sampled");
  }
  if (s.directions == Directions::kLight && !c.scene.Has(Feature::kLights)) {
    c.notes.push_back(
        "directions=light: no light can be sampled; the image has directly visible and "
        "mirrored lights only");
  }
}

void NoteEnvironment(const Checked& c) {
  const Strategy& s = c.strategy;
  if (s.environment != EnvironmentPoints::kCompensated) return;
  if (!c.scene.Has(Feature::kInfiniteImage)) {
    c.Note("environment=compensated", ": there is no environment image");
  } else if (s.directions != Directions::kMis) {
    c.Note(
        "environment=compensated",
        std::string(" with directions=") + Name(s.directions) +
            ": it needs directions=mis, so that scattered rays find the omitted light");
  }
}

void NoteMedia(const Checked& c) {
  const Strategy& s = c.strategy;
  if (s.distances != Distances::kExponential &&
      !c.plan.Has(Feature::kEquiangularDistances)) {
    c.Note("distances=equiangular",
           ": there is no scattering homogeneous medium, or no light with a position");
  }
}

void NotePaths(const Checked& c) {
  const Strategy& s = c.strategy;
  if (s.roulette != Roulette::kThroughput && s.roulette != Roulette::kNone &&
      c.options.max_depth <= 1) {
    c.Note(std::string("roulette=") + Name(s.roulette),
           ": paths end after one scattering event");
  }
  if (s.reuse != Reuse::kNone && !c.plan.Has(Feature::kReuse)) {
    c.Note(std::string("reuse=") + Name(s.reuse),
           c.scene.Has(Feature::kMedia) ? ": there are media"
           : c.scene.Has(Feature::kMovingInstances)
               ? ": shapes move, and paths of a block have different times"
               : ": no path scatters a second time from a diffuse surface");
  }
  if (s.pixel_samples == PixelSamples::kShared &&
      !c.plan.Has(Feature::kSharedPixelSamples)) {
    c.Note("pixel-samples=shared", ": the pixel filter reaches no other pixel");
  }
  if (s.light_paths != LightPaths::kNone && !c.plan.Has(Feature::kLightPaths)) {
    c.Note(std::string("light-paths=") + Name(s.light_paths),
           s.directions != Directions::kMis
               ? std::string(" with directions=") + Name(s.directions) + ": use mis"
               : ": no light starts subpaths, or no surface is diffuse or glossy");
  }
  if (s.decide == Decide::kPilot && c.plan.Has(Feature::kReuse)) {
    c.Note("decide=pilot", ": the trial run tries no strategies with reuse=block");
  }
}

}  // namespace

Notes CheckStrategy(const PreparedScene& scene, const PlanOptions& options) {
  const Strategy s = PlannedStrategy(scene, options);
  const FeatureSet plan = PlanFeatures(scene, options);
  CheckReuse(s, plan);
  CheckSharing(s, plan, scene.view->film.response);
  CheckLearnedLights(scene, s, plan);
  CheckLightPaths(s, plan, scene.view->film.response);
  Notes notes;
  const Checked checked = {s, scene.features(), plan, options, notes};
  NoteLights(checked);
  NoteEnvironment(checked);
  NoteMedia(checked);
  NotePaths(checked);
  if (s.control == Control::kRegression && !plan.Has(Feature::kRegressionControl)) {
    checked.Note("control=regression", ": nothing scatters");
  } else if (s.control == Control::kRegression &&
             s.sampler != SampleSequence::kIndependent) {
    notes.push_back(
        std::string("control=regression gains little with points=") + Name(s.sampler) +
        ", which integrate polynomials well already: use it with points=independent");
  }
  return notes;
}

}  // namespace lanelight
