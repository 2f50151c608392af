#include "src/measure/profile/profile_page.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "src/base/stat/values.h"
#include "src/measure/report/page.h"

namespace lanelight {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kBins = 120;           // of the time line
constexpr std::size_t kMaxLines = 6;         // that an eye can follow
constexpr std::size_t kMaxValues = 600'000;  // of both images

// Returns the mean number of paths of the calls that begin in each bin of time; null in
// bins without a call. Lines: the stages that take most of the time.
Json QueuesJson(const RunResult& result) {
  const RunTrace& trace = result.trace;
  std::vector<std::size_t> order(result.stages.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::sort(order, std::greater<>(),
                    [&](std::size_t i) { return result.stages[i].seconds; });
  order.resize(std::min(order.size(), kMaxLines));
  std::uint64_t begin = std::numeric_limits<std::uint64_t>::max(), end = 0;
  bool complete = true;
  for (const ThreadTrace& thread : trace.threads) {
    if (thread.events.empty()) continue;
    begin = std::min(begin, thread.events.front().begin);
    end = std::max(end, thread.events.back().begin);
    complete &= thread.dropped == 0;
  }
  if (end <= begin) return nullptr;
  struct Bin {
    double paths = 0, calls = 0;
  };
  std::vector<std::vector<Bin>> bins(result.stages.size(), std::vector<Bin>(kBins));
  for (const ThreadTrace& thread : trace.threads) {
    for (const TraceEvent& e : thread.events) {
      if (e.row >= bins.size()) continue;  // a part of a task
      const double place = double(e.begin - begin) / double(end - begin);
      Bin& bin = bins[e.row][std::min(kBins - 1, std::size_t(place * kBins))];
      bin.paths += e.items;
      bin.calls += 1;
    }
  }
  Json lines = Json::array();
  for (const std::size_t i : order) {
    Json paths = Json::array();
    for (const Bin& b : bins[i]) {
      paths.push_back(b.calls > 0 ? Json(b.paths / b.calls) : Json());
    }
    lines.push_back({{"name", result.stages[i].name}, {"paths", paths}});
  }
  return {{"seconds", double(end - begin) * trace.seconds_per_tick},
          {"complete", complete},
          {"lines", lines}};
}

// Returns the rendered image, and the processor time of each pixel in microseconds per
// sample, which is that of the tasks of its tile.
std::vector<ReportImage> Images(const ProfilePageInput& input) {
  const FilmAccumulator& film = input.film;
  const int width = film.width(), height = film.height();
  ReportImage image{"image", width, height, 3, {}}, cost{"cost", width, height, 1, {}};
  std::vector<double> seconds(std::size_t(width) * std::size_t(height)),
      samples(seconds.size());
  for (const TaskCost& task : input.tasks) {
    const double pixels = double(task.tile.pixels());
    for (int y = task.tile.y0 - film.y0(); y < task.tile.y1 - film.y0(); ++y) {
      for (int x = task.tile.x0 - film.x0(); x < task.tile.x1 - film.x0(); ++x) {
        const std::size_t i = std::size_t(y) * std::size_t(width) + std::size_t(x);
        seconds[i] += task.seconds / pixels;
        samples[i] += task.samples / pixels;
      }
    }
  }
  for (std::size_t i = 0; i < seconds.size(); ++i) {
    cost.values.push_back(float(1e6 * seconds[i] / samples[i]));
  }
  for (int y = film.y0(); y < film.y0() + height; ++y) {
    for (int x = film.x0(); x < film.x0() + width; ++x) {
      const Rgb mean = film.Mean(x, y);
      for (int c = 0; c < 3; ++c) image.values.push_back(float(mean[c]));
    }
  }
  std::vector<ReportImage> images = {std::move(image), std::move(cost)};
  ShrinkImages(images, kMaxValues);
  return images;
}

Json ChangesJson(const ProfileComparison& comparison) {
  Json changes = Json::array();
  for (const StageChange& c : comparison.changes) {
    changes.push_back({{"name", c.name},
                       {"before", c.before},
                       {"now", c.now},
                       {"difference", IntervalJson(c.difference)},
                       {"slower", c.slower}});
  }
  return changes;
}

}  // namespace

std::string ProfilePage(Json profile, const ProfilePageInput& input) {
  profile["page"] = {{"scene", input.scene},
                     {"answer", input.answer},
                     {"queues", QueuesJson(input.result)},
                     {"against", input.against},
                     {"changes", ChangesJson(input.comparison)},
                     {"verdict", input.verdict}};
  return ReportPage(PageKind::kProfile, profile, Images(input));
}

}  // namespace lanelight
