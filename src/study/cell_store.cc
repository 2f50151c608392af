#include "src/core/input_file.h"
#include "src/study/cell_store.h"

#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "src/core/check.h"
#include "src/core/error.h"
#include "src/core/hash.h"
#include "src/core/json_text.h"
#include "src/image/atomic_file.h"

namespace lanelight {
namespace {

namespace fs = std::filesystem;

constexpr int kFormat = 1;  // of the files; another one is not read

nlohmann::json StageState(const StageProfile& s) {
  return {{"name", s.name},       {"calls", s.calls},
          {"items", s.items},     {"lane_slots", s.lane_slots},
          {"seconds", s.seconds}, {"bytes_per_item", s.bytes_per_item}};
}

StageProfile StageFromState(const nlohmann::json& json) {
  StageProfile s;
  s.name = json.at("name");
  s.calls = json.at("calls");
  s.items = json.at("items");
  s.lane_slots = json.at("lane_slots");
  s.seconds = json.at("seconds");
  s.bytes_per_item = json.at("bytes_per_item");
  return s;
}

std::string Header(const std::string& strategy, std::uint64_t spp, const Cells& cells) {
  nlohmann::json json = {{"format", kFormat}, {"strategy", strategy}, {"spp", spp}};
  json["repetitions"] = nlohmann::json::array();
  for (const Measurement& m : cells.repetitions) json["repetitions"].push_back(ToJson(m));
  json["stages"] = nlohmann::json::array();
  for (const StageProfile& s : cells.stages) json["stages"].push_back(StageState(s));
  return DumpJson(json) + "\n";
}

std::string FloatBytes(const std::vector<Rgb>& image) {
  std::string bytes(image.size() * 3 * sizeof(float), '\0');
  char* at = bytes.data();
  for (const Rgb& color : image) {
    const Vec3f value = VecCast<float>(color);
    std::memcpy(at, &value, sizeof(value));
    at += sizeof(value);
  }
  return bytes;
}

std::vector<Rgb> FromFloatBytes(std::string_view bytes) {
  std::vector<Rgb> image(bytes.size() / (3 * sizeof(float)));
  const char* at = bytes.data();
  for (Rgb& color : image) {
    Vec3f value;
    std::memcpy(&value, at, sizeof(value));
    color = VecCast<double>(value);
    at += sizeof(value);
  }
  return image;
}

}  // namespace

CellStore::CellStore(std::string folder, std::size_t pixels)
    : folder_(std::move(folder)), pixels_(pixels) {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) throw InputError("cannot make '" + folder_ + "': " + error.message());
}

std::string CellStore::Path(const std::string& strategy, std::uint64_t spp) const {
  return fmt::format("{}/{:016x}-{}.cells", folder_, Hash64(strategy), spp);
}

Cells CellStore::Load(const std::string& strategy, std::uint64_t spp) const {
  Cells cells;
  cells.moments = Moments(pixels_);
  const std::string path = Path(strategy, spp);
  std::error_code error;
  if (!fs::exists(path, error)) return cells;
  const std::string content = ReadWholeFile(path);
  const std::size_t end = content.find('\n');
  const auto refuse = [&](const std::string& what) {
    throw InputError("'" + path + "' is not a file of this study (" + what +
                     "); remove it, and its renders are done again");
  };
  try {
    const auto header = ParseJson(content.substr(0, end));
    if (header.at("format") != kFormat || header.at("strategy") != strategy ||
        header.at("spp") != spp) {
      refuse("it is of another strategy or version");
    }
    for (const auto& m : header.at("repetitions")) {
      cells.repetitions.push_back(MeasurementFromJson(m));
    }
    for (const auto& s : header.at("stages")) cells.stages.push_back(StageFromState(s));
  } catch (const nlohmann::json::exception& error) {
    refuse(JsonProblem(error));
  }
  const std::string sums = cells.moments.Save();
  const std::string_view binary = std::string_view(content).substr(end + 1);
  const std::size_t image_bytes = pixels_ * 3 * sizeof(float);
  if (binary.size() != sums.size() + image_bytes) refuse("its size is wrong");
  cells.moments.Load(binary.substr(0, sums.size()), cells.repetitions.size());
  cells.first = FromFloatBytes(binary.substr(sums.size()));
  return cells;
}

void CellStore::Save(const std::string& strategy, std::uint64_t spp,
                     const Cells& cells) const {
  LL_CHECK_EQ(cells.moments.count(), std::uint64_t{cells.repetitions.size()});
  LL_CHECK_EQ(cells.first.size(), pixels_);
  WriteFileAtomically(
      Path(strategy, spp),
      Header(strategy, spp, cells) + cells.moments.Save() + FloatBytes(cells.first));
}

void AddStages(const std::vector<StageProfile>& more, std::vector<StageProfile>& sum) {
  for (const StageProfile& m : more) {
    const auto same = [&](const StageProfile& s) { return s.name == m.name; };
    const auto found = std::find_if(sum.begin(), sum.end(), same);
    if (found == sum.end()) {
      sum.push_back(m);
      continue;
    }
    found->calls += m.calls;
    found->items += m.items;
    found->lane_slots += m.lane_slots;
    found->seconds += m.seconds;
  }
}

}  // namespace lanelight
