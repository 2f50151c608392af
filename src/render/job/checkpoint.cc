#include "src/render/job/checkpoint.h"

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "src/base/core/error.h"
#include "src/base/core/json_text.h"
#include "src/base/core/source_location.h"
#include "src/base/image/exr.h"
#include "src/base/image/image.h"
#include "src/render/films/accumulator.h"
#include "src/render/job/identity.h"
#include "src/render/job/loaded_scene.h"
#include "src/render/job/output.h"
#include "src/render/job/saving.h"
#include "src/render/wave/light_paths.h"
#include "src/render/wave/tiles.h"

namespace lanelight {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using Clock = std::chrono::steady_clock;

bool IsPng(const std::string& path) { return fs::path(path).extension() == ".png"; }

const std::string& ColorSpaceOf(const Job& job) {
  return job.loaded->description.film.color_space;
}

bool Exists(const std::string& path) {
  std::error_code ignored;  // what cannot be looked at will be missed when it is opened
  return fs::exists(path, ignored);
}

std::int64_t Milliseconds() {
  return std::chrono::duration_cast<std::chrono::milliseconds>(
             Clock::now().time_since_epoch())
      .count();
}

// Tiles as they are without a state where all of the image is rendered: larger ones if
// there are few samples. Parts have the same tiles whatever the number of samples is.
std::vector<PixelRect> TilesToRender(const Job& job, const Part& part) {
  const Strategy& strategy = job.scene.strategy;
  if (part.count == 1) {
    return MakePartition(job.window, job.OpenEnded() ? kTrainingSpp : job.spp, strategy)
        .tiles;
  }
  return TilesOfPart(job.window, part, strategy.MayShare() ? kReuseTile : 1);
}

}  // namespace

std::optional<Decide> DecisionOfState(const CheckpointSettings& settings) {
  if (settings.resume == Resume::kNever) return std::nullopt;
  const std::string& from = settings.from.empty() ? settings.path : settings.from;
  if (!Exists(from)) return std::nullopt;
  Strategy strategy;
  FromJsonOf(from, [&] {
    const Json identity = ParseJson(StateFile(from).identity());
    ApplyStrategy(identity.at("strategy").get<std::string>(),
                  {std::make_shared<const std::string>(from)}, strategy);
  });
  return strategy.decide;
}

Checkpoint::Checkpoint(const Job& job, const CheckpointSettings& settings,
                       const Json& head,
                       std::function<void(const std::string&)> on_problem)
    : job_(job),
      settings_(settings),
      identity_(ParseJson(DumpJson(IdentityOf(job)))),  // as a file has it
      head_(head),
      on_problem_(std::move(on_problem)) {
  tiles_ = TilesToRender(job, settings.part);
  if (!settings.path.empty()) lock_.emplace(settings.path, on_problem_);
  Open();
  next_ = Milliseconds() + std::int64_t(1000 * settings_.seconds);
}

Checkpoint::~Checkpoint() {
  if (writing_.valid()) writing_.wait();
}

// Neither restarts silently, nor overwrites a state other than the resumed one.
void Checkpoint::Open() {
  const std::string& from = settings_.from.empty() ? settings_.path : settings_.from;
  if (settings_.resume == Resume::kMust ||
      (settings_.resume == Resume::kIfAny && Exists(from))) {
    auto file = std::make_unique<StateFile>(from);
    CheckSame(*file);
    from_ = std::move(file);
  }
  std::error_code ignored;  // of a missing file
  const bool updates = resumed() && fs::equivalent(from, settings_.path, ignored);
  if (!settings_.path.empty() && Exists(settings_.path) && !updates) {
    throw InputError(
        "'" + settings_.path +
        "' exists: continue it with --resume if it is a state of this render, or "
        "give --checkpoint another name");
  }
}

void Checkpoint::CheckSame(const StateFile& file) {
  const std::string differences = FromJsonOf(file.path(), [&] {
    return IdentityDifferences(ParseJson(file.identity()), "the state", identity_,
                               "this render");
  });
  if (!differences.empty()) {
    throw InputError("'" + file.path() +
                     "' is the state of another render:" + differences);
  }
  if (file.tiles() == tiles_) return;
  // A state of merged parts is resumed as a whole.
  const bool whole = PixelsOf(file.tiles()) == job_.window.pixels();
  if (whole && settings_.part.count == 1) {
    tiles_ = file.tiles();
    return;
  }
  if (settings_.part.count == 1) {
    throw InputError(
        fmt::format("'{}' is the state of a part ({} of {} pixels): add the --part that "
                    "wrote it, or combine all parts with `lanelight merge`",
                    file.path(), PixelsOf(file.tiles()), job_.window.pixels()));
  }
  throw InputError(
      fmt::format("'{}' is the state of another part than {}/{}: use the --part that "
                  "wrote it",
                  file.path(), settings_.part.index, settings_.part.count));
}

bool Checkpoint::Restore(RunState& state) {
  if (!from_) return false;
  from_->ReadPixels(state.films.Columns(), job_.window);
  FilmAccumulator& film = state.films.film();
  // A trial run may have chosen light subpaths.
  if (from_->HasTable("splats") && film.splats() == nullptr) {
    film.UseSplats(SplatUnit(job_.scene));
  }
  for (const MutableStateColumn& column : film.SharedColumns()) from_->ReadTable(column);
  static_cast<RunRecord&>(state) = FromJsonOf(
      from_->path(), [&] { return ReadRecord(*from_, ParseJson(from_->report())); });
  CheckNotTooMany(state.films);
  return true;
}

void Checkpoint::CheckNotTooMany(const Films& films) const {
  if (job_.spp == 0) return;
  for (const PixelRect& tile : tiles_) {
    ForEachPixel(tile, [&](int x, int y) {
      const std::uint64_t samples = films.film().Samples(x, y);
      if (samples <= job_.spp) return;
      throw InputError(
          fmt::format("'{}' has {} samples of pixel {},{}, more than the {} asked for",
                      from_->path(), samples, x, y, job_.spp));
    });
  }
}

bool Checkpoint::IsDue() const { return Milliseconds() >= next_; }

// Afterwards the render may change what is in memory.
void Checkpoint::Save(RunState& state) {
  const Clock::time_point start = Clock::now();
  if (writing_.valid()) kept_ = writing_.get();
  if (state.finished && !settings_.finished) {
    kept_ = true;
    return;
  }
  last_.reset();
  if (!settings_.path.empty()) last_ = Copy(state);
  writing_ = std::async(std::launch::async, [this, watch = WatchWriter(state)] {
    const bool watched = !watch || WriteOrReport(watch);
    const bool wanted = last_ != nullptr;
    const bool kept = wanted && WriteOrReport([this] { last_->Write(settings_.path); });
    if (watched && kept == wanted) reported_.clear();
    if (kept) last_.reset();  // as much memory as the film has
    return kept;
  });
  ++count_;
  pause_seconds_ += std::chrono::duration<double>(Clock::now() - start).count();
  next_ = Milliseconds() + std::int64_t(1000 * settings_.seconds);
}

std::unique_ptr<StateCopy> Checkpoint::Copy(RunState& state) const {
  StateContent content = ContentOf(identity_, {{"head", head_}}, state.films, state);
  content.window = job_.window;
  content.tiles = tiles_;
  return std::make_unique<StateCopy>(content);
}

std::function<void()> Checkpoint::WatchWriter(RunState& state) const {
  FilmAccumulator& film = state.films.film();
  // The image of before is better than one with holes.
  if (settings_.watch.empty() || SampledPixels(film) < PixelsOf(tiles_)) return {};
  film.FitControl();
  // Made only where they are written.
  std::shared_ptr<std::vector<ExrPlane>> planes;
  std::shared_ptr<Image> image;
  ExrOptions options;
  for (const std::string& path : settings_.watch) {
    if (IsPng(path)) {
      if (!image) image = std::make_shared<Image>(FilmImage(film, ColorSpaceOf(job_)));
    } else if (!planes) {
      planes =
          std::make_shared<std::vector<ExrPlane>>(FilmPlanes(film, job_.scene.scale()));
      const ErrorEstimate error = EstimateError(film);
      options = OutputOptions(identity_, head_,
                              {state.counts, state.training.changes, error}, film,
                              /*half=*/false);
    }
  }
  return [paths = settings_.watch, exposure = settings_.exposure, planes, image, options,
          width = film.width(), height = film.height()] {
    for (const std::string& path : paths) {
      if (IsPng(path)) {
        WritePng(path, *image, exposure);
      } else {
        WriteExr(path, width, height, *planes, options);
      }
    }
  };
}

bool Checkpoint::WriteOrReport(const std::function<void()>& write) {
  try {
    write();
    return true;
  } catch (const std::exception& error) {
    if (reported_.insert(error.what()).second) on_problem_(error.what());
    return false;
  }
}

std::vector<std::string> Checkpoint::Finish() {
  if (writing_.valid()) kept_ = writing_.get();
  if (kept_ || !last_) return {};
  std::string path = settings_.path;
  ResultWriter writer;
  writer.Save(path, [&](const std::string& p) { last_->Write(p); });
  kept_ = path == settings_.path;
  return writer.problems();
}

}  // namespace lanelight
