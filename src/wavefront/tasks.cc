#include "src/wavefront/tasks.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "src/core/check.h"
#include "src/core/parallel.h"
#include "src/prepare/path_values.h"
#include "src/scene/rendered_pixels.h"
#include "src/wavefront/copies.h"
#include "src/wavefront/drive.h"
#include "src/wavefront/profile.h"

namespace lanelight {
Tasks::Tasks(const CompiledScene& scene, const Plan& plan, const RunParameters& run,
             const RunOptions& options, std::uint64_t planned_spp)
    : scene_(scene),
      plan_(plan),
      run_(run),
      options_(options),
      planned_spp_(planned_spp) {
  if (!options.windows.empty()) {
    UseWindows(planned_spp);
  } else if (!options.tiles.empty()) {
    partition_.tiles = options.tiles;
    std::uint64_t most = 1;
    for (const PixelRect& tile : options.tiles) most = std::max(most, tile.pixels());
    partition_.samples = SamplesPerTask(most, planned_spp);
  } else {
    partition_ = MakePartition(RenderedPixels(scene.film), planned_spp);
  }
  for (const PixelRect& tile : partition_.tiles) pixel_count_ += tile.pixels();
  // A pair must not straddle two tasks.
  if (scene.strategy.pairs == Pairs::kAntithetic) {
    partition_.samples += partition_.samples & 1;
  }
  done_.resize(partition_.tiles.size());
  workspaces_.resize(static_cast<std::size_t>(ThreadSlots()));
}

void Tasks::UseWindows(std::uint64_t planned_spp) {
  const std::vector<PixelRect>& windows = options_.windows;
  const PixelRect& first = windows.front();
  // Small enough for one tile each, wherever they are.
  partition_ = MakePartition({0, 0, first.width(), first.height()}, planned_spp);
  LL_CHECK_EQ(partition_.tiles.size(), 1u);
  partition_.tiles = windows;
  for (const PixelRect& w : windows) {
    LL_CHECK(w.width() == first.width() && w.height() == first.height());
  }
}

// Where the pixels of a tile lie in the film.
PixelRect Tasks::Place(std::size_t tile) const {
  const PixelRect& t = partition_.tiles[tile];
  if (options_.windows.empty()) return t;
  const int x = static_cast<int>(tile) * t.width();
  return {x, 0, x + t.width(), t.height()};
}

// Pixels of a tile have equally many samples. Those of a run that was cut into smaller
// tiles need not: then the tile is divided until they have.
void Tasks::DivideUnevenTiles(const FilmAccumulator& film) {
  const auto is_even = [&](const PixelRect& tile) {
    const std::uint64_t samples = film.Samples(tile.x0, tile.y0);
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = tile.x0; x < tile.x1; ++x) {
        if (film.Samples(x, y) != samples) return false;
      }
    }
    return true;
  };
  std::vector<PixelRect>& tiles = partition_.tiles;
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    while (!is_even(tiles[i])) {
      const int longer = std::max(tiles[i].width(), tiles[i].height());
      const auto side = std::bit_floor(static_cast<unsigned>(longer - 1));
      const std::vector<PixelRect> parts = TilesOf(tiles[i], static_cast<int>(side));
      tiles[i] = parts.front();
      tiles.insert(tiles.end(), parts.begin() + 1, parts.end());
    }
  }
  done_.resize(tiles.size());
}

void Tasks::GoOn(const Films& films, const RunCounts& counts) {
  counts_ = counts;
  taken_ = counts.samples;
  if (options_.windows.empty()) DivideUnevenTiles(films.film());
  for (std::size_t tile = 0; tile < done_.size(); ++tile) {
    const PixelRect place = Place(tile);
    done_[tile] = films.film().Samples(place.x0, place.y0);
  }
}

void Tasks::CutIntoCells() {
  const int side = CellSide(RenderedPixels(scene_.film), scene_.strategy.control);
  std::vector<PixelRect> cells;
  std::vector<std::uint64_t> done;
  for (std::size_t tile = 0; tile < done_.size(); ++tile) {
    for (const PixelRect& cell : TilesOf(partition_.tiles[tile], side)) {
      cells.push_back(cell);
      done.push_back(done_[tile]);
    }
  }
  partition_.tiles = std::move(cells);
  partition_.samples = SamplesPerTask(
      static_cast<std::uint64_t>(side) * static_cast<std::uint64_t>(side), planned_spp_);
  done_ = std::move(done);
  begun_ = false;  // what is known of tiles is of others
}

void Tasks::UseShares(const Films& films) {
  CutIntoCells();
  shares_.clear();
  for (const PixelRect& tile : partition_.tiles) {
    shares_.push_back(ShareOf(films, tile.x0, tile.y0));
  }
}

std::uint64_t Tasks::Done() const {
  if (shares_.empty()) return *std::min_element(done_.begin(), done_.end());
  std::uint64_t least = ~std::uint64_t{0};
  for (std::size_t tile = 0; tile < done_.size(); ++tile) {
    least = std::min(least, shares_[tile].Mean(done_[tile]));
  }
  return least;
}

bool Tasks::IsAt(std::uint64_t limit) const {
  for (std::size_t tile = 0; tile < done_.size(); ++tile) {
    if (done_[tile] != Goal(tile, limit)) return false;
  }
  return true;
}

Round Tasks::FullRound() const {
  // Several sample ranges of the same tile run at once only where there are too few tiles
  // for the threads; they are merged in order, so the image does not depend on it.
  const std::uint64_t wanted = 8 * static_cast<std::uint64_t>(MaxThreads());
  const std::uint64_t chunks =
      std::max<std::uint64_t>(1, wanted / partition_.tiles.size());
  return {partition_.samples, static_cast<std::uint32_t>(chunks)};
}

void Tasks::BeginRound(const RoundWork& work) {
  first_ = work.first;
  per_task_ = work.per_task;
  if (begun_) return;
  begun_ = true;
  seen_lights_ = SeenLightEdges::Make(scene_, plan_.options, run_);
  if (seen_lights_) seen_lights_->Find(partition_.tiles);
}

std::vector<TileRange> Tasks::Behind(std::uint64_t limit) const {
  std::vector<TileRange> ranges;
  for (std::size_t tile = 0; tile < done_.size(); ++tile) {
    const std::uint64_t end = Goal(tile, limit);
    if (done_[tile] >= end) continue;
    ranges.push_back({static_cast<std::uint32_t>(tile), done_[tile], end,
                      partition_.tiles[tile].pixels() * (end - done_[tile])});
  }
  return ranges;
}

RunCounts Tasks::BringOn(const TileRange& range, TaskWatcher& watcher, Films& films) {
  const std::size_t tile = range.tile;
  RunCounts counts;
  while (done_[tile] < range.end && !watcher.Stopped()) {
    TaskSamples& out = ThreadWorkspace().samples;
    const Range next = {done_[tile], std::min(range.end, done_[tile] + per_task_)};
    if (!RunTask(tile, next, watcher, out)) break;
    Merge(tile, out, films);
    counts.Add(out.counts);
    watcher.TaskDone();
  }
  return counts;
}

void Tasks::Credit(const RunCounts& counts) {
  const std::lock_guard lock(counts_mutex_);
  counts_.Add(counts);
  taken_ += counts.samples;
}

void Tasks::RunRound(const RoundWork& work, TaskWatcher& watcher, Films& films) {
  BeginRound(work);
  const std::uint64_t limit = work.limit;
  if (InChunks(limit)) return RunRoundInChunks(limit, watcher, films);
  ParallelFor(partition_.tiles.size(), [&](std::size_t tile) {
    BringOn({static_cast<std::uint32_t>(tile), done_[tile], Goal(tile, limit), 0},
            watcher, films);
  });
}

// Where there are few tiles for the threads, ranges of samples are rendered at once, and
// wait in memory until it is their turn. Tiles that have a large share do not ask for it.
bool Tasks::InChunks(std::uint64_t limit) const {
  return limit - Done() > per_task_ && (shares_.empty() || FullRound().chunks > 1);
}

void Tasks::RunRoundInChunks(std::uint64_t limit, TaskWatcher& watcher, Films& films) {
  struct Chunk {
    std::size_t tile;
    Range range;
  };
  std::vector<Chunk> chunks;
  for (std::size_t tile = 0; tile < done_.size(); ++tile) {
    const std::uint64_t end = Goal(tile, limit);
    for (std::uint64_t at = done_[tile]; at < end; at += per_task_) {
      chunks.push_back({tile, {at, std::min(end, at + per_task_)}});
    }
  }
  if (buffers_.size() < chunks.size()) buffers_.resize(chunks.size());
  ParallelFor(chunks.size(), [&](std::size_t task) {
    TaskSamples& out = buffers_[task];
    out.count = 0;
    if (watcher.Stopped()) return;
    const Chunk& chunk = chunks[task];
    if (RunTask(chunk.tile, chunk.range, watcher, out)) {
      watcher.TaskDone();
    }
  });
  std::vector<std::size_t> first(done_.size(), chunks.size());  // of each tile
  for (std::size_t i = chunks.size(); i-- > 0;) first[chunks[i].tile] = i;
  ParallelFor(done_.size(), [&](std::size_t tile) {
    // Stops at the first range that did not run: later ones would leave a gap.
    for (std::size_t i = first[tile]; i < chunks.size() && chunks[i].tile == tile; ++i) {
      if (buffers_[i].count == 0) return;
      Merge(tile, buffers_[i], films);
    }
  });
}

Workspace& Tasks::ThreadWorkspace() {
  const std::size_t thread = static_cast<std::size_t>(ThreadIndex());
  LL_CHECK_LT(thread, workspaces_.size());
  if (!workspaces_[thread]) {
    workspaces_[thread] = std::make_unique<Workspace>(scene_, plan_, run_, options_);
  }
  return *workspaces_[thread];
}

// False, and no samples, if it was put down.
bool Tasks::RunTask(std::size_t tile, const Range& range, const TaskWatcher& watcher,
                    TaskSamples& out) {
  Workspace& space = ThreadWorkspace();
  StageClock* const clock = space.Clock();
  if (clock) clock->StartTask();
  out.count = static_cast<std::uint32_t>(range.end - range.begin);
  TilePixels(partition_.tiles[tile], scene_.film.width, &space.pixels);
  TileWork work;
  work.pixels = space.pixels.data();
  work.num_pixels = static_cast<std::uint32_t>(space.pixels.size());
  work.first_sample = static_cast<std::uint32_t>(range.begin - first_);
  work.samples = out.count;
  work.together = SamplesTogether(scene_, plan_);
  const std::uint32_t stride = work.num_pixels * out.count;
  const bool splits = plan_.features.Has(Feature::kSplitting);
  const std::uint32_t rows = stride * (splits ? kMostCopies : 1);
  const std::size_t size =
      std::size_t{rows} * static_cast<std::size_t>(run_.planes.count());
  if (out.values.size() < size) out.values.resize(size);
  // A sample that has not split leaves the rows of its further copies alone.
  if (splits) std::fill_n(out.values.begin(), size, 0.0f);
  Wave& wave = space.wavefront.wave();
  wave.rays_closest = wave.rays_shadow = 0;
  wave.health = {};
  const bool ended =
      Drive(space.wavefront, plan_, work, {out.values.data(), rows}, clock, &watcher);
  if (ended) {
    taken_ += stride;
    out.counts = {stride, wave.rays_closest, wave.rays_shadow, wave.health};
  } else {
    out.count = 0;
  }
  if (ended && splits) {
    FoldCopies(out.values.data(), rows, run_.planes);
    if (clock) clock->FinishPart(TaskPart::kCopies, stride);
  }
  if (ended && seen_lights_) SeeLights(tile, work, out, clock);
  if (clock) clock->EndTask();
  return ended;
}

void Tasks::SeeLights(std::size_t tile, const TileWork& work, TaskSamples& out,
                      StageClock* clock) {
  const SeenLightTask task = {ThreadWorkspace().pixels, work.first_sample, work.samples,
                              out.values.data(),
                              std::size_t{work.num_pixels} * work.samples};
  const bool corrected = seen_lights_->Correct(tile, task, out.counts);
  if (clock && corrected) clock->FinishPart(TaskPart::kSeen, task.stride);
}

void Tasks::Merge(std::size_t tile, TaskSamples& task, Films& films) {
  const PixelRect place = Place(tile);
  // Row length behind the indices of the film's pixels.
  const int width = options_.windows.empty()
                        ? scene_.film.width
                        : place.width() * static_cast<int>(options_.windows.size());
  Workspace& space = ThreadWorkspace();
  StageClock* const clock = space.Clock();
  if (clock) clock->StartTask();
  TilePixels(place, width, &space.pixels);
  films.Add({place, space.pixels, width, task.values.data(), task.count});
  done_[tile] += task.count;
  {
    const std::lock_guard lock(counts_mutex_);
    counts_.Add(task.counts);
  }
  if (!clock) return;
  clock->FinishPart(TaskPart::kFilm, space.pixels.size() * task.count);
  clock->EndTask();
}

void Tasks::AddCounts(RunResult& result) {
  result.samples = counts_.samples;
  result.rays_closest = counts_.rays_closest;
  result.rays_shadow = counts_.rays_shadow;
  result.health = counts_.health;
  for (const auto& space : workspaces_) {
    if (space) lanelight::AddCounts(space->wavefront, space->Clock(), result);
  }
  for (const TaskSamples& buffer : buffers_) {
    result.wavefront_bytes += buffer.values.size() * sizeof(float);
  }
}

void RunCounts::Add(const RunCounts& more) {
  samples += more.samples;
  rays_closest += more.rays_closest;
  rays_shadow += more.rays_shadow;
  health.nan += more.health.nan;
  health.infinite += more.health.infinite;
  health.negative += more.health.negative;
  seconds += more.seconds;
  cpu_seconds += more.cpu_seconds;
}

}  // namespace lanelight
