// Stages read and write the columns that they declare and no others: what a profile says
// of bytes per item rests on it. Each call of a stage is repeated with all columns
// scrambled that it does not declare to read; what it does must be the same.
#include <algorithm>
#include <catch2/catch.hpp>
#include <memory>
#include <optional>
#include <set>

#include "kernels/stages.h"
#include "src/base/image/image.h"
#include "src/render/plan/plan_features.h"
#include "src/render/wave/block_reuse.h"
#include "src/render/wave/tiles.h"
#include "src/render/wave/wavefront.h"
#include "src/scene/prepare/cell_grid.h"
#include "src/scene/prepare/learned_lights.h"
#include "src/scene/prepare/estimate_path_values.h"
#include "src/scene/prepare/prepared_scene.h"
#include "src/scene/prepare/tables.h"
#include "src/vocabulary/path/light_splats.h"
#include "tests/agreement/all_stages_scene.h"
#include "tests/base/image/temporary_folder.h"
#include "tests/reference/measured.h"
#include "tests/render/plan/wave_state.h"
#include "tests/render/run/render_fixture.h"

namespace lanelight {
namespace {

constexpr int kLongestSide = 12;  // of the tile
constexpr std::uint32_t kSamples = 4;
constexpr std::uint32_t kScrambled = 0x7fdeadffu;  // a NaN, an absurd index

struct DeclaredCase {
  const char* scene;
  const char* strategy;
  bool records = false;  // a training pass that records
};

// A scene that light subpaths support: lights of all kinds, spheres, a lens, a filter.
constexpr char kLampsScene[] = R"(
LookAt 0 2 -6  0 0.8 0  0 1 0
Camera "perspective" "float fov" 40 "float lensradius" 0.1 "float focaldistance" 6
Film "rgb" "integer xresolution" 24 "integer yresolution" 18
PixelFilter "gaussian"
Integrator "path" "integer maxdepth" 5
WorldBegin
LightSource "infinite" "rgb L" [ 0.2 0.3 0.5 ]
LightSource "infinite" "string filename" "sky.pfm"
LightSource "distant" "point3 from" [ 1 2 -1 ] "point3 to" [ 0 0 0 ]
LightSource "spot" "point3 from" [ -2 3 -2 ] "point3 to" [ 0 0 0 ]
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 6 5 4 ]
  Translate -1 3 0
  Shape "sphere" "float radius" 0.3
AttributeEnd
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 3 3 3 ]
  Shape "trianglemesh" "point3 P" [ 1 3 1  2 3 1  2 3 2 ] "integer indices" [ 0 1 2 ]
AttributeEnd
Material "coateddiffuse" "rgb reflectance" [ 0.1 0.3 0.6 ] "float roughness" 0.1
Shape "trianglemesh" "point3 P" [ -3 0 -2  3 0 -2  3 0 3  -3 0 3 ]
  "normal N" [ 0 1 0.2  0.1 1 0  0 1 0  0 1 -0.1 ] "integer indices" [ 0 1 2 0 2 3 ]
Material "dielectric" "float eta" 1.5
Translate 0 0.7 0
Shape "sphere" "float radius" 0.7
)";

// Lights in and beside smoke that varies, and glass with a medium in it.
constexpr char kSmokyLampsScene[] = R"(
LookAt 0 2 -6  0 0.8 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 24 "integer yresolution" 18
Integrator "path" "integer maxdepth" 5
MakeNamedMedium "smoke" "string type" "uniformgrid" "integer nx" 2 "integer ny" 1
  "integer nz" 2 "float density" [ 1 0.2 0.4 2 ] "rgb sigma_s" [ 1 2 3 ]
  "point3 p0" [ -1 0 -1 ] "point3 p1" [ 1 2 1 ] "float Lescale" 1 "rgb Le" [ 0.1 0 0 ]
MakeNamedMedium "milk" "string type" "homogeneous" "rgb sigma_s" [ 2 1 1 ]
WorldBegin
LightSource "infinite" "rgb L" [ 0.2 0.3 0.5 ]
LightSource "point" "point3 from" [ 0 1 0 ]
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 6 5 4 ] "bool twosided" true
  Shape "trianglemesh" "point3 P" [ 1 3 1  2 3 1  2 3 2 ] "integer indices" [ 0 1 2 ]
AttributeEnd
Shape "trianglemesh" "point3 P" [ -3 0 -2  3 0 -2  3 0 3  -3 0 3 ]
  "integer indices" [ 0 1 2 0 2 3 ]
AttributeBegin
  MediumInterface "smoke" ""
  Material "interface"
  Translate 0 1 0
  Shape "sphere" "float radius" 0.9
AttributeEnd
MediumInterface "milk" ""
Material "dielectric" "float eta" 1.5
Translate 1.6 0.7 0
Shape "sphere" "float radius" 0.6
)";

class Checker {
 public:
  Checker(const DeclaredCase& c, const std::string& folder)
      : scene_(PrepareScene(ParseSceneText(c.scene, "test.pbrt", folder), {})) {
    Strategy s = scene_.strategy;
    ApplyStrategy(c.strategy, {}, s);
    scene_ = WithStrategy(scene_, s);
    PlanOptions options;
    options.max_depth = 5;
    options.wavefront = 300;
    options.auxiliary = c.records ? Auxiliary::kNone : Auxiliary::kGbuffer;
    if (c.records && s.Splits()) {
      options.training = FeatureSet{Feature::kRecordsSinglePaths};
    } else if (c.records) {
      options.training = FeatureSet{Feature::kRecordsPaths, Feature::kOtherEvents};
      options = WithChanges(scene_, options, "roulette=throughput");
    }
    plan_ = MakePlan(scene_, options);
    run_ = MakeRunParameters(scene_, plan_);
    run_.tables = &tables_;
    MakeTables();
    wavefront_ = std::make_unique<Wavefront>(scene_, plan_, run_);
    if (plan_.features.Has(Feature::kReuse)) reuse_.emplace(plan_, scene_.strategy);
    const PathColumns& p = wavefront_->wave().path;
#define X(type, name, ...) columns_.push_back(reinterpret_cast<std::uint32_t*>(p.name));
    LANELIGHT_PATH_FIELDS(X)
#undef X
    TilePixels(MiddleTile(), scene_.view->film.width, &pixels_);
    places_.resize(2 * kSamples);
    samples_.resize(std::size_t{Rows()} * static_cast<std::size_t>(run_.planes.count()));
  }

  // Returns "stage writes column" and "stage depends on column or order" findings.
  std::set<std::string> Run() {
    Wave& wave = wavefront_->wave();
    TileWork work;
    work.pixels = pixels_.data();
    work.num_pixels = static_cast<std::uint32_t>(pixels_.size());
    work.samples = kSamples;
    work.tile_pixel = pixels_[0];
    work.filter_places = places_.data();
    wave.Begin(work, {samples_.data(), Rows()});
    if (reuse_) reuse_->Begin(wave.work, wave);
    MakeLightSplats();
    RunWaves(plan_.paths());
    if (const Phase* light = plan_.Find(PhaseId::kLightPaths)) {
      wave = wavefront_->Narrowed(light->features);
      wave.Begin(work, {});
      RunWaves(*light);
    }
    return findings_;
  }
  std::set<std::string> stages_run;

 private:
  void RunWaves(const Phase& phase) {
    Wave& wave = wavefront_->wave();
    for (int i = 0; i < 400 && wave.HasWork(); ++i) {
      wave.BeginWave();
      for (const PlannedStage& planned : phase.stages) {
        if (wave.queue(planned.stage.input).size > 0) Check(planned);
      }
    }
  }

  void MakeLightSplats() {
    const std::size_t entries = std::size_t{Rows()} * kMaxLightVertices;
    splat_memory_.resize(7 * entries);
    splats_ = {1, -100, -100, 100, 100, splat_memory_.data()};
    float* next = reinterpret_cast<float*>(splat_memory_.data());
    for (float** column : {&splats_.x, &splats_.y, &splats_.light[0], &splats_.light[1],
                           &splats_.light[2], &splats_.share}) {
      *column = next += entries;
    }
    wavefront_->wave().light_splats = &splats_;
  }

  /// Square tile in the middle of the image.
  PixelRect MiddleTile() const {
    const auto& film = scene_.view->film;
    const int left = (static_cast<int>(film.width) - side_) / 2;
    const int top = (static_cast<int>(film.height) - side_) / 2;
    return {left, top, left + side_, top + side_};
  }

  std::uint32_t Rows() const {
    const bool splits = plan_.features.Has(Feature::kSplitting);
    return static_cast<std::uint32_t>(side_ * side_) * kSamples *
           (splits ? kMaxSplitPaths : 1);
  }

  // Fills the tables that training would fill. Any values do.
  void MakeTables() {
    PathValues& v = tables_.path_values;
    const Geometry& g = scene_.compiled->geometry;
    v.grid = MakeCellGrid(g.bounds_min, g.bounds_max, 10000);
    v.survive.assign(v.grid.cells(), 1.5f);
    v.inverse_pixel.assign(std::size_t{run_.width} * run_.height * 3, 0.7f);
    if (!plan_.features.Has(Feature::kLearnedLights)) return;
    LearnedLights& lights = tables_.lights;
    lights = GroupLights(*scene_.compiled, scene_.chances->pmf);
    lights.grid = v.grid;
    lights.row.assign(v.grid.cells(), 0);
    lights.weights.assign(lights.num_groups, 1);
    SetProbabilities(lights);
  }

  WaveState Save() const {
    WaveState s;
    s.wave = wavefront_->wave();
    for (const std::uint32_t* c : columns_) {
      s.columns.emplace_back(c, c == nullptr ? c : c + s.wave.capacity);
    }
    for (const Queue& q : s.wave.queues) s.queues.emplace_back(q.items, q.items + q.size);
    s.samples = samples_;
    return s;
  }

  void Restore(const WaveState& s) {
    wavefront_->wave() = s.wave;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      std::copy(s.columns[i].begin(), s.columns[i].end(), columns_[i]);
    }
    for (int i = 0; i < kNumQueues; ++i) {
      std::copy(s.queues[i].begin(), s.queues[i].end(), s.wave.queues[i].items);
    }
    samples_ = s.samples;
  }

  void Find(const Stage& stage, const char* what, Field field) {
    findings_.insert(std::string(stage.name) + what + FieldName(field));
  }

  // With light-selection=tree the emission stages read what light_hit_tree has written
  // (kernels/lights/light_stage.h): 4 bytes that their declaration, the same for all
  // scenes, cannot have.
  bool Declares(const Stage& stage, Field field) const {
    const bool of_tree = field == Field::light_pmf &&
                         plan_.features.HasAll({Feature::kLightTree, Feature::kMis}) &&
                         std::string(stage.name).rfind("emission_", 0) == 0;
    return of_tree || stage.reads.Has(field);
  }

  void Check(const PlannedStage& planned) {
    const Stage& stage = planned.stage;
    stages_run.insert(stage.name);
    const WaveState before = Save();
    planned.kernel(wavefront_->wave());
    const WaveState after = Save();
    Restore(before);
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (columns_[i] == nullptr || Declares(stage, static_cast<Field>(i))) continue;
      std::fill_n(columns_[i], before.wave.capacity, kScrambled);
    }
    planned.kernel(wavefront_->wave());
    Compare(stage, before, after, Save());
    Restore(after);
  }

  void Compare(const Stage& stage, const WaveState& before, const WaveState& after,
               const WaveState& scrambled) {
    SplitPaths copies(before, after);
    if (after.queues != scrambled.queues) findings_.insert(stage.name + kQueues);
    if (!SameBits(after.samples, scrambled.samples)) {
      findings_.insert(stage.name + kOutput);
    }
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const Field field = static_cast<Field>(i);
      for (std::size_t k = 0; k < after.columns[i].size(); ++k) {
        if (after.columns[i][k] == before.columns[i][k]) continue;
        if (!stage.writes.Has(field) && copies.Explain(i, k)) continue;
        if (!stage.writes.Has(field)) Find(stage, " writes ", field);
        if (after.columns[i][k] != scrambled.columns[i][k]) {
          Find(stage, " reads what it does not declare for ", field);
        }
      }
    }
  }

  static bool SameBits(const std::vector<float>& a, const std::vector<float>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), [](float x, float y) {
      return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y);
    });
  }

  const std::string kQueues = " reads what it does not declare for queues";
  const std::string kOutput = " reads what it does not declare for samples";
  PreparedScene scene_;
  const int side_ = std::min({kLongestSide, static_cast<int>(scene_.view->film.width),
                              static_cast<int>(scene_.view->film.height)});
  Plan plan_;
  StrategyTables tables_;
  RunParameters run_;
  std::unique_ptr<Wavefront> wavefront_;
  std::optional<BlockReuse> reuse_;
  LightSplats splats_;
  std::vector<std::uint32_t> splat_memory_;
  std::vector<std::uint32_t*> columns_;  // in the order of Field; null: not live
  std::vector<std::uint32_t> pixels_;
  std::vector<float> samples_, places_;
  std::set<std::string> findings_;
};

// Those that run on paths; a block's have no columns of theirs.
std::set<std::string> RegisteredStages() {
  std::set<std::string> names;
#define X(id) \
  if (id##Stage({}).scope == StageScope::kWave) names.insert(id##Stage({}).name);
  LANELIGHT_STAGES(X)
#undef X
  return names;
}

void WriteSky(const std::string& path) {
  Image sky = MakeImage(4, 4, {"R", "G", "B"});
  for (std::size_t i = 0; i < sky.pixels.size(); ++i) sky.pixels[i] = 0.1f + i % 7;
  WritePfm(path, sky);
}

}  // namespace

TEST_CASE("stages touch the columns that they declare", "[plan]") {
  const TemporaryFolder folder;
  WriteSky(folder.File("sky.pfm"));
  folder.Write("measured.bsdf", reference::MeasuredFile(reference::BrassModel()));
  folder.Write("lenses.dat", "60 5 1.5 30  -60 3 1 30  0 50 0 20");
  constexpr DeclaredCase kCases[] = {
      {kAllStagesScene, "points=independent"},
      {kAllStagesScene, "points=sobol,light-selection=tree,light-points=solid-angle"},
      {kAllStagesScene, "points=halton,directions=uniform,pairs=antithetic"},
      {kAllStagesScene, "points=stratified,control=regression,roulette=none"},
      {kAllStagesScene, "points=halton,control=regression,roulette=constant"},
      {kAllStagesScene, "points=sobol,light-points=projected"},
      {kAllStagesScene, "points=stratified,directions=light"},
      {kAllStagesScene, "light-candidates=resampled"},
      {kAllStagesScene, "roulette=adjoint"},
      {kAllStagesScene, "points=sobol,reuse=block"},
      {kAllStagesScene, "points=sobol", true},
      {kAllStagesScene, "roulette=adjoint", true},
      {kOtherStagesScene, "points=sobol"},
      {kOtherStagesScene, "directions=bsdf,pairs=antithetic"},
      {kMediaScene, "points=sobol"},
      {kMediaScene, "light-candidates=resampled,pairs=antithetic"},
      {kFogScene, "points=sobol"},
      {kFogScene, "light-paths=splats"},
      {kSmokyLampsScene, "points=sobol,light-paths=splats"},
      {kInsideScene, "points=sobol"},
      {kInsideScene, "roulette=adjoint"},
      {kMeasuredScene, "points=sobol"},
      {kSpectralScene, "points=sobol"},
      {kSpectralScene, "roulette=adjoint"},
      {kPlainSpectralScene, "points=sobol"},
      {kPlainSpectralScene, "light-candidates=resampled"},
      {kCurvesScene, "points=sobol"},
      {kCurvesScene, "points=sobol,reuse=block"},
      {kForcedScene, "points=sobol"},
      {kRegularScene, "points=sobol"},
      {kRegularScene, "directions=light"},
      {kForcedScene, "roulette=adjoint"},
      {kLampsScene, "points=sobol,light-paths=splats"},
      {kLampsScene, "light-paths=splats,roulette=none"},
      {kLampsScene, "light-selection=learned"},
      {kLampsScene, "pixel-samples=shared"},
      {kMovingScene, "points=sobol"},
      {kMovingScene, "points=halton,pairs=antithetic"},
      {kSphericalScene, "points=sobol"},
      {kLensesScene, "points=sobol"}};
  std::set<std::string> stages;
  for (const DeclaredCase& c : kCases) {
    Checker checker(c, folder.File(""));
    for (const std::string& finding : checker.Run()) {
      INFO(c.strategy);
      FAIL_CHECK(finding);
    }
    stages.insert(checker.stages_run.begin(), checker.stages_run.end());
  }
  for (const std::string& name : RegisteredStages()) {
    INFO("no case runs the stage " << name);
    CHECK(stages.count(name) == 1);
  }
}

}  // namespace lanelight
