#include "bench/intersect/results.h"

#include <fmt/format.h>

#include <cstdio>
#include <fstream>

namespace lanelight::bench {
namespace {

std::string BestText(const SetResult& r, const std::optional<std::size_t>& best) {
  if (!best) return "";
  const EntryResult& e = r.entries[*best];
  return fmt::format("{:>17} {:7.2f} {:5.2f} [{:4.2f},{:5.2f}]", e.entry.name, e.mrays,
                     e.ratio.median, e.ratio.low, e.ratio.high);
}

const char* BestMark(const SetResult& r, std::size_t e) {
  if (r.best == e) return "best";
  return r.best_robust == e ? "best robust" : "";
}

nlohmann::json AgreementJson(const Agreement& a) {
  return {{"sample", a.sample},
          {"wrong_of_sample", a.wrong},
          {"differ_per_million", a.differ},
          {"ties_per_million", a.ties},
          {"differ_robust_per_million", a.differ_robust},
          {"ties_robust_per_million", a.ties_robust}};
}

nlohmann::json EntryJson(const SetResult& r, std::size_t e) {
  const EntryResult& entry = r.entries[e];
  nlohmann::json out = {{"name", entry.entry.name},
                        {"robust", entry.entry.robust},
                        {"repetitions", entry.repetitions},
                        {"mrays", entry.mrays},
                        {"best", BestMark(r, e)}};
  if (entry.ratio.median > 0) {
    out["ratio"] = {{"median", entry.ratio.median},
                    {"least", entry.ratio.low},
                    {"largest", entry.ratio.high}};
  }
  return out;
}

}  // namespace

void PrintSetHeader() {
  fmt::print(
      "{:12} {:8} {:>7} {:>7} {:>17} {:>7} {:>5} {:>12} {:>18} {:>7} {:>5} {:>12} "
      "{:>9} {}\n",
      "mesh", "rays", "count", "ours", "best entry", "Mray/s", "ratio", "", "best robust",
      "Mray/s", "ratio", "", "wrong", "differ/1e6 (ties), robust");
}

void PrintSet(const SetResult& r) {
  const Agreement& a = r.agreement;
  fmt::print("{:12} {:8} {:7} {:7.2f} {} {} {:>9}", r.mesh, r.set, r.rays, r.ours,
             BestText(r, r.best), BestText(r, r.best_robust),
             fmt::format("{}/{}", a.wrong, a.sample));
  if (!r.entries.empty()) {
    fmt::print(" {:.0f} ({:.0f}), {:.0f} ({:.0f})", a.differ, a.ties, a.differ_robust,
               a.ties_robust);
  }
  fmt::print("\n");
  std::fflush(stdout);
}

void WriteSetsCsv(const std::string& path, const std::string& target,
                  const std::vector<SetResult>& results) {
  std::ofstream out(path);
  out << "target,mesh,triangles,set,rays,ours_mrays,entry,robust,best,repetitions,mrays,"
         "ratio,ratio_least,ratio_largest\n";
  for (const SetResult& r : results) {
    const std::string start = fmt::format("{},{},{},{},{},{:.4g}", target, r.mesh,
                                          r.triangles, r.set, r.rays, r.ours);
    if (r.entries.empty()) out << start << ",,,,,,,,\n";
    for (std::size_t e = 0; e < r.entries.size(); ++e) {
      const EntryResult& entry = r.entries[e];
      out << fmt::format("{},{},{},{},{},{:.4g},", start, entry.entry.name,
                         int(entry.entry.robust), BestMark(r, e), entry.repetitions,
                         entry.mrays);
      if (entry.ratio.median > 0) {
        out << fmt::format("{:.4g},{:.4g},{:.4g}\n", entry.ratio.median, entry.ratio.low,
                           entry.ratio.high);
      } else {
        out << ",,\n";
      }
    }
  }
}

nlohmann::json SetsJson(const std::vector<SetResult>& results) {
  nlohmann::json out = nlohmann::json::array();
  for (const SetResult& r : results) {
    nlohmann::json entries = nlohmann::json::array();
    for (std::size_t e = 0; e < r.entries.size(); ++e) entries.push_back(EntryJson(r, e));
    out.push_back({{"mesh", r.mesh},
                   {"triangles", r.triangles},
                   {"set", r.set},
                   {"rays", r.rays},
                   {"ours_mrays", r.ours},
                   {"agreement", AgreementJson(r.agreement)},
                   {"entries", entries}});
  }
  return out;
}

void AddBuilds(const std::vector<BuildResult>& builds,
               const std::vector<ThreadsResult>& threads, nlohmann::json& out) {
  for (const BuildResult& r : builds) {
    out["builds"].push_back({{"mesh", r.mesh},
                             {"build", r.name},
                             {"triangles", r.triangles},
                             {"cpu_seconds", r.cpu},
                             {"wall_seconds_1", r.wall_one},
                             {"wall_seconds_2", r.wall_two},
                             {"bytes_per_triangle", r.bytes},
                             {"peak_bytes_per_triangle", r.peak}});
  }
  for (const ThreadsResult& r : threads) {
    out["threads"].push_back({{"mesh", r.mesh},
                              {"set", r.set},
                              {"mrays_1", r.one},
                              {"scaling_2", r.scaling.median},
                              {"least", r.scaling.low},
                              {"largest", r.scaling.high}});
  }
}

}  // namespace lanelight::bench
