#include "src/render/merge.h"

#include <algorithm>
#include <tuple>

#include "src/core/error.h"
#include "src/core/json_text.h"
#include "src/prepare/groups.h"
#include "src/render/add_seeds.h"
#include "src/render/checkpoint.h"
#include "src/render/identity.h"
#include "src/render/machine_json.h"
#include "src/strategy/strategy.h"

namespace lanelight {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMostOpen = 256;

struct Input {
  std::string path;
  Json identity;
  std::vector<PixelRect> tiles;
  std::uint64_t seed = 0;
  std::unique_ptr<StateFile> file = {};  // open, unless there are too many

  // Where a part begins: the order of sums that no order of files may change.
  auto Order() const {
    const PixelRect& t = tiles.front();
    return std::tuple(seed, t.y0, t.x0);
  }
};

Json WithoutSeed(Json identity) {
  identity.erase("seed");
  return identity;
}

// A film with all that the states keep of one.
void MakeFilms(const StateFile& file, MergedRender& merged) {
  Strategy strategy;
  ApplyStrategy(merged.identity.at("strategy").get<std::string>(), {}, strategy);
  if (!merged.training.is_null()) {
    ApplyStrategy(merged.training.at("changes").get<std::string>(), {}, strategy);
  }
  const PixelRect& w = merged.window;
  const Auxiliary auxiliary = file.HasPixels("gbuffer") ? Auxiliary::kGbuffer
                              : file.HasPixels("aov")   ? Auxiliary::kAov
                                                        : Auxiliary::kNone;
  FeatureSet features = AuxiliaryFeatures(auxiliary);
  if (file.HasPixels("control_replicates") || file.HasPixels("control_halves")) {
    features.Add(Feature::kControlDifference);
  }
  if (file.HasPixels("regression_sums")) features.Add(Feature::kRegressionControl);
  merged.film = std::make_unique<FilmAccumulator>(w.x0, w.y0, w.width(), w.height(),
                                                  GroupsOf(strategy), auxiliary);
  merged.films = std::make_unique<Films>(SamplePlanes(features),
                                         strategy.coefficient.value_or(1), *merged.film);
  merged.film->set_chance_of_light(merged.head.value("chance_of_light", 1.0));
}

// Which pixels files of one seed have already brought, and whose they are.
class Coverage {
 public:
  explicit Coverage(const PixelRect& window)
      : window_(window), owner_(window.pixels(), -1) {}

  void Take(const std::vector<PixelRect>& tiles, int owner,
            const std::vector<Input>& inputs) {
    for (const PixelRect& t : tiles) {
      for (int y = t.y0; y < t.y1; ++y) {
        for (int x = t.x0; x < t.x1; ++x) {
          int& had = owner_[static_cast<std::size_t>(y - window_.y0) *
                                static_cast<std::size_t>(window_.width()) +
                            static_cast<std::size_t>(x - window_.x0)];
          if (had >= 0) {
            throw InputError(fmt::format("'{}' and '{}' both have pixel {},{} of seed {}",
                                         inputs[static_cast<std::size_t>(had)].path,
                                         inputs[static_cast<std::size_t>(owner)].path, x,
                                         y,
                                         inputs[static_cast<std::size_t>(owner)].seed));
          }
          had = owner;
        }
      }
    }
  }
  std::uint64_t Missing() const {
    return static_cast<std::uint64_t>(std::count(owner_.begin(), owner_.end(), -1));
  }

 private:
  PixelRect window_;
  std::vector<std::int32_t> owner_;
};

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

void CheckTraining(const MergedRender& merged, const Json& training,
                   const std::vector<TrainedTable>& tables, const std::string& path) {
  const auto same = [](const TrainedTable& a, const TrainedTable& b) {
    return a.name == b.name && a.values == b.values;
  };
  const auto changes = [](const Json& t) {
    return t.is_null() ? std::string() : t.at("changes").get<std::string>();
  };
  if (merged.training.is_null() == training.is_null() &&
      changes(merged.training) == changes(training) &&
      std::equal(tables.begin(), tables.end(), merged.tables.begin(), merged.tables.end(),
                 same)) {
    return;
  }
  throw InputError("'" + path +
                   "' was rendered with another training than the files before it");
}

std::vector<TrainedTable> TablesOf(const StateFile& file, const Json& training) {
  std::vector<TrainedTable> tables;
  if (training.is_null()) return tables;
  for (const auto& [name, meaning] : training.at("tables").items()) {
    TrainedTable table = {name, meaning, std::vector<double>(file.TableRows(name))};
    file.ReadTable(MakeStateColumn<double>(name, meaning, table.values));
    tables.push_back(std::move(table));
  }
  return tables;
}

// Reads the files one by one: two would be in memory at a time only for different seeds.
class Merger {
 public:
  explicit Merger(const std::vector<std::string>& paths) {
    for (const std::string& path : paths) {
      FromJsonOf(path, [&] { AddInput(path); });
    }
    for (const Input& input : inputs_) CheckSame(inputs_.front(), input);
    std::sort(inputs_.begin(), inputs_.end(),
              [](const Input& a, const Input& b) { return a.Order() < b.Order(); });
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
      throw InputError("'" + path +
                       "' holds several seeds; merge the states of single ones");
    }
    input.seed = input.identity.at("seed");
    windows_.push_back(file->window());
    // Opened again, it is read and checked once more.
    if (inputs_.size() < kMostOpen) input.file = std::move(file);
    inputs_.push_back(std::move(input));
  }

  MergedRender MergeSeed(std::size_t begin, std::size_t end) {
    MergedRender merged;
    merged.identity = inputs_[begin].identity;
    merged.window = windows_.front();
    merged.seeds = {inputs_[begin].seed};
    Coverage coverage(merged.window);
    for (std::size_t i = begin; i < end; ++i) {
      coverage.Take(inputs_[i].tiles, static_cast<int>(i), inputs_);
      FromJsonOf(inputs_[i].path, [&] { AddState(inputs_[i], merged); });
    }
    merged.missing = coverage.Missing();
    FindSamples(merged);
    return merged;
  }

  // The first one decides which films there are.
  static void AddState(Input& input, MergedRender& merged) {
    auto open = std::move(input.file);
    if (!open) open = std::make_unique<StateFile>(input.path);
    const StateFile& file = *open;
    const Json report = ParseJson(file.report());
    const Json& training = report.at("training");
    if (!merged.films) {
      merged.head = report.at("head");
      merged.training = training;
      MakeFilms(file, merged);
      merged.tables = TablesOf(file, training);
    }
    AddMachines(report, merged.machines);
    CheckTraining(merged, training, TablesOf(file, training), input.path);
    file.ReadPixels(merged.films->Columns(), merged.window);
    merged.counts.Add(CountsFromJson(report.at("counts")));
    merged.tiles.insert(merged.tiles.end(), input.tiles.begin(), input.tiles.end());
  }

  static void FindSamples(MergedRender& merged) {
    merged.least = ~std::uint64_t{0};
    for (const PixelRect& t : merged.tiles) {
      for (int y = t.y0; y < t.y1; ++y) {
        for (int x = t.x0; x < t.x1; ++x) {
          const std::uint64_t samples = merged.film->Samples(x, y);
          merged.least = std::min(merged.least, samples);
          merged.most = std::max(merged.most, samples);
        }
      }
    }
  }

  std::vector<Input> inputs_;
  std::vector<PixelRect> windows_;
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
  result.seconds = merged.counts.seconds;
  result.cpu_seconds = merged.counts.cpu_seconds;
  result.samples = merged.counts.samples;
  result.rays_closest = merged.counts.rays_closest;
  result.rays_shadow = merged.counts.rays_shadow;
  result.health = merged.counts.health;
  const Json& spp = merged.head.at("settings").at("spp");
  const bool whole = merged.missing == 0 && merged.least == merged.most &&
                     (spp.is_null() || merged.least >= spp.get<std::uint64_t>());
  result.stop_reason = whole ? StopReason::kSamples : StopReason::kInterrupted;
  result.stopped_early = !whole;
  result.control = merged.film->Control();
  Strategy strategy;
  ApplyStrategy(merged.identity.at("strategy").get<std::string>(), {}, strategy);
  result.roulette = strategy.roulette;
  if (merged.training.is_null()) return result;
  const Json& t = merged.training;
  result.pilot_note = t.at("note");
  result.pilot_samples = t.at("samples");
  result.pilot_rays = t.at("rays");
  result.pilot_seconds = t.at("seconds");
  result.pilot_changes = t.at("changes");
  ApplyStrategy(result.pilot_changes, {}, strategy);
  result.roulette = strategy.roulette;
  return result;
}

void WriteMergedState(MergedRender& merged, const std::string& path) {
  if (merged.seeds.size() > 1) {
    throw InputError(
        "several seeds together are no state that can be gone on with or merged again: "
        "merge all of them at once");
  }
  StateContent content;
  content.identity = DumpJson(merged.identity, 1);
  const Json report = {{"head", merged.head},
                       {"machines", ToJson(merged.machines)},
                       {"counts", CountsJson(merged.counts)},
                       {"training", merged.training}};
  content.report = DumpJson(report, 1);
  content.window = merged.window;
  content.tiles = merged.tiles;
  for (const MutableStateColumn& column : merged.films->Columns()) {
    content.pixels.push_back(column);
  }
  for (const TrainedTable& table : merged.tables) {
    content.tables.push_back(
        MakeStateColumn<double>(table.name, table.meaning, table.values));
  }
  WriteState(content, path);
}

}  // namespace lanelight
