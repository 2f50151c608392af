#include "src/render/job/merge.h"

#include "src/base/core/check.h"
#include "src/base/core/error.h"
#include "src/render/films/accumulator.h"

namespace lanelight {
namespace {

// Checks that the samples of each replicate or unit do not depend on the order of
// samples.
void CheckWhole(const MergedRender& render) {
  if (render.missing > 0) {
    throw InputError(fmt::format(
        "seed {} lacks {} pixels: only whole renders of different seeds can be added",
        render.seeds.front(), render.missing));
  }
  const SampleGroups& groups = render.film->groups();
  const std::uint64_t cycle = groups.unit * (groups.replicates ? kReplicates : 1);
  bool whole_cycles = true;
  for (const PixelRect& tile : render.tiles) {
    ForEachPixel(tile, [&](int x, int y) {
      whole_cycles = whole_cycles && render.film->Samples(x, y) % cycle == 0;
    });
  }
  if (render.minimum == render.maximum && whole_cycles) return;
  throw InputError(
      fmt::format("seed {} has {} to {} samples per pixel: renders of different seeds "
                  "can be added if all pixels have the same number, a multiple of {}",
                  render.seeds.front(), render.minimum, render.maximum, cycle));
}

}  // namespace

void AddSeed(MergedRender& sum, MergedRender& more) {
  if (sum.seeds.size() == 1) CheckWhole(sum);
  CheckWhole(more);
  const auto columns = sum.film->Columns(), others = more.film->Columns();
  LL_CHECK_EQ(columns.size(), others.size());
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].name == "weights") continue;  // each had its own
    AddColumn(columns[i], others[i]);
  }
  sum.film->AddShared(*more.film);
  sum.run.counts.Add(more.run.counts);
  for (const MachineInfo& machine : more.machines) AddMachine(machine, sum.machines);
  sum.seeds.push_back(more.seeds.front());
  sum.identity["seed"] = sum.seeds;
  sum.head["settings"]["seed"] = sum.seeds;
  sum.minimum += more.minimum;
  sum.maximum += more.maximum;
  sum.head["settings"]["spp"] = sum.minimum;
}

}  // namespace lanelight
