#include "src/measure/sweep/sweep_folder.h"

#include <filesystem>
#include <set>

#include "src/base/core/input_file.h"
#include "src/base/core/json_text.h"
#include "src/base/core/suggest.h"
#include "src/base/image/atomic_file.h"
#include "src/render/job/job.h"

namespace lanelight {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// A temporary file that tests whether the directory is writable.
constexpr char kProbe[] = "/cells/.probe";

void MakeDirectory(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw InputError("cannot make '" + path + "': " + error.message());
}

std::string TextOr(const Json& json, const std::string& key) {
  const auto found = json.find(key);
  return found == json.end() ? "not set" : Quoted(found->get<std::string>());
}

// Returns e.g. "crop is "0,0,8,8" there and not set here; ...".
std::string Differences(const Json& there, const Json& here) {
  std::set<std::string> keys;
  for (const Json& side : {there, here}) {
    for (const auto& [key, unused] : side.items()) keys.insert(key);
  }
  std::string text;
  for (const std::string& key : keys) {
    const std::string a = TextOr(there, key), b = TextOr(here, key);
    if (a == b) continue;
    text += fmt::format("{}{} was {} and is now {}", text.empty() ? "" : "; ", key, a, b);
  }
  return text;
}

}  // namespace

const char* Name(CellState state) {
  constexpr const char* kNames[] = {"missing", "failed", "done", "stopped"};
  return kNames[int(state)];
}

SweepFolder::SweepFolder(std::string path, const Sweep& sweep)
    : path_(std::move(path)), sweep_(sweep) {}

std::string SweepFolder::File(const SweepCell& cell, const std::string& name) const {
  return path_ + "/cells/" + cell.name + "/" + name;
}

void SweepFolder::Make() const {
  MakeDirectory(path_ + "/cells");
  RemoveTemporaries(path_ + kProbe);
  CheckWritable();
  std::set<std::string> scenes;
  for (const SweepCell& cell : sweep_.cells) scenes.insert(sweep_.ScenePath(cell));
  CheckOutputPaths(Outputs(), scenes);
  WriteFileAtomically(File("sweep.toml"), sweep_.text);
}

OutputPaths SweepFolder::Outputs() const {
  return {{File("sweep.csv"), File("sweep.json"), File("report.html")}, {File("cells")}};
}

void SweepFolder::CheckWritable() const { lanelight::CheckWritable(path_ + kProbe); }

CellRecord SweepFolder::ReadCell(const SweepCell& cell) {
  CellRecord record;
  const std::string path = File(cell, "report.json");
  std::error_code error;
  const bool report = fs::exists(path, error);
  if (report && fs::exists(File(cell, "image.exr"), error)) {
    try {
      record.report = ParseJson(ReadWholeFile(path));
      CheckReport(cell, record.report);
    } catch (const Json::exception& problem) {
      throw InputError(
          "'{}' is not a report of a sweep ({}); remove it to "
          "render the cell again",
          path, JsonProblem(problem));
    }
    record.state = CellState::kDone;
  } else if (fs::exists(File(cell, "error.json"), error)) {
    record.state = CellState::kFailed;
    try {
      record.message = ParseJson(ReadWholeFile(File(cell, "error.json"))).at("message");
    } catch (const Json::exception&) {
      record.message = "";  // unreadable; the cell is rendered again
    }
  }
  return record;
}

void SweepFolder::CheckReport(const SweepCell& cell, const Json& report) {
  const Json& of = report.at("sweep");
  Json there = of.at("settings"), here = sweep_.settings.texts;
  there.update(of.at("values"));
  here.update(Json(ByKey(cell.values)));
  there["hash of the scene's files"] = report.at("scene_hash");
  here["hash of the scene's files"] = SceneHash(cell);
  const std::string differences = Differences(there, here);
  if (differences.empty()) return;
  throw InputError(
      "'{}' was rendered with other settings: {}; use another --out, or remove "
      "that directory to render the cell again",
      path_ + "/cells/" + cell.name, differences);
}

std::string SweepFolder::SceneHash(const SweepCell& cell) {
  const std::lock_guard lock(mutex_);
  const std::string path = sweep_.ScenePath(cell);
  const auto [entry, is_new] = scene_hashes_.try_emplace(path);
  if (is_new) entry->second = fmt::format("{:016x}", HashSceneFiles(path));
  return entry->second;
}

void SweepFolder::MakeCell(const SweepCell& cell) const {
  const std::string path = path_ + "/cells/" + cell.name;
  // Does not make parents: a removed directory of a sweep stays removed.
  std::error_code error;
  fs::create_directory(path, error);
  if (error) throw InputError("cannot make '" + path + "': " + error.message());
  for (const auto& entry : fs::directory_iterator(path, error)) {
    if (entry.path().extension() == ".tmp") fs::remove(entry.path(), error);
  }
}

void SweepFolder::Finish(const SweepCell& cell, Json report) const {
  report["sweep"]["name"] = cell.name;
  report["sweep"]["values"] = ByKey(cell.values);
  report["sweep"]["settings"] = sweep_.settings.texts;
  WriteFileAtomically(File(cell, "report.json"), DumpJson(report, 1) + "\n");
  std::error_code ignored;
  fs::remove(File(cell, "error.json"), ignored);
  fs::remove(File(cell, "state"), ignored);
}

void SweepFolder::Fail(const SweepCell& cell, const std::string& message) const {
  const Json json = {{"name", cell.name}, {"message", message}};
  WriteFileAtomically(File(cell, "error.json"), DumpJson(json, 1) + "\n");
}

void SweepFolder::RemoveImages(const SweepCell& cell) const {
  std::error_code ignored;
  for (const char* name :
       {"image.exr", "image.png", "image.partial.exr", "image.partial.png"}) {
    fs::remove(File(cell, name), ignored);
  }
}

std::vector<std::string> SweepFolder::OtherCells() const {
  std::set<std::string> known;
  for (const SweepCell& cell : sweep_.cells) known.insert(cell.name);
  std::vector<std::string> others;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(path_ + "/cells", error)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_directory() && known.count(name) == 0) others.push_back(name);
  }
  std::ranges::sort(others);
  return others;
}

}  // namespace lanelight
