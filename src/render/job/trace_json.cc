#include "src/render/job/profile_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "src/base/core/json_text.h"

namespace lanelight {
namespace {

// Names and categories of TraceEvent::row.
struct RowNames {
  std::vector<std::string> names;
  std::size_t stages = 0;

  explicit RowNames(const RunResult& result) : stages(result.stages.size()) {
    for (const StageProfile& s : result.stages) names.push_back(s.name);
    for (const StageProfile& p : result.parts) names.push_back(p.name);
  }
  const char* Category(std::size_t row) const { return row < stages ? "stage" : "task"; }
};

std::string Metadata(const char* what, std::size_t thread, const std::string& name) {
  return fmt::format(R"({{"name":"{}","ph":"M","pid":1,"tid":{},"args":{{"name":{}}}}})",
                     what, thread, DumpJson(name));
}

class Writer {
 public:
  Writer(const RunTrace& trace, const RowNames& rows) : trace_(trace), rows_(rows) {}

  void Line(const std::string& line) {
    text_ += first_ ? "[\n" : ",\n";
    first_ = false;
    text_ += line;
  }

  void Thread(std::size_t thread) {
    const ThreadTrace& t = trace_.threads[thread];
    for (const TraceEvent& e : t.events) {
      const double begin = Microseconds(e.begin);
      Line(
          fmt::format(R"({{"name":"{}","cat":"{}","ph":"X","pid":1,"tid":{},"ts":{:.3f},)"
                      R"("dur":{:.3f},"args":{{"items":{}}}}})",
                      rows_.names[e.row], rows_.Category(e.row), thread, begin,
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
  // Rounded to what is printed, so that an event ends where the next one begins.
  double Microseconds(std::uint64_t ticks) const {
    const double seconds = double(ticks - trace_.start) * trace_.seconds_per_tick;
    return std::round(seconds * 1e9) * 1e-3;
  }

  const RunTrace& trace_;
  const RowNames& rows_;
  std::string text_;
  bool first_ = true;
};

}  // namespace

std::string TraceText(const RunResult& result, const std::string& process) {
  const RowNames rows(result);
  Writer writer(result.trace, rows);
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
