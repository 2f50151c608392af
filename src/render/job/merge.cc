#include "src/render/job/merge.h"

#include <algorithm>
#include <span>
#include <tuple>

#include "src/base/core/error.h"
#include "src/base/core/json_text.h"
#include "src/base/core/source_location.h"
#include "src/base/state/tiles.h"
#include "src/render/films/accumulator.h"
#include "src/render/job/checkpoint.h"
#include "src/render/job/identity.h"
#include "src/render/job/machine_json.h"
#include "src/scene/prepare/parameters.h"
#include "src/vocabulary/strategy/strategy.h"

namespace lanelight {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMaxOpenFiles = 256;

struct Input {
  std::string path;
  Json identity;
  std::vector<PixelRect> tiles;
  std::uint64_t seed = 0;
  std::unique_ptr<StateFile> file = {};  // open, unless there are too many

  // Orders parts by seed and place, so that sums do not depend on the order of files.
  auto Order() const {
    const PixelRect& t = tiles.front();
    return std::tuple(seed, t.y0, t.x0);
  }
};

Json WithoutSeed(Json identity) {
  identity.erase("seed");
  return identity;
}

// Checks the members that merging and writing read, so that a damaged state is named.
void CheckIdentity(const std::string& path, const Json& identity) {
  for (const char* key : {"crop", "resolution", "strategy", "version", "scene_hash"}) {
    identity.at(key);
  }
  Strategy strategy;
  SourceLocation where;
  where.file = std::make_shared<const std::string>(path);
  ApplyStrategy(identity.at("strategy").get<std::string>(), where, strategy);
}

Strategy StrategyOf(const MergedRender& merged) {
  Strategy strategy;
  ApplyStrategy(merged.identity.at("strategy").get<std::string>(), {}, strategy);
  if (merged.run.trained) ApplyStrategy(merged.run.training.changes, {}, strategy);
  return strategy;
}

// A film with all that the states keep of one.
void MakeFilms(const StateFile& file, MergedRender& merged) {
  const Strategy strategy = StrategyOf(merged);
  const PixelRect& w = merged.window;
  const Auxiliary auxiliary = file.HasPixels("gbuffer") ? Auxiliary::kGbuffer
                              : file.HasPixels("aov")   ? Auxiliary::kAov
                                                        : Auxiliary::kNone;
  FeatureSet features = AuxiliaryFeatures(auxiliary);
  if (file.HasPixels("regression_sums")) features.Add(Feature::kRegressionControl);
  merged.film = std::make_unique<FilmAccumulator>(w.x0, w.y0, w.width(), w.height(),
                                                  GroupsOf(strategy), auxiliary);
  if (file.HasPixels("buckets")) {
    merged.film->UseBuckets(BucketsOf(merged.identity));
    features.Add(Feature::kSpectralFilm);
  }
  if (file.HasTable("splats")) {
    merged.film->UseSplats(merged.head.at("splat_unit"));
  }
  const Json& reach = merged.head.at("filter_reach");
  merged.film->set_dependents(DependentsOf(
      strategy, {reach.at("splats"), reach.at("shared"), reach.at("shared_variance")}));
  merged.films = std::make_unique<Films>(SamplePlanes(features),
                                         strategy.coefficient.value_or(1), *merged.film);
  merged.film->set_chance_of_light(merged.head.value("chance_of_light", 1.0));
}

// No two inputs, which are of one seed, may have the same pixels; `tiles` are all theirs.
void CheckApart(std::span<const Input> inputs, const std::vector<PixelRect>& tiles,
                const PixelRect& window) {
  if (TileProblem(tiles, window).empty()) return;
  for (const Input& a : inputs) {
    for (const Input* b = &a + 1; b != inputs.data() + inputs.size(); ++b) {
      std::vector<PixelRect> both = a.tiles;
      both.insert(both.end(), b->tiles.begin(), b->tiles.end());
      const std::string problem = TileProblem(both, window);
      if (problem.empty()) continue;
      throw InputError(fmt::format("'{}' and '{}' both have pixels of seed {}: {}",
                                   a.path, b->path, a.seed, problem));
    }
  }
}

void CheckSame(const Input& first, const Input& other) {
  const std::string differences =
      IdentityDifferences(WithoutSeed(first.identity), "'" + first.path + "'",
                          WithoutSeed(other.identity), "'" + other.path + "'");
  if (differences.empty()) return;
  throw InputError("states of different renders cannot be merged:" + differences);
}

// A state that was itself merged lists them all.
void AddMachines(const Json& report, std::vector<MachineInfo>& machines) {
  if (!report.contains("machines")) {
    AddMachine(MachineFromJson(report.at("head").value("machine", Json())), machines);
    return;
  }
  for (const Json& machine : report.at("machines")) {
    AddMachine(MachineFromJson(machine), machines);
  }
}

void CheckTraining(const RunRecord& first, const RunRecord& other,
                   const std::string& path) {
  const auto same = [](const TrainedTable& a, const TrainedTable& b) {
    return a.name == b.name && a.values == b.values;
  };
  if (first.trained == other.trained &&
      first.training.changes == other.training.changes &&
      std::equal(first.tables.begin(), first.tables.end(), other.tables.begin(),
                 other.tables.end(), same)) {
    return;
  }
  throw InputError("'" + path + "' has other training data than the files before it");
}

// Adds what the file's part has brought to pixels of all parts.
void AddShared(const StateFile& file, FilmAccumulator& film) {
  for (const MutableStateColumn& sum : film.SharedColumns()) {
    std::vector<char> memory(sum.Bytes());
    MutableStateColumn more = sum;
    more.data = memory.data();
    file.ReadTable(more);
    AddColumn(sum, more);
  }
}

// Reads the files one by one: two would be in memory at a time only for different seeds.
class Merger {
 public:
  explicit Merger(const std::vector<std::string>& paths) {
    for (const std::string& path : paths) {
      FromJsonOf(path, [&] { AddInput(path); });
    }
    for (const Input& input : inputs_) CheckSame(inputs_.front(), input);
    std::ranges::sort(
        inputs_, [](const Input& a, const Input& b) { return a.Order() < b.Order(); });
  }

  MergedRender Merge() {
    for (std::size_t begin = 0; begin < inputs_.size();) {
      std::size_t end = begin;
      while (end < inputs_.size() && inputs_[end].seed == inputs_[begin].seed) ++end;
      MergedRender one = MergeSeed(begin, end);
      if (begin == 0) {
        merged_ = std::move(one);
      } else {
        AddSeed(merged_, one);
      }
      begin = end;
    }
    return std::move(merged_);
  }

 private:
  void AddInput(const std::string& path) {
    auto file = std::make_unique<StateFile>(path);
    Input input = {path, ParseJson(file->identity()), file->tiles()};
    if (input.tiles.empty()) throw InputError("'" + path + "' holds no pixels");
    if (!input.identity.at("seed").is_number()) {
      throw InputError(
          "'" + path +
          "' is a merged state of several seeds; merge the single-seed states instead");
    }
    input.seed = input.identity.at("seed");
    CheckIdentity(path, input.identity);
    window_ = file->window();  // the same for all: CheckSame
    // Opened again, it is read and checked once more.
    if (inputs_.size() < kMaxOpenFiles) input.file = std::move(file);
    inputs_.push_back(std::move(input));
  }

  MergedRender MergeSeed(std::size_t begin, std::size_t end) {
    MergedRender merged;
    merged.identity = inputs_[begin].identity;
    merged.window = window_;
    merged.seeds = {inputs_[begin].seed};
    const std::span<Input> inputs(&inputs_[begin], end - begin);
    merged.missing = merged.window.pixels();
    for (const Input& input : inputs) {
      merged.tiles.insert(merged.tiles.end(), input.tiles.begin(), input.tiles.end());
    }
    CheckApart(inputs, merged.tiles, merged.window);
    for (const PixelRect& tile : merged.tiles) merged.missing -= tile.pixels();
    for (Input& input : inputs) {
      FromJsonOf(input.path, [&] { AddState(input, merged); });
    }
    FindSamples(merged);
    return merged;
  }

  // The first one decides which films there are.
  static void AddState(Input& input, MergedRender& merged) {
    auto open = std::move(input.file);
    if (!open) open = std::make_unique<StateFile>(input.path);
    const StateFile& file = *open;
    const Json report = ParseJson(file.report());
    const RunRecord run = ReadRecord(file, report);
    if (!merged.films) {
      merged.head = report.at("head");
      merged.run = run;
      merged.run.counts = {};
      MakeFilms(file, merged);
    }
    AddMachines(report, merged.machines);
    CheckTraining(merged.run, run, input.path);
    file.ReadPixels(merged.films->Columns(), merged.window);
    AddShared(file, *merged.film);
    merged.run.counts.Add(run.counts);
  }

  static void FindSamples(MergedRender& merged) {
    merged.minimum = ~std::uint64_t{0};
    for (const PixelRect& tile : merged.tiles) {
      ForEachPixel(tile, [&](int x, int y) {
        const std::uint64_t samples = merged.film->Samples(x, y);
        merged.minimum = std::min(merged.minimum, samples);
        merged.maximum = std::max(merged.maximum, samples);
      });
    }
  }

  std::vector<Input> inputs_;
  PixelRect window_;
  MergedRender merged_;
};

}  // namespace

MergedRender MergeStates(const std::vector<std::string>& paths) {
  MergedRender merged = Merger(paths).Merge();
  const bool one = merged.machines.size() == 1;
  merged.head["machine"] = one ? ToJson(merged.machines.front()) : Json();
  return merged;
}

RunResult ResultOf(const MergedRender& merged) {
  RunResult result;
  static_cast<RunCounts&>(result) = merged.run.counts;
  result.training = merged.run.training;
  const Json& spp = merged.head.at("settings").at("spp");
  const bool whole = merged.missing == 0 && merged.minimum == merged.maximum &&
                     (spp.is_null() || merged.minimum >= spp.get<std::uint64_t>());
  result.stop_reason = whole ? StopReason::kSamples : StopReason::kInterrupted;
  result.stopped_early = !whole;
  result.control = merged.film->Control();
  result.roulette = StrategyOf(merged).roulette;
  return result;
}

void WriteMergedState(MergedRender& merged, const std::string& path) {
  if (merged.seeds.size() > 1) {
    throw InputError(
        "a merged state of several seeds cannot be resumed or merged again; merge all "
        "single-seed states in one command");
  }
  StateContent content = ContentOf(
      merged.identity, {{"head", merged.head}, {"machines", ToJson(merged.machines)}},
      *merged.films, merged.run);
  content.window = merged.window;
  content.tiles = merged.tiles;
  WriteState(content, path);
}

}  // namespace lanelight
