// Curves of a sweep, and how their errors fall, as JSON and text.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "src/base/image/exr.h"
#include "src/base/stat/values.h"
#include "src/measure/sweep/convergence.h"

namespace lanelight {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMaxCurves = 1000, kMaxSeeds = 16, kMaxLines = 8;

// The cells of a curve: by count, and by seed.
struct CurveCells {
  const CellGroup* group = nullptr;
  std::map<double, std::map<std::string, std::size_t>> by_count;
};

std::string SeedOf(const SweepCell& cell) {
  return Get(cell.values, Axis::kSeed).value_or("");
}

// Returns curves in the order of the grid, with all finished cells.
std::vector<CurveCells> CurvesOf(const Sweep& sweep,
                                 const std::vector<CellGroup>& groups) {
  std::vector<CurveCells> curves;
  std::map<std::map<std::string, std::string>, std::size_t> known;
  std::set<std::size_t> seen;  // first cells: a strategy may be in several groups
  for (const CellGroup& group : groups) {
    const auto spp = group.values.find(Key(Axis::kSpp));
    if (spp == group.values.end() || group.cells.empty()) continue;
    if (!seen.insert(group.cells[0]).second) continue;
    std::map<std::string, std::string> values = group.values;
    values.erase(spp->first);
    const auto [entry, is_new] = known.try_emplace(values, curves.size());
    if (is_new) curves.push_back({&group, {}});
    auto& cells = curves[entry->second].by_count[std::stod(spp->second)];
    for (const std::size_t i : group.cells) cells[SeedOf(sweep.cells[i])] = i;
  }
  return curves;
}

// Returns the cells of seeds that all counts have: by count, then seed.
std::vector<std::vector<std::size_t>> CommonCells(const CurveCells& curve) {
  std::vector<std::vector<std::size_t>> cells(curve.by_count.size());
  for (const auto& [seed, unused] : curve.by_count.begin()->second) {
    if (cells[0].size() == kMaxSeeds) break;
    if (std::ranges::any_of(curve.by_count, [&](const auto& count) {
          return count.second.count(seed) == 0;
        })) {
      continue;
    }
    std::size_t i = 0;
    for (const auto& [count, by_seed] : curve.by_count) {
      cells[i++].push_back(by_seed.at(seed));
    }
  }
  return cells;
}

// Returns an analysis; empty without enough counts and seeds, or images.
std::optional<Convergence> Analyse(const Sweep& sweep, const SweepFolder& folder,
                                   const CurveCells& of) {
  const auto cells = CommonCells(of);
  if (cells.size() < 2 || cells[0].size() < kMinCurveSeeds) return std::nullopt;
  ErrorCurve curve;
  for (const auto& [count, unused] : of.by_count) curve.samples.push_back(count);
  curve.seeds = cells[0].size();
  curve.half = sweep.settings.render.image.half;
  const auto path = [&](std::size_t count, std::size_t seed) {
    return folder.File(sweep.cells[cells[count][seed]], "image.exr");
  };
  curve.image = [&](std::size_t count, std::size_t seed) {
    return LinearOf(ReadExr(path(count, seed), {"R", "G", "B"}));
  };
  try {
    Convergence convergence = AnalyseCurve(curve);
    const auto window = ReadExrHeader(path(0, 0)).at(0).data_window;
    for (BlamedPixel& pixel : convergence.pixels) {
      pixel.x += window[0];  // of the full image
      pixel.y += window[1];
    }
    return convergence;
  } catch (const InputError&) {  // the page says that the image is missing
    return std::nullopt;
  }
}

std::string OrderText(const Interval& order) {
  const auto exponent = [](double x) { return fmt::format("{:.2f}", -x); };
  if (!order.HasBounds()) return "N^" + exponent(order.value);
  return fmt::format("N^{} [{}, {}]", exponent(order.value), exponent(order.high),
                     exponent(order.low));
}

std::string PercentText(double share) { return fmt::format("{:.2g} %", 100 * share); }

// Returns e.g. "(12, 33) 44 %, (3, 9) 8 %".
std::string PixelsText(const std::vector<BlamedPixel>& pixels) {
  std::string text;
  for (const BlamedPixel& p : pixels) {
    text += fmt::format("{}({}, {}) {}", text.empty() ? "" : ", ", p.x, p.y,
                        PercentText(p.share));
  }
  return text;
}

std::string CauseText(const Convergence& c, bool half) {
  if (c.cause == FallCause::kRounding) {
    return fmt::format("rounding of the image file to {} bits is {} of the error{}",
                       half ? 16 : 32, PercentText(c.rounding / c.relmse.back().value),
                       half ? "; use depth = \"float\"" : "");
  }
  if (c.cause == FallCause::kHeavyTails) {
    return fmt::format(
        "heavy tails (the means of the worst 1 % of the pixels have a skewness of "
        "{:.2g}): 0.1 % of the pixels carry {} of the squared error, 1 % {} ({} of that "
        "in "
        "the same pixels in both halves of the seeds); the worst (x, y): {}",
        c.skewness, PercentText(c.worst_share), PercentText(c.percent_share),
        PercentText(c.repeated), PixelsText(c.pixels));
  }
  return fmt::format(
      "neither rounding ({:.2g}) nor few pixels (the worst 0.1 % carry {}) explain it",
      c.rounding, PercentText(c.worst_share));
}

std::string FallText(const Convergence& c, bool half) {
  if (c.fall == Fall::kExact) return "the images of all seeds are equal";
  if (c.fall != Fall::kSlower) {
    const char* head = c.fall == Fall::kAsExpected
                           ? "the error falls as "
                           : "it is not decided how the error falls: ";
    const bool named = c.cause != FallCause::kNone;
    return head + OrderText(c.order) + (named ? "; " + CauseText(c, half) : "");
  }
  const bool step = c.orders[c.from].high < kMinOrder;
  return fmt::format(
      "the error stops falling as 1/N at {:g} spp: {} {}, relative MSE {:.2g} at {:g} "
      "spp; {}",
      c.samples[c.from], OrderText(step ? c.orders[c.from] : c.order),
      step ? fmt::format("up to {:g} spp", c.samples[c.from + 1]) : "in all",
      c.relmse.back().value, c.samples.back(), CauseText(c, half));
}

Json CurveJson(const Convergence& c, const CellGroup& group, bool half) {
  constexpr const char* kFalls[] = {"as-1/N", "slower", "undecided", "exact"};
  constexpr const char* kCauses[] = {"", "rounding", "heavy-tails", "unknown"};
  Json json = {{"values", group.values},
               {"samples", c.samples},
               {"relmse", Json::array()},
               {"orders", Json::array()},
               {"order", IntervalJson(c.order)},
               {"fall", kFalls[int(c.fall)]},
               {"from", nullptr},
               {"cause", nullptr},
               {"rounding", c.rounding},
               {"worst_share", c.worst_share},
               {"skewness", c.skewness},
               {"percent_share", c.percent_share},
               {"repeated", c.repeated},
               {"pixels", Json::array()},
               {"text", FallText(c, half)}};
  json["values"].erase(Key(Axis::kSpp));
  if (c.fall == Fall::kSlower) json["from"] = c.samples[c.from];
  if (c.cause != FallCause::kNone) json["cause"] = kCauses[int(c.cause)];
  for (const Interval& x : c.relmse) json["relmse"].push_back(IntervalJson(x));
  for (const Interval& x : c.orders) json["orders"].push_back(IntervalJson(x));
  for (const BlamedPixel& p : c.pixels) {
    json["pixels"].push_back({{"x", p.x}, {"y", p.y}, {"share", p.share}});
  }
  return json;
}

}  // namespace

Json ConvergenceJson(const Sweep& sweep, const SweepFolder& folder,
                     const std::vector<CellGroup>& groups) {
  Json json = Json::array();
  for (const CurveCells& curve : CurvesOf(sweep, groups)) {
    if (json.size() == kMaxCurves) break;
    if (const auto convergence = Analyse(sweep, folder, curve)) {
      json.push_back(
          CurveJson(*convergence, *curve.group, sweep.settings.render.image.half));
    }
  }
  return json;
}

std::string ConvergenceText(const Json& curves) {
  std::string text;
  std::size_t named = 0, slower = 0, undecided = 0;
  for (const Json& curve : curves) {
    slower += curve.at("fall") == "slower";
    undecided += curve.at("fall") == "undecided";
    if (curve.at("cause").is_null() || ++named > kMaxLines) continue;
    text += fmt::format("{}: {}\n", ValuesText(curve.at("values")),
                        curve.at("text").get<std::string>());
  }
  if (curves.empty()) return "";
  return text + fmt::format(
                    "error against spp: {} curves, {} fall as 1/N or faster, {} more "
                    "slowly, {} not decided\n",
                    curves.size(), curves.size() - slower - undecided, slower, undecided);
}

}  // namespace lanelight
