#include "src/render/job/profile_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "src/base/core/json_text.h"

namespace lanelight {
namespace {

// Returns the stages and parts by TraceEvent::row.
std::vector<const StageProfile*> TraceRows(const RunResult& result) {
  std::vector<const StageProfile*> rows;
  for (const StageProfile& s : result.stages) rows.push_back(&s);
  for (const StageProfile& p : result.parts) rows.push_back(&p);
  return rows;
}

std::string Metadata(const char* what, std::size_t thread, const std::string& name) {
  return fmt::format(R"({{"name":"{}","ph":"M","pid":1,"tid":{},"args":{{"name":{}}}}})",
                     what, thread, DumpJson(name));
}

class Writer {
 public:
  Writer(const RunResult& result, int lanes)
      : trace_(result.trace), rows_(TraceRows(result)), lanes_(lanes) {}

  void Line(const std::string& line) {
    text_ += first_ ? "[\n" : ",\n";
    first_ = false;
    text_ += line;
  }

  void Thread(std::size_t thread) {
    const ThreadTrace& t = trace_.threads[thread];
    for (const TraceEvent& e : t.events) {
      const double begin = Microseconds(e.begin);
      const StageProfile& row = *rows_[e.row];
      Line(
          fmt::format(R"({{"name":"{}","cat":"{}","ph":"X","pid":1,"tid":{},"ts":{:.3f},)"
                      R"("dur":{:.3f},"args":{{"items":{}}}}})",
                      row.name, row.role ? "stage" : "task", thread, begin,
                      Microseconds(e.end) - begin, e.items));
      Counters(e, thread);
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
  // Values of counter tracks. Viewers show one track per name and argument.
  void Counters(const TraceEvent& e, std::size_t thread) {
    const StageProfile& stage = *rows_[e.row];
    const bool ray =
        stage.role == StageRole::kIntersect || stage.role == StageRole::kShadow;
    if (!(ray || stage.role == StageRole::kShade) || e.vectors == 0) return;
    const auto line = [&](const char* what, double value) {
      Line(fmt::format(R"({{"name":"{}, thread {}","ph":"C","pid":1,"ts":{:.3f},)"
                       R"("args":{{"{}":{:.6g}}}}})",
                       what, thread, Microseconds(e.begin), stage.name, value));
    };
    line("queue length", e.items);
    line("lanes filled, percent", 100.0 * e.items / (double(e.vectors) * lanes_));
    if (ray)
      line("million rays per second",
           e.items / std::max(1e-3, Microseconds(e.end) - Microseconds(e.begin)));
  }

  // Rounded to what is printed, so that an event ends where the next one begins.
  double Microseconds(std::uint64_t ticks) const {
    const double seconds = double(ticks - trace_.start) * trace_.seconds_per_tick;
    return std::round(seconds * 1e9) * 1e-3;
  }

  const RunTrace& trace_;
  const std::vector<const StageProfile*> rows_;
  int lanes_;
  std::string text_;
  bool first_ = true;
};

}  // namespace

std::string TraceText(const RunResult& result, int lanes, const std::string& process) {
  Writer writer(result, lanes);
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
