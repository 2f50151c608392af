#include "src/sweep/cell_job.h"

#include <ctime>

namespace lanelight {
namespace {

double CpuSeconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace

void SetCell(Job& job, const CellSettings& cell) {
  job.spp = cell.spp;
  job.seconds = cell.seconds;
  job.target = cell.target;
  job.seed = cell.seed;
  SetStrategy(job, cell.strategy);
}

CellRun RunCell(const Job& job, const std::function<void(const Progress&)>& on_progress,
                const std::atomic<bool>* stop) {
  CellRun run = {MakeFilm(job), {}};
  const double start = CpuSeconds();
  run.result = RunJob(job, run.film, on_progress, stop);
  run.cpu_seconds = CpuSeconds() - start;
  return run;
}

}  // namespace lanelight
