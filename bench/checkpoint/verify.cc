#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "bench/checkpoint/cases.h"
#include "src/render/job/merge.h"
#include "src/render/job/report.h"
#include "src/vocabulary/path/run_parameters.h"

namespace lanelight::bench {
namespace {

constexpr std::uint64_t kSpp = 24;
constexpr std::array<int, 2> kSmall = {200, 120};

void Render(const Job& job, BenchFilm& out, Checkpointer* checkpointer,
            const std::vector<PixelRect>& tiles,
            const std::atomic<bool>* stop = nullptr) {
  RunOptions options = RunOptionsOf(job);
  options.checkpointer = checkpointer;
  options.tiles = tiles;
  options.stop = stop;
  Run(job.scene, job.plan, options, out.film);
}

void RenderPart(const Job& job, const CheckpointSettings& settings, BenchFilm& out) {
  Checkpoint checkpoint(job, settings, HeadOf(job), ThrowProblem);
  Render(job, out, &checkpoint, checkpoint.tiles());
  checkpoint.Finish();
  if (!checkpoint.kept()) throw std::runtime_error("the state was not kept");
}

void Expect(bool same, const char* what) {
  if (!same) throw std::runtime_error(std::string("WRONG: ") + what);
}

void VerifyResume(const CheckpointBench& bench, const Job& job, BenchFilm& whole) {
  CheckpointSettings settings;
  settings.path = bench.Path("verify.state");
  settings.seconds = 0.02;  // once, a moment after the beginning
  settings.resume = Resume::kIfAny;
  std::filesystem::remove(settings.path);
  {
    BenchFilm begun(job);
    std::atomic<bool> stop{false};
    Checkpoint checkpoint(job, settings, HeadOf(job), ThrowProblem);
    WatchedCheckpointer checkpointer(checkpoint, [&](RunState& state) {
      checkpoint.Save(state);
      stop = true;
    });
    Render(job, begun, &checkpointer, checkpoint.tiles(), &stop);
    checkpoint.Finish();
    Expect(!begun.SameAs(whole), "the render was not interrupted");
  }
  settings.seconds = 60;
  BenchFilm resumed(job);
  RenderPart(job, settings, resumed);
  std::filesystem::remove(settings.path);
  Expect(resumed.SameAs(whole), "the resumed film is not the uncut one");
}

void VerifyMerge(const CheckpointBench& bench, const Job& job, BenchFilm& whole) {
  std::vector<std::string> paths;
  for (int part = 1; part <= 3; ++part) {
    CheckpointSettings settings;
    settings.path = bench.Path(fmt::format("verify-{}.state", part));
    settings.part = {part, 3};
    std::filesystem::remove(settings.path);
    BenchFilm film(job);
    RenderPart(job, settings, film);
    paths.push_back(settings.path);
  }
  MergedRender merged = MergeStates(paths);
  for (const std::string& path : paths) std::filesystem::remove(path);
  BenchFilm film(job);
  film.film = std::move(*merged.film);
  Expect(merged.missing == 0 && film.SameAs(whole),
         "the merged film is not the uncut one");
}

}  // namespace

Job JobOf(const CheckpointBench& bench, std::array<int, 2> resolution,
          std::uint64_t spp) {
  RenderSettings settings;
  settings.spp = spp;
  settings.resolution = resolution;
  return PrepareJob(bench.scene, settings);
}

nlohmann::json HeadOf(const Job& job) { return HeadJson(job, "bench", false); }

void ThrowProblem(const std::string& problem) { throw std::runtime_error(problem); }

BenchFilm::BenchFilm(const Job& job) : film(MakeFilm(job)) {}

std::size_t BenchFilm::Bytes() {
  std::size_t bytes = 0;
  for (const MutableStateColumn& c : film.Columns()) bytes += c.Bytes();
  return bytes;
}

bool BenchFilm::SameAs(BenchFilm& other) {
  const auto a = film.Columns(), b = other.film.Columns();
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].Bytes() != b[i].Bytes()) return false;
    if (std::memcmp(a[i].data, b[i].data, a[i].Bytes()) != 0) return false;
  }
  return a.size() == b.size();
}

void VerifyResumeAndMerge(const CheckpointBench& bench) {
  const Job job = JobOf(bench, kSmall, kSpp);
  BenchFilm whole(job);
  Render(job, whole, nullptr, {});
  VerifyResume(bench, job, whole);
  VerifyMerge(bench, job, whole);
}

}  // namespace lanelight::bench
