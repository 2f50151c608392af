// A run that is put down anywhere and picked up by another one, with other threads, other
// tasks and another end in mind, ends at the same bits as one that was never stopped.
#include <atomic>
#include <catch2/catch.hpp>
#include <functional>
#include <random>

#include "src/core/error.h"
#include "src/estimate/target.h"
#include "src/wavefront/schedule.h"
#include "src/wavefront/training.h"
#include "tests/wavefront/kept_state.h"
#include "tests/wavefront/render_fixture.h"

namespace lanelight {
namespace {

// Several tiles, whatever their size, and a few that are cut off.
const char* kScene = R"(
LookAt 0 2 -6  0 0.8 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 70 "integer yresolution" 37
Integrator "path" "integer maxdepth" 4
WorldBegin
LightSource "infinite" "rgb L" [ 0.2 0.3 0.4 ]
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 6 5 4 ]
  Translate -2 3 0
  Shape "sphere" "float radius" 0.3
AttributeEnd
Material "diffuse" "rgb reflectance" [ 0.6 0.5 0.4 ]
AttributeBegin
  Rotate -90 1 0 0
  Shape "plane"
AttributeEnd
Shape "sphere" "float radius" 0.8
)";
constexpr int kWidth = 70, kHeight = 37;

struct Rest {
  bool taken = false;
  std::vector<KeptColumn> columns;
  RunCounts counts;
  bool trained = false;
  TrainingOutcome training;
  std::vector<TrainedTable> tables;
};

// Puts the run down once it has been asked so often, and lets it end there or go on.
class Pauser : public RunKeeper {
 public:
  Pauser(Rest& rest, int patience, bool stops)
      : rest_(rest), patience_(patience), stops_(stops) {}

  bool Restore(RunState& state) override {
    if (!rest_.taken) return false;
    PutColumns(rest_.columns, state.films);
    state.counts = rest_.counts;
    state.trained = rest_.trained;
    state.training = rest_.training;
    state.tables = rest_.tables;
    return true;
  }
  bool Due() const override { return asked_.fetch_add(1) >= patience_; }
  void Keep(RunState& state) override {
    rest_ = {true,          CopyColumns(state.films), state.counts,
             state.trained, state.training,           state.tables};
    kept_ += 1;
    asked_ = 0;
    if (stops_) stop_ = true;
  }

  const std::atomic<bool>& stop() const { return stop_; }
  int kept() const { return kept_; }

 private:
  Rest& rest_;
  int patience_;
  bool stops_;
  mutable std::atomic<int> asked_{0};
  int kept_ = 0;
  std::atomic<bool> stop_{false};
};

struct Request {
  std::string strategy;
  std::uint64_t spp = 0, seed = 1;
  double target = 0;
  int threads = 2;
  std::uint32_t wavefront = 0;
  RunKeeper* keeper = nullptr;
  const std::atomic<bool>* stop = nullptr;
  bool keep_roulette = true;
};

Rendered Render(const Request& request) {
  const ThreadLimit limit(request.threads);
  CompiledScene scene = PrepareScene(ParseSceneText(kScene, "test.pbrt", "."), {});
  Strategy strategy = scene.strategy;
  ApplyStrategy(request.strategy, {}, strategy);
  UseStrategy(strategy, scene);
  PlanOptions plan_options;
  plan_options.max_depth = 4;
  plan_options.wavefront = request.wavefront;
  const Plan plan = MakePlan(scene, plan_options);
  Rendered out{
      FilmAccumulator(0, 0, kWidth, kHeight, GroupsOf(strategy), false), {}, plan};
  RunOptions options;
  options.spp = request.spp;
  options.seed = request.seed;
  options.keep_roulette = request.keep_roulette;
  options.keeper = request.keeper;
  options.stop = request.stop;
  if (request.target > 0) {
    options.samples_needed = [&](std::uint64_t done) {
      return SamplesNeeded({request.target, 0}, EstimateError(out.film), done);
    };
  }
  out.result = Run(scene, plan, options, out.film);
  return out;
}

bool Same(const RunResult& a, const RunResult& b) {
  return a.samples == b.samples && a.rays_closest == b.rays_closest &&
         a.rays_shadow == b.rays_shadow && a.health.Total() == b.health.Total() &&
         a.pilot_samples == b.pilot_samples && a.pilot_rays == b.pilot_rays &&
         a.pilot_note == b.pilot_note && a.roulette == b.roulette && a.looks == b.looks;
}

// Renders from rest to rest until `request` is met. The runs on the way want anything of
// `ends`; `pauses` counts those that were stopped.
Rendered RenderInParts(const Request& request, const std::vector<Request>& ends,
                       Rest& rest, int& pauses, unsigned seed) {
  std::mt19937 random(seed);
  for (int run = 0;; ++run) {
    const bool last = run >= 12;
    Request part = last || ends.empty() ? request : ends[random() % ends.size()];
    // The last one is looked at while it goes on, the others end there.
    Pauser pauser(rest, 1 + static_cast<int>(random() % 8), !last);
    part.threads = 1 + static_cast<int>(random() % 3);
    part.wavefront = random() % 2 == 0 ? 0 : 300;
    part.keeper = &pauser;
    part.stop = &pauser.stop();
    Rendered out = Render(part);
    pauses += out.result.stop_reason == StopReason::kInterrupted;
    if (last) return out;
  }
}

const char* const kStrategies[] = {
    "points=independent",
    "points=sobol",
    "points=independent,pairs=antithetic",
    "points=cmj,pairs=antithetic",
    "points=independent,control=analytic",
    "points=stratified,control=analytic,pairs=antithetic",
    "points=sobol,control=regression",
    "points=independent,control=regression,pairs=antithetic",
    "points=halton,roulette=adjoint",
    "points=sobol,roulette=efficiency",
    "points=sobol,decide=pilot",
    "points=sobol,allocation=error",
    "points=independent,control=analytic,allocation=error",
    "points=cmj,pairs=antithetic,allocation=error",
    "points=sobol,control=regression,allocation=error",
    "points=sobol,shadow-roulette=contribution",
};

}  // namespace

TEST_CASE("a run in parts ends at the bits of one run, toward more samples too",
          "[resume]") {
  for (const char* strategy : kStrategies) {
    INFO(strategy);
    Request request;
    request.strategy = strategy;
    request.spp = 45;
    const Rendered whole = Render(request);
    std::vector<Request> ends;
    // Fewer samples are other tiles, and tasks that end anywhere.
    for (std::uint64_t spp : {1, 5, 8, 21, 45}) {
      ends.push_back(request);
      ends.back().spp = spp;
    }
    int pauses = 0;
    Rest rest;
    const Rendered parts = RenderInParts(request, ends, rest, pauses, 7);
    CHECK(pauses >= 3);
    CHECK(rest.counts.samples == whole.result.samples);
    const bool shared = std::string(strategy).find("allocation") != std::string::npos;
    if (!shared) CHECK(rest.counts.samples == 45 * kWidth * kHeight);
    CHECK(Identical(parts.film, whole.film));
    CHECK(Same(parts.result, whole.result));
    CHECK(whole.film.Variance(kWidth / 2, kHeight - 1).x > 0);
    request.seed = 2;
    CHECK_FALSE(Identical(Render(request).film, whole.film));
  }
}

TEST_CASE("a run in parts may want a finer error each time", "[resume]") {
  for (const char* strategy :
       {"points=sobol", "points=independent,pairs=antithetic",
        "points=cmj,control=analytic", "points=sobol,allocation=error"}) {
    for (double finest : {0.0004, 0.002}) {
      INFO(strategy << ", " << finest);
      Request request;
      request.strategy = strategy;
      request.target = finest;
      const Rendered whole = Render(request);
      CHECK(whole.result.stop_reason == StopReason::kTarget);
      if (finest < 0.001) CHECK(whole.result.looks > 1);
      std::vector<Request> ends;
      for (double target : {25 * finest, 5 * finest, 2 * finest, finest}) {
        ends.push_back(request);
        ends.back().target = target;
      }
      int pauses = 0;
      Rest rest;
      const Rendered parts = RenderInParts(request, ends, rest, pauses, 8);
      CHECK(parts.result.stop_reason == StopReason::kTarget);
      CHECK(Identical(parts.film, whole.film));
      CHECK(Same(parts.result, whole.result));
      // What is reached already is not rendered again.
      Pauser pauser(rest, 1 << 30, true);
      request.keeper = &pauser;
      CHECK(Same(Render(request).result, whole.result));
    }
  }
}

TEST_CASE("a roulette that the pilot passes prefer is kept", "[resume]") {
  Request request;
  request.strategy = "points=sobol,roulette=efficiency";
  request.keep_roulette = false;
  request.spp = 12;
  const Rendered whole = Render(request);
  int pauses = 0;
  Rest rest;
  const Rendered parts = RenderInParts(request, {}, rest, pauses, 9);
  CHECK(pauses > 0);
  CHECK(Identical(parts.film, whole.film));
  CHECK(Same(parts.result, whole.result));
  CHECK(whole.result.pilot_samples > 0);
}

TEST_CASE("a decision is kept, and nothing is decided anew", "[resume]") {
  Request request;
  request.strategy = "points=sobol,decide=pilot";
  request.spp = 12;
  const Rendered whole = Render(request);
  CHECK_THAT(whole.result.pilot_changes, Catch::Contains("decide=none"));
  CHECK(whole.result.pilot_samples > 0);
  int pauses = 0;
  Rest rest;
  const Rendered parts = RenderInParts(request, {}, rest, pauses, 10);
  CHECK(pauses > 0);
  CHECK(Identical(parts.film, whole.film));
  CHECK(Same(parts.result, whole.result));
  CHECK(parts.result.pilot_changes == whole.result.pilot_changes);
}

namespace {

// Half a run, and what is left of it.
Rest HalfOf(const Request& request, int patience = 7) {
  Rest rest;
  Pauser pauser(rest, patience, true);
  Request half = request;
  half.keeper = &pauser;
  half.stop = &pauser.stop();
  CHECK(Render(half).result.stop_reason == StopReason::kInterrupted);
  return rest;
}

FilmAccumulator RestOf(Request request, Rest rest) {
  Pauser pauser(rest, 1 << 30, true);
  request.keeper = &pauser;
  return Render(request).film;
}

}  // namespace

TEST_CASE("planted: a run that forgets its decision ends elsewhere", "[resume]") {
  Request request;
  request.strategy = "points=sobol,decide=pilot";
  request.spp = 21;
  const FilmAccumulator whole = Render(request).film;
  Rest rest = HalfOf(request);
  CHECK(Identical(RestOf(request, rest), whole));
  rest.training.changes = "roulette=none,decide=none";
  CHECK_FALSE(Identical(RestOf(request, rest), whole));
  rest.training.changes = "roulette=nonesuch";
  CHECK_THROWS_AS(RestOf(request, rest), InputError);
}

TEST_CASE("planted: a run that forgets anything ends elsewhere", "[resume]") {
  for (const char* strategy :
       {"points=sobol", "points=independent,pairs=antithetic", "roulette=adjoint"}) {
    Request request;
    request.strategy = strategy;
    request.spp = 21;
    const FilmAccumulator whole = Render(request).film;
    const Rest rest = HalfOf(request);
    CHECK(Identical(RestOf(request, rest), whole));
    for (std::size_t i = 0; i < rest.columns.size(); ++i) {
      Rest damaged = rest;
      // Open pairs are few: tasks hold whole ones.
      if (rest.columns[i].name == "open") continue;
      std::vector<char>& bytes = damaged.columns[i].bytes;
      std::fill(bytes.begin(), bytes.end(), 0);
      INFO(strategy << ", " << rest.columns[i].name);
      CHECK_FALSE(Identical(RestOf(request, damaged), whole));
    }
    for (std::size_t i = 0; i < rest.tables.size(); ++i) {
      INFO(rest.tables[i].name);
      Rest damaged = rest;
      std::vector<double>& values = damaged.tables[i].values;
      if (values.empty()) continue;
      values.pop_back();
      if (rest.tables[i].name != "path_values_inverse") {
        CHECK_THROWS_AS(RestOf(request, damaged), InputError);
      }
      values = rest.tables[i].values;
      damaged.tables[i].name += "_";
      CHECK_THROWS_AS(RestOf(request, damaged), InputError);
      damaged.tables[i].name = rest.tables[i].name;
      if (rest.tables[i].name == "path_values") continue;
      for (double& v : values) v *= 1.5;
      CHECK_FALSE(Identical(RestOf(request, damaged), whole));
    }
  }
}

TEST_CASE("planted: a run that forgets its weights ends elsewhere", "[resume]") {
  Request request;
  request.strategy = "points=sobol,allocation=error";
  request.spp = 60;
  const FilmAccumulator whole = Render(request).film;
  const Rest rest = HalfOf(request, 60);  // after the pilot
  CHECK(Identical(RestOf(request, rest), whole));
  Rest damaged = rest;
  KeptColumn& weights = damaged.columns.back();
  REQUIRE(weights.name == "weights");
  std::fill(weights.bytes.begin(), weights.bytes.end(), 0);
  CHECK_FALSE(weights == rest.columns.back());
  CHECK_FALSE(Identical(RestOf(request, damaged), whole));
}

namespace {

// Begins a film with samples that all are 0.
class LateStart : public RunKeeper {
 public:
  explicit LateStart(std::uint64_t first) : first_(first) {}
  bool Restore(RunState& state) override {
    for (const MutableStateColumn& column : state.films.Columns()) {
      if (column.name != "samples") continue;
      auto* const samples = static_cast<std::uint64_t*>(column.data);
      std::fill(samples, samples + column.rows, first_);
    }
    state.counts.samples = first_ * kWidth * kHeight;
    return true;
  }
  bool Due() const override { return false; }
  void Keep(RunState& state) override { columns = CopyColumns(state.films); }

  std::vector<KeptColumn> columns;

 private:
  std::uint64_t first_;
};

// Sums of samples [first, last), by replicate, of all pixels.
std::vector<double> SumsOf(const std::string& strategy, std::uint64_t first,
                           std::uint64_t last, int threads = 2) {
  LateStart keeper(first);
  Request request;
  request.strategy = strategy;
  request.spp = last;
  request.threads = threads;
  request.keeper = &keeper;
  const Rendered out = Render(request);
  CHECK(out.result.samples == last * kWidth * kHeight);
  CHECK(out.result.stop_reason == StopReason::kSamples);
  const KeptColumn& sums = keeper.columns[1];
  std::vector<double> values(sums.bytes.size() / sizeof(double));
  std::memcpy(values.data(), sums.bytes.data(), sums.bytes.size());
  return values;
}

double Difference(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

}  // namespace

TEST_CASE("samples beyond the indices of kernels go on under another seed", "[resume]") {
  const std::uint64_t end = kSamplesPerSeed;
  for (const char* strategy : {"points=sobol", "points=pmj02", "points=independent",
                               "points=lattice,pairs=antithetic"}) {
    INFO(strategy);
    const std::vector<double> before = SumsOf(strategy, end - 8, end);
    const std::vector<double> after = SumsOf(strategy, end, end + 8);
    const std::vector<double> across = SumsOf(strategy, end - 8, end + 8);
    std::vector<double> both = before;
    for (std::size_t i = 0; i < both.size(); ++i) both[i] += after[i];
    CHECK(Difference(across, both) < 1e-10);
    CHECK(SumsOf(strategy, end - 8, end + 8, 1) == across);
    // None of these are the same samples.
    const std::vector<double> first = SumsOf(strategy, 0, 8);
    const std::vector<double> next = SumsOf(strategy, 2 * end, 2 * end + 8);
    const std::vector<double> last =
        SumsOf(strategy, kMostSamplesPerPixel - 8, kMostSamplesPerPixel);
    const std::vector<double>* const all[] = {&before, &after, &first, &next, &last};
    for (const auto* a : all) {
      for (const auto* b : all) CHECK((Difference(*a, *b) > 0.1) == (a != b));
    }
  }
}

}  // namespace lanelight
