#include "src/render/job/profile_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "src/base/core/json_text.h"

namespace lanelight {
namespace {

// What TraceEvent::row stands for.
struct Rows {
  std::vector<const StageProfile*> all;
  std::vector<bool> starts_wave;  // the first stage that intersects, of each phase

  explicit Rows(const RunResult& result) {
    bool started = false;
    for (const StageProfile& s : result.stages) {
      all.push_back(&s);
      if (s.role == StageRole::kCamera) started = false;
      const bool starts = !started && s.role == StageRole::kIntersect;
      starts_wave.push_back(starts);
      started |= starts;
    }
    for (const StageProfile& p : result.parts) all.push_back(&p);
  }
  bool IsStage(std::size_t row) const { return row < starts_wave.size(); }
};

// What counter tracks show of one wave: from its first intersect stage to the next one.
struct WaveCounts {
  std::uint64_t intersect = 0, shade = 0, shadow = 0;  // paths in queues
  std::uint64_t items = 0, vectors = 0;

  // Several stages may intersect the same rays, each with shapes of another kind.
  void Add(const StageProfile& stage, const TraceEvent& e) {
    if (stage.role == StageRole::kIntersect)
      intersect = std::max<std::uint64_t>(intersect, e.items);
    if (stage.role == StageRole::kShadow)
      shadow = std::max<std::uint64_t>(shadow, e.items);
    if (!stage.material.empty()) shade += e.items;
    items += e.items;
    vectors += e.vectors;
  }
};

std::string Metadata(const char* what, std::size_t thread, const std::string& name) {
  return fmt::format(R"({{"name":"{}","ph":"M","pid":1,"tid":{},"args":{{"name":{}}}}})",
                     what, thread, DumpJson(name));
}

class Writer {
 public:
  Writer(const RunTrace& trace, const Rows& rows, int lanes)
      : trace_(trace), rows_(rows), lanes_(lanes) {}

  void Line(const std::string& line) {
    text_ += first_ ? "[\n" : ",\n";
    first_ = false;
    text_ += line;
  }

  void Thread(std::size_t thread) {
    const ThreadTrace& t = trace_.threads[thread];
    std::optional<WaveCounts> wave;
    double start = 0;
    for (const TraceEvent& e : t.events) {
      const double begin = Microseconds(e.begin);
      const bool stage = rows_.IsStage(e.row);
      if (!stage || rows_.starts_wave[e.row]) {
        if (wave) Counters(thread, start, begin, *wave);
        wave.reset();
        if (stage) wave.emplace();
        start = begin;
      }
      if (wave) wave->Add(*rows_.all[e.row], e);
      Line(
          fmt::format(R"({{"name":"{}","cat":"{}","ph":"X","pid":1,"tid":{},"ts":{:.3f},)"
                      R"("dur":{:.3f},"args":{{"items":{}}}}})",
                      rows_.all[e.row]->name, stage ? "stage" : "task", thread, begin,
                      Microseconds(e.end) - begin, e.items));
    }
    if (t.dropped == 0) return;
    const double end = t.events.empty() ? 0 : Microseconds(t.events.back().end);
    Line(fmt::format(
        R"({{"name":"the buffer is full: {0} later events are missing","ph":"i",)"
        R"("s":"t",)"
        R"("pid":1,"tid":{1},"ts":{2:.3f},"args":{{"dropped":{0}}}}})",
        t.dropped, thread, end));
  }

  std::string Finish() {
    text_ += "\n]\n";
    return std::move(text_);
  }

 private:
  void Counters(std::size_t thread, double begin, double end, const WaveCounts& wave) {
    const auto line = [&](const char* what, const std::string& values) {
      Line(fmt::format(R"({{"name":"{}, thread {}","ph":"C","pid":1,"ts":{:.3f},)"
                       R"("args":{{{}}}}})",
                       what, thread, begin, values));
    };
    line("queues", fmt::format(R"("intersect":{},"shade":{},"shadow":{})", wave.intersect,
                               wave.shade, wave.shadow));
    if (wave.vectors > 0) {
      line("lanes filled",
           fmt::format(R"("percent":{:.1f})",
                       100.0 * double(wave.items) / (double(wave.vectors) * lanes_)));
    }
    if (end <= begin) return;
    line("rays per second",
         fmt::format(R"("millions":{:.2f})",
                     double(wave.intersect + wave.shadow) / (end - begin)));
  }

  // Rounded to what is printed, so that an event ends where the next one begins.
  double Microseconds(std::uint64_t ticks) const {
    const double seconds = double(ticks - trace_.start) * trace_.seconds_per_tick;
    return std::round(seconds * 1e9) * 1e-3;
  }

  const RunTrace& trace_;
  const Rows& rows_;
  int lanes_;
  std::string text_;
  bool first_ = true;
};

}  // namespace

std::string TraceText(const RunResult& result, int lanes, const std::string& process) {
  const Rows rows(result);
  Writer writer(result.trace, rows, lanes);
  writer.Line(Metadata("process_name", 0, process));
  for (std::size_t i = 0; i < result.trace.threads.size(); ++i) {
    writer.Line(Metadata("thread_name", i, fmt::format("thread {}", i)));
  }
  for (std::size_t i = 0; i < result.trace.threads.size(); ++i) writer.Thread(i);
  return writer.Finish();
}

std::uint64_t DroppedEvents(const RunTrace& trace) {
  std::uint64_t dropped = 0;
  for (const ThreadTrace& t : trace.threads) dropped += t.dropped;
  return dropped;
}

}  // namespace lanelight
