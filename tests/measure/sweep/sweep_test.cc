// `lanelight sweep` from the outside: what it renders, and what it says about it.
#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "src/cli/exit_codes.h"
#include "tests/measure/sweep/sweep_folder.h"
#include "tests/measure/sweep/sweep_process.h"

namespace lanelight::sweep_process {
namespace {

using Catch::Contains;
namespace fs = std::filesystem;
using Json = nlohmann::json;

}  // namespace

TEST_CASE("sweep: a cell equals the render of its settings", "[sweep][cli]") {
  const TempDirectory directory;
  const std::string file = WriteSweep(directory), out = directory / "out";
  const ProcessResult r = Sweep(file, out, {"--threads"});
  CHECK(r.exit_code == kExitUsage);
  const ProcessResult all = Sweep(file, out);
  INFO(all.err);
  REQUIRE(all.exit_code == kExitGood);
  CHECK_THAT(all.out, Contains("22 of 22 cells are done, 22 of them by this process"));
  CHECK(DoneCells(out).size() == kSweepCells);
  CHECK(Rubbish(out).empty());
  CHECK(Contents(out + "/sweep.toml") == Contents(file));

  // One whose scene was compiled for another strategy and seed.
  const auto pixels = CellPixels(out);
  const auto cell = std::find_if(pixels.begin(), pixels.end(), [](const auto& entry) {
    return entry.first.find("other_48x36_points=independent_64spp_seed2-") == 0;
  });
  REQUIRE(cell != pixels.end());
  const ProcessResult render = RunLanelight(
      {"render", directory / "other.pbrt", "-o", directory / "one.exr", "--resolution",
       "48x36", "--spp", "64", "--seed", "2", "--strategy",
       ReadJson(out + "/cells/" + cell->first + "/report.json")["settings"]["strategy"]});
  INFO(render.err);
  REQUIRE(render.exit_code == kExitGood);
  const Image one = ReadExr(directory / "one.exr");
  CHECK(std::equal(one.pixels.begin(), one.pixels.end(), cell->second.begin(),
                   cell->second.end()));
  // And cells differ.
  std::set<std::vector<float>> different;
  for (const auto& [name, values] : pixels) different.insert(values);
  CHECK(different.size() == kSweepCells - 10);  // the two scenes are the same
}

TEST_CASE("sweep: a race stops a strategy that is clearly worse", "[sweep][cli]") {
  const TempDirectory directory;
  const std::string file =
      WriteText(directory / "race.toml",
                "[grid]\nscene = \"" LANELIGHT_SOURCE_DIR
                "/scenes/cornell-box.pbrt\"\n"
                "resolution = \"48x36\"\nspp = 32\nseed = [1, 2, 3, 4, 5, 6]\n"
                "strategy = [\"points=halton\", \"directions=bsdf\", \"reuse=block\"]\n");
  const std::string out = directory / "out";
  const ProcessResult race = Sweep(file, out, {"--race"});
  INFO(race.out << race.err);
  REQUIRE(race.exit_code == kExitGood);
  CHECK_THAT(race.out, Contains("reuse=block has") && Contains("stopped early"));
  CHECK_THAT(race.out, Contains("of 18 cells are done") && Contains("were not needed"));
  CHECK(DoneCells(out).size() < 18);
  CHECK_THAT(Contents(out + "/sweep.csv"), Contains(",stopped,"));
  // The others are rendered if they are asked for.
  const ProcessResult full = Sweep(file, out);
  CHECK_THAT(full.out,
             Contains("18 of 18 cells are done") && Contains("reuse=block has"));
  CHECK(DoneCells(out).size() == 18);
}

TEST_CASE("sweep: a budget is a time for each cell", "[sweep][cli]") {
  const TempDirectory directory;
  const std::string scene = WriteSphereScene(directory);
  const auto grid = [&](const std::string& more) {
    return WriteText(directory / "budget.toml",
                     "[grid]\nscene = \"sphere.pbrt\"\nresolution = \"32x24\"\n"
                     "seed = [1, 2, 3, 4]\n" +
                         more);
  };
  const std::string out = directory / "out";
  const ProcessResult run = Sweep(grid(""), out, {"--budget", "1.2"});
  INFO(run.out << run.err);
  REQUIRE(run.exit_code == kExitGood);
  CHECK_THAT(run.out,
             Contains("budget 1.2 s: 4 cells of") && Contains("4 of 4 cells are done"));
  const Json plan = ReadJson(out + "/budget.json");
  CHECK(plan["cells"] == 4);
  const double planned =
      4 * plan["cell_seconds"].get<double>() + plan["load_seconds"].get<double>();
  CHECK(planned == Approx(1.2 * 0.985));
  double rendered = 0;
  for (const std::string& cell : DoneCells(out)) {
    const Json report = ReadJson(out + "/cells/" + cell + "/report.json");
    CHECK(report["stop_reason"] == "time");
    rendered += report["seconds"]["render"].get<double>();
  }
  CHECK(rendered > 0.9 * 4 * plan["cell_seconds"].get<double>());
  // The plan stays; another one is refused.
  CHECK_THAT(Sweep(grid(""), out, {"--budget", "1.2"}).out, Contains("0 of them by"));
  CHECK_THAT(Sweep(grid(""), out, {"--budget", "1"}).err, Contains("use another --out"));
  // A larger one keeps the finished cells, and their time.
  const ProcessResult larger = Sweep(grid(""), out, {"--budget", "2.5"});
  CHECK_THAT(larger.out, Contains("0 of them by") && Contains("are left: add seeds"));
  CHECK(ReadJson(out + "/budget.json")["cell_seconds"] == plan["cell_seconds"]);
  CHECK(ReadJson(out + "/budget.json")["budget_seconds"] == 2.5);
  CHECK_THAT(Sweep(grid("spp = 4\n"), directory / "b", {"--budget", "2"}).err,
             Contains("remove spp from the grid"));
  CHECK_THAT(Sweep(grid(""), directory / "c", {"--budget", "0.1"}).err,
             Contains("too short"));
}

TEST_CASE("sweep: the table", "[sweep][cli]") {
  const TempDirectory directory;
  const std::string file = WriteSweep(directory), out = directory / "out";
  REQUIRE(Sweep(file, out).exit_code == kExitGood);
  const auto rows = CsvRows(out + "/sweep.csv");
  REQUIRE(rows.size() == kSweepCells + 1);
  std::map<std::string, std::size_t> column;
  for (std::size_t i = 0; i < rows[0].size(); ++i) column[rows[0][i]] = i;
  CHECK(column.size() == rows[0].size());
  for (std::size_t i = 1; i < rows.size(); ++i) {
    REQUIRE(rows[i].size() == rows[0].size());
    const auto& row = rows[i];
    CHECK(row[column.at("status")] == "done");
    const Json report =
        ReadJson(out + "/cells/" + row[column.at("cell")] + "/report.json");
    CHECK(row[column.at("samples")] == report["samples"].dump());
    CHECK(std::stod(row[column.at("samples")]) ==
          48 * 36 * std::stod(row[column.at("spp")]));
    CHECK(std::stod(row[column.at("render_seconds")]) == report["seconds"]["render"]);
    CHECK(std::stod(row[column.at("relmse_high")]) == report["error"]["relmse"]["high"]);
    CHECK(std::stod(row[column.at("relmse_low")]) <= std::stod(row[column.at("relmse")]));
    CHECK(row[column.at("machine_processor")] ==
          report["machine"].value("processor", Json()).get<std::string>());
    CHECK(row[column.at("machine_cores")] == report["machine"]["cores"].dump());
    CHECK(row[column.at("machine_memory_bytes")] ==
          report["machine"]["memory_bytes"].dump());
    CHECK(row[column.at("used_seed")] == row[column.at("seed")]);
    CHECK(row[column.at("time_seconds")].empty());
    CHECK(std::stod(row[column.at("stage_camera_perspective_cpu_seconds")]) > 0);
  }
}

TEST_CASE("sweep: a cell that fails does not stop the others", "[sweep][cli]") {
  const TempDirectory directory;
  WriteSphereScene(directory);
  WriteText(directory / "broken.pbrt", "WorldBegin\nShape \"sphear\"\n");
  const std::string file = WriteText(directory / "sweep.toml", R"([grid]
scene = ["broken.pbrt", "sphere.pbrt"]
spp = [1, 2]
)");
  const std::string out = directory / "out";
  const ProcessResult r = Sweep(file, out);
  CHECK(r.exit_code == kExitBadInput);
  CHECK(RenderedBy(r) == 2);
  CHECK_THAT(r.err, Contains("failed: broken_1spp") && Contains(" and 1 more: ") &&
                        Contains("broken.pbrt:2:7") && Contains("sphear"));
  CHECK_THAT(Contents(out + "/sweep.csv"), Contains(",failed,") && Contains("sphear"));
  // Tried again, and done now.
  WriteText(directory / "broken.pbrt", Contents(directory / "sphere.pbrt"));
  const ProcessResult again = Sweep(file, out);
  INFO(again.err);
  CHECK(again.exit_code == kExitGood);
  CHECK(RenderedBy(again) == 2);
  for (const std::string& name : DoneCells(out)) {
    CHECK_FALSE(fs::exists(out + "/cells/" + name + "/error.json"));
  }
}

TEST_CASE("sweep: cells of the same shapes share one BVH", "[sweep][cli]") {
  const TempDirectory directory;
  WriteSphereScene(directory);
  const std::string file = WriteText(directory / "sweep.toml", R"([grid]
scene = "sphere.pbrt"
resolution = ["16x12", "24x18"]
max-depth = [1, 2]
spp = 2
)");
  const std::string out = directory / "out";
  REQUIRE(Sweep(file, out).exit_code == kExitGood);
  std::map<std::string, int> origins;
  for (const std::string& name : DoneCells(out)) {
    const Json report = ReadJson(out + "/cells/" + name + "/report.json");
    CHECK(report["seconds"]["trees"] <= report["seconds"]["build"]);
    ++origins[report["trees"]["origin"]];
  }
  CHECK(origins == std::map<std::string, int>{{"built", 1}, {"shared", 3}});
}

TEST_CASE("sweep: a dry run predicts and renders nothing", "[sweep][cli]") {
  const TempDirectory directory;
  const std::string file = WriteSweep(directory), out = directory / "out";
  ProcessOptions options;
  options.temp_directory = directory.path();
  const auto files = directory.Files();
  const ProcessResult r = Sweep(file, out, {"--dry-run"}, options);
  INFO(r.out << r.err);
  CHECK(r.exit_code == kExitGood);
  CHECK_THAT(r.out, Contains("22 cells, 2 combinations excluded; 0 are done") &&
                        Contains("6 of 6 combinations") && Contains("the rest: "));
  CHECK(directory.Files() == files);
  const ProcessResult few = Sweep(file, out, {"--dry-run", "--pilots", "2"}, options);
  CHECK_THAT(few.out, Contains("2 of 6 combinations") && Contains("(~) are estimated"));
  const ProcessResult none = Sweep(file, out, {"--dry-run", "--pilots", "0"}, options);
  CHECK_THAT(none.out, !Contains("the rest: ") && Contains("22 cells"));
  REQUIRE(Sweep(file, out).exit_code == kExitGood);
  CHECK_THAT(Sweep(file, out, {"--dry-run"}).out, Contains("22 are done"));
}

TEST_CASE("sweep: a dry run renders with the films of its scenes", "[sweep][cli]") {
  for (const char* film : {"gbuffer", "spectral"}) {
    const TempDirectory directory;
    WriteText(directory / "s.pbrt",
              std::string("Camera \"perspective\"\nFilm \"") + film +
                  "\" \"integer xresolution\" 16 \"integer yresolution\" 16\n"
                  "WorldBegin\nLightSource \"infinite\"\nShape \"sphere\"\n");
    const std::string file = WriteText(directory / "sweep.toml",
                                       "[grid]\nscene = [\"s.pbrt\"]\nspp = [4, 16]\n");
    const ProcessResult r = Sweep(file, directory / "out", {"--dry-run"});
    INFO(r.out << r.err);
    CHECK(r.exit_code == kExitGood);
    CHECK_THAT(r.out, Contains("1 of 1 combinations") && !Contains("will fail"));
  }
}

}  // namespace lanelight::sweep_process
