#include "src/measure/study/cell_store.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "src/base/core/check.h"
#include "src/base/core/error.h"
#include "src/base/core/hash.h"
#include "src/base/core/json_text.h"
#include "src/base/state/state_file.h"

namespace lanelight {

// What is kept of a stage.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(StageProfile, name, calls, items, lane_slots, seconds,
                                   bytes_per_item)

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr int kFormat = 2;  // of the files; another one is not read

Json IdentityOfCells(const std::string& strategy, std::uint64_t spp) {
  return {{"format", kFormat}, {"strategy", strategy}, {"spp", spp}};
}

std::string ReportOf(const Cells& cells) {
  Json json = {{"repetitions", Json::array()}, {"stages", cells.stages}};
  for (const Measurement& m : cells.repetitions) json["repetitions"].push_back(ToJson(m));
  return DumpJson(json);
}

void ReadReport(const Json& json, Cells& cells) {
  for (const Json& m : json.at("repetitions")) {
    cells.repetitions.push_back(MeasurementFromJson(m));
  }
  json.at("stages").get_to(cells.stages);
}

constexpr char kFirst[] = "first";

}  // namespace

CellStore::CellStore(std::string folder, const PixelRect& window)
    : folder_(std::move(folder)), window_(window) {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) throw InputError("cannot make '" + folder_ + "': " + error.message());
}

std::string CellStore::Path(const std::string& strategy, std::uint64_t spp) const {
  return fmt::format("{}/{:016x}-{}.cells", folder_, Hash64(strategy), spp);
}

Cells CellStore::Load(const std::string& strategy, std::uint64_t spp) const {
  Cells cells;
  cells.moments = Moments(window_.pixels());
  const std::string path = Path(strategy, spp);
  std::error_code error;
  if (!fs::exists(path, error)) return cells;
  try {
    const StateFile file(path);
    FromJsonOf(path, [&] {
      if (ParseJson(file.identity()) != IdentityOfCells(strategy, spp)) {
        throw InputError("'" + path + "' is of another strategy or version");
      }
      ReadReport(ParseJson(file.report()), cells);
    });
    if (file.window() != window_) {
      throw InputError("'" + path + "' is of an image of another size");
    }
    cells.first.resize(window_.pixels());
    file.ReadPixels({cells.moments.Restore(cells.repetitions.size()),
                     MakeStateColumn<double>(kFirst, "", cells.first)},
                    window_);
    return cells;
  } catch (const InputError& damage) {
    throw InputError(WithoutPrefix(damage) +
                     "; remove it, and its renders are done again");
  }
}

void CellStore::Save(const std::string& strategy, std::uint64_t spp,
                     const Cells& cells) const {
  LL_CHECK_EQ(cells.moments.count(), std::uint64_t{cells.repetitions.size()});
  StateContent content;
  content.identity = DumpJson(IdentityOfCells(strategy, spp));
  content.report = ReportOf(cells);
  content.window = window_;
  content.tiles = {window_};
  content.compress = false;  // after each of many short renders
  content.pixels = {
      cells.moments.Column(),
      MakeStateColumn<double>(kFirst, "the first render: R, G, B", cells.first)};
  WriteState(content, Path(strategy, spp));
}

}  // namespace lanelight
