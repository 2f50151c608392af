#include "src/measure/sweep/cell_render.h"

#include <algorithm>

#include "kernels/simd/target.h"
#include "src/render/job/loaded_scene.h"
#include "src/render/job/memory.h"
#include "src/scene/compile/compile.h"
#include "src/vocabulary/strategy/strategy_text.h"

namespace lanelight {
namespace {

// What a scene is compiled for: threads and target matter to its time.
constexpr Axis kCompiled[] = {Axis::kScene, Axis::kResolution, Axis::kMaxDepth,
                              Axis::kBuild, Axis::kTarget,     Axis::kThreads};

// Cells that differ here have other trees, or may have; they are not kept for them.
std::string TreeKeyOf(const AxisValues& values) {
  return Get(values, Axis::kScene).value_or("") + "\n" +
         Get(values, Axis::kBuild).value_or("");
}

}  // namespace

std::string CellRenderer::SceneKey(const SweepCell& cell) const {
  std::string key;
  for (const Axis axis : kCompiled) key += Get(cell.values, axis).value_or("") + "\n";
  return key;
}

bool CellRenderer::HasTarget(const SweepCell& cell) {
  const auto& target = Get(cell.values, Axis::kTarget);
  if (!target) return true;
  const std::vector<std::string> available = AvailableTargets();
  return std::find(available.begin(), available.end(), *target) != available.end();
}

// Leaves no job, and failure_, if that is not possible.
void CellRenderer::Compile(const SweepCell& cell, RenderSettings settings) {
  const std::string trees = TreeKeyOf(cell.values);
  if (job_ && trees == tree_key_) settings.known_tree = TreesOf(*job_->scene.compiled);
  tree_key_ = trees;
  job_.reset();  // before there is another in memory
  failure_.clear();
  settings.seed.reset();  // that of one cell is not that of the next
  for (const auto& [name, places] : sweep_.places) {
    settings.compared.push_back(StrategyNamed(name, {}, {}));
  }
  try {
    Job job = PrepareJob(sweep_.ScenePath(cell), settings);
    CheckOutputPaths(outputs_, job.loaded->files);
    job_ = std::move(job);
  } catch (const WouldOverwrite&) {
    throw;
  } catch (const InputError& error) {
    failure_ = error.what();
  }
}

Job CellRenderer::Prepare(const SweepCell& cell) {
  RenderSettings settings = sweep_.settings.render;
  ApplyValues(cell.values, settings);
  if (const std::string key = SceneKey(cell); key != key_) {
    key_ = key;
    Compile(cell, settings);
  }
  // All cells of a broken scene fail, and only the first one takes the time.
  if (!job_) throw std::runtime_error(failure_);
  const Strategy strategy =
      StrategyNamed(Get(cell.values, Axis::kStrategy).value_or(kSceneStrategyName), {},
                    job_->scene.strategy);
  CheckFilmFits(job_->window, LayersOf(settings, job_->loaded->description.film),
                strategy, PhysicalMemory());
  return WithStrategy(WithAmount(*job_, settings), strategy);
}

Rendering CellRenderer::Render(const SweepCell& cell, const std::string& folder,
                               const RenderHooks& hooks) {
  const Job job = Prepare(cell);
  RenderTargets targets;
  targets.image = sweep_.settings.render.image;
  targets.exr = folder + "/image.exr";
  if (targets.image.png) targets.png = folder + "/image.png";
  targets.json = "-";
  targets.checkpoint.path = folder + "/state";
  targets.checkpoint.resume = Resume::kIfAny;
  targets.checkpoint.finished = false;
  return RenderToFiles(job, sweep_.ScenePath(cell), targets, hooks);
}

}  // namespace lanelight
