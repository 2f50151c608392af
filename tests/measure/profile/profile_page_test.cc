// The page of a profile: what it holds besides the JSON.
#include "src/measure/profile/profile_page.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "src/render/job/profile_report.h"

namespace lanelight::test {
namespace {

using Json = nlohmann::json;

struct MeasuredProfile {
  Job job;
  FilmAccumulator film;
  std::vector<TaskCost> tasks;
  std::vector<RunResult> results;
  Json json;
};

MeasuredProfile Measured(int repeats) {
  RenderSettings settings;
  settings.spp = 4;
  settings.resolution = {128, 96};
  settings.threads = 1;
  Job job = PrepareJob(LANELIGHT_SOURCE_DIR "/scenes/cornell-box.pbrt", settings);
  MeasuredProfile out = {job, MakeFilm(job), {}, {}, {}};
  for (int i = 0; i < repeats; ++i) {
    RunOptions options = RunOptionsOf(job);
    options.profiling = {true, true, 10000};
    FilmAccumulator film = MakeFilm(job);
    if (i == 0) {
      options.on_task = [&](const PixelRect& tile, const RunCounts& counts) {
        out.tasks.push_back({tile, double(counts.samples), counts.cpu_seconds});
      };
    }
    out.results.push_back(Run(job.scene, job.plan, options, i == 0 ? out.film : film));
  }
  const Peaks peaks = MeasurePeaks(job.plan.options.target, false);
  out.json = ToJson(MakeProfileReport(out.results, peaks), job, out.results[0]);
  return out;
}

// The earlier profile: the largest stage was faster.
ProfileComparison SlowerIn(const Json& profile) {
  Json before = profile, now = profile;
  now["busy"] = before["busy"] = Json::array();
  for (Json& ns : before["rows"][0]["ns_per_sample_of_repeats"])
    ns = 0.5 * ns.get<double>();
  return CompareProfiles(before, now, 0.05);
}

}  // namespace

TEST_CASE("tasks of a profile have all its samples and most of its time", "[profile]") {
  const MeasuredProfile m = Measured(1);
  double samples = 0, seconds = 0;
  for (const TaskCost& task : m.tasks) samples += task.samples, seconds += task.seconds;
  CHECK(samples == double(m.results[0].samples));
  CHECK(seconds > 0.5 * m.results[0].cpu_seconds);
  CHECK(seconds <= 1.01 * m.results[0].cpu_seconds);
}

TEST_CASE("The page of a profile can be written", "[profile][report]") {
  const MeasuredProfile m = Measured(6);
  const ProfileComparison comparison = SlowerIn(m.json);
  const std::string page =
      ProfilePage(m.json, {"box.pbrt", "An answer.", m.tasks, m.film, m.results[0],
                           "old.json", comparison, VerdictText(comparison, 0.05)});
  const std::string begin = "id=\"study\">";
  const std::size_t from = page.find(begin) + begin.size();
  const Json data = Json::parse(page.substr(from, page.find("</script", from) - from));
  CHECK(data.at("page").at("answer") == "An answer.");
  CHECK(data.at("page").at("changes").size() == comparison.changes.size());
  const Json& queues = data.at("page").at("queues");
  REQUIRE(queues.at("lines").size() == 6);
  // Calls may find no path for them; on a busy machine any stage may be among the lines.
  for (const Json& line : queues.at("lines")) {
    double most = 0;
    for (const Json& paths : line.at("paths")) {
      if (!paths.is_null()) most = std::max(most, paths.get<double>());
    }
    INFO(line.at("name"));
    CHECK(most > 0);
    CHECK(most <= m.job.plan.wavefront);
  }
  for (const char* name : {"\"image\"", "\"cost\""}) {
    INFO(name);
    CHECK(page.find(name) != std::string::npos);
  }
  const char* path = std::getenv("LANELIGHT_SYNTHETIC_PROFILE");
  if (path == nullptr) return;
  std::ofstream file(path, std::ios::binary);
  file << page;
  REQUIRE(file.flush().good());
}

}  // namespace lanelight::test
