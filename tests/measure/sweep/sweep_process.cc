#include "tests/measure/sweep/sweep_process.h"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "tests/measure/study/study_file.h"

namespace lanelight::sweep_process {

ProcessResult Sweep(const std::string& file, const std::string& out,
                    std::vector<std::string> more, const ProcessOptions& options) {
  std::vector<std::string> arguments = {"sweep", file, "--out", out};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return RunLanelight(arguments, options);
}

int RenderedBy(const ProcessResult& r) {
  const std::size_t at = r.out.find("are done, ");
  return at == std::string::npos ? -1 : std::atoi(r.out.c_str() + at + 10);
}

std::string Contents(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

void Replace(const std::string& path, const std::string& from, const std::string& to) {
  std::string text = Contents(path);
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  WriteText(path, text.replace(at, from.size(), to));
}

std::vector<std::vector<std::string>> CsvRows(const std::string& path) {
  std::vector<std::vector<std::string>> rows(1, {""});
  bool quoted = false;
  for (const char c : Contents(path)) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      rows.back().emplace_back();
    } else if (c == '\n' && !quoted) {
      rows.push_back({""});
    } else {
      rows.back().back() += c;
    }
  }
  rows.pop_back();
  return rows;
}

std::string TableWithoutTimes(const std::string& path) {
  const auto rows = CsvRows(path);
  std::string text;
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string& name = rows[0].at(i);
      const bool time = (name.find("_second") != std::string::npos && name[0] != 't') ||
                        name == "wavefront_bytes" ||  // of the threads that took part
                        name == "machine_load";
      text += (time ? "" : row[i]) + ",";
    }
    text += "\n";
  }
  return text;
}

}  // namespace lanelight::sweep_process
