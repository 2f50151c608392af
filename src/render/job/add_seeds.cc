#include "src/render/job/merge.h"

#include "src/base/core/check.h"
#include "src/base/core/error.h"
#include "src/base/core/parallel.h"
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

template <class T>
void AddColumn(const MutableStateColumn& sum, const MutableStateColumn& more) {
  T* const to = static_cast<T*>(sum.data);
  const T* const from = static_cast<const T*>(more.data);
  ParallelForRange(sum.rows * sum.ValuesPerRow(), 1 << 16,
                   [&](std::size_t begin, std::size_t end) {
                     for (std::size_t i = begin; i < end; ++i) to[i] += from[i];
                   });
}

}  // namespace

void AddSeed(MergedRender& sum, MergedRender& more) {
  if (sum.seeds.size() == 1) CheckWhole(sum);
  CheckWhole(more);
  const auto columns = sum.film->Columns(), others = more.film->Columns();
  LL_CHECK_EQ(columns.size(), others.size());
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].name == "weights") continue;  // each had its own
    columns[i].type == StateType::kUint64
        ? AddColumn<std::uint64_t>(columns[i], others[i])
        : AddColumn<double>(columns[i], others[i]);
  }
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
