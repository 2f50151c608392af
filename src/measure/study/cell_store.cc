#include "src/measure/study/cell_store.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "src/base/core/check.h"
#include "src/base/core/error.h"
#include "src/base/core/hash.h"
#include "src/base/core/json_text.h"
#include "src/base/stat/values.h"
#include "src/base/state/state_file.h"
#include "src/render/job/machine_json.h"

namespace lanelight {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(StageProfile, name, calls, items, lane_slots, seconds,
                                   bytes_per_item)

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr int kFormat = 2;  // version of the files; other versions are not read

Json IdentityOfCells(const std::string& strategy, std::uint64_t spp) {
  return {{"format", kFormat}, {"strategy", strategy}, {"spp", spp}};
}

constexpr char kFirst[] = "first";

nlohmann::json Value(std::uint64_t v) { return v; }
nlohmann::json Value(double v) { return NumberJson(v); }

std::string Text(std::uint64_t v) { return std::to_string(v); }
std::string Text(double v) { return std::isfinite(v) ? fmt::format("{}", v) : ""; }

template <class T>
void Read(const nlohmann::json& json, const char* name, T& value) {
  const auto found = json.find(name);
  if (found != json.end() && !found->is_null()) value = found->get<T>();
}

constexpr char kColumn[] = "moments";
constexpr char kMeaning[] =
    "sums over the renders, then of their squares: R, G, B, their mean";

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
        throw InputError("'" + path + "' has another strategy or version");
      }
      const Json report = ParseJson(file.report());
      report.at("repetitions").get_to(cells.repetitions);
      report.at("stages").get_to(cells.stages);
    });
    if (file.window() != window_) {
      throw InputError("'" + path + "' has an image of another size");
    }
    cells.first.resize(window_.pixels());
    file.ReadPixels({cells.moments.Restore(cells.repetitions.size()),
                     MakeStateColumn<double>(kFirst, "", cells.first)},
                    window_);
    return cells;
  } catch (const InputError& damage) {
    throw InputError(WithoutPrefix(damage) + "; remove it to repeat its renders");
  }
}

void CellStore::Save(const std::string& strategy, std::uint64_t spp,
                     const Cells& cells) const {
  LL_CHECK_EQ(cells.moments.count(), std::uint64_t{cells.repetitions.size()});
  StateContent content;
  content.identity = DumpJson(IdentityOfCells(strategy, spp));
  content.report =
      DumpJson({{"repetitions", cells.repetitions}, {"stages", cells.stages}});
  content.window = window_;
  content.tiles = {window_};
  content.compress = false;  // after each of many short renders
  content.pixels = {
      cells.moments.Column(),
      MakeStateColumn<double>(kFirst, "the first render: R, G, B", cells.first)};
  WriteState(content, Path(strategy, spp));
}

void to_json(nlohmann::json& json, const Measurement& m) {
#define X(type, name) json[#name] = Value(m.name);
  LANELIGHT_MEASUREMENT(X)
#undef X
  json["machine"] = ToJson(m.machine);
}

void from_json(const nlohmann::json& json, Measurement& m) {
  m.machine = MachineFromJson(json.value("machine", nlohmann::json()));
#define X(type, name) Read(json, #name, m.name);
  LANELIGHT_MEASUREMENT(X)
#undef X
}

std::string CsvHeader() {
  std::string text;
#define X(type, name) text += (text.empty() ? "" : ",") + std::string(#name);
  LANELIGHT_MEASUREMENT(X)
#undef X
  return text;
}

std::string CsvRow(const Measurement& m) {
  std::string text;
  bool first = true;
#define X(type, name) text += (std::exchange(first, false) ? "" : ",") + Text(m.name);
  LANELIGHT_MEASUREMENT(X)
#undef X
  return text;
}

void Moments::Add(const std::vector<Rgb>& image) {
  LL_CHECK_EQ(image.size(), pixels_.size());
  for (std::size_t i = 0; i < image.size(); ++i) {
    const Rgb c = image[i];
    const double planes[kPlanes] = {c.x, c.y, c.z, (c.x + c.y + c.z) / 3};
    for (int p = 0; p < kPlanes; ++p) {
      pixels_[i].sum[p] += planes[p];
      pixels_[i].squares[p] += planes[p] * planes[p];
    }
  }
  ++count_;
}

double Moments::PlaneVariance(const Pixel& pixel, int plane) const {
  if (count_ < 2) return 0;
  const double n = double(count_), mean = pixel.sum[plane] / n;
  const double scatter = pixel.squares[plane] / n - mean * mean;
  // Equal values leave a remainder of rounding.
  return scatter > 1e-14 * mean * mean ? scatter * n / (n - 1) : 0;
}

Rgb Moments::Mean(std::size_t pixel) const {
  const auto& sum = pixels_[pixel].sum;
  return Rgb{sum[0], sum[1], sum[2]} / double(count_);
}

Rgb Moments::Variance(std::size_t pixel) const {
  const Pixel& p = pixels_[pixel];
  return {PlaneVariance(p, 0), PlaneVariance(p, 1), PlaneVariance(p, 2)};
}

stat::MeanEstimate Moments::GreyEstimate(std::size_t pixel) const {
  const double n = double(count_);
  return {pixels_[pixel].sum[3] / n, GreyVariance(pixel) / n, n - 1};
}

double Moments::GreyVariance(std::size_t pixel) const {
  return PlaneVariance(pixels_[pixel], 3);
}

StateColumn Moments::Column() const {
  return MakeStateColumn<double>(kColumn, kMeaning, pixels_, {2, kPlanes});
}

MutableStateColumn Moments::Restore(std::uint64_t count) {
  count_ = count;
  return MakeStateColumn<double>(kColumn, kMeaning, pixels_, {2, kPlanes});
}

}  // namespace lanelight
