#include "src/cli/texts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "src/base/core/json_text.h"
#include "src/base/image/exr.h"
#include "src/base/image/image.h"
#include "src/base/stat/values.h"
#include "src/cli/console.h"

namespace lanelight {
namespace {

using Json = nlohmann::json;

// Attributes of ours that are said in words: by these keys of the text.
constexpr std::pair<const char*, const char*> kKnownAttributes[] = {
    {"spp", "samples"},     {"renderTime", "time"},  {"strategy", "strategy"},
    {"seed", "seed"},       {"sceneHash", "scene"},  {"version", "program"},
    {"machine", "machine"}, {"settings", "settings"}};

Json AttributeJson(const ImageAttribute& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* number = std::get_if<double>(&value)) return NumberJson(*number);
  return std::get<int>(value);
}

// The root of a relative MSE is a share of the image's brightness.
Json RootOf(const Json& attributes, const char* name) {
  const auto found = attributes.find(name);
  if (found == attributes.end() || !found->is_number()) return nullptr;
  return NumberJson(std::sqrt(found->get<double>()));
}

// The render's own estimate of its error, as shares; null if there is none.
Json ErrorJson(const Json& attributes) {
  const Json value = RootOf(attributes, "relmse");
  if (value.is_null()) return nullptr;
  return {{"value", value},
          {"low", RootOf(attributes, "relmseLow")},
          {"high", RootOf(attributes, "relmseHigh")},
          {"why", attributes.value("relmseDoubt", "")}};
}

Json PartJson(const ExrPart& part) {
  Json channels = Json::array(), attributes = Json::object();
  for (const ExrChannel& c : part.channels) {
    channels.push_back(
        {{"name", c.name}, {"type", c.type}, {"sampling", {c.x_sampling, c.y_sampling}}});
  }
  for (const auto& [name, value] : part.attributes) {
    attributes[name] = AttributeJson(value);
  }
  return {{"name", part.name},
          {"kind", part.kind},
          {"width", part.width()},
          {"height", part.height()},
          {"data_window", part.data_window},
          {"display_window", part.display_window},
          {"compression", part.compression},
          {"channels", channels},
          {"error", ErrorJson(attributes)},
          {"attributes", attributes},
          {"other_attributes", part.other_attributes}};
}

Json PlainPart(const Image& image) {
  Json channels = Json::array();
  for (const std::string& name : image.names) {
    channels.push_back({{"name", name},
                        {"type", image.is_bytes() ? "byte, sRGB" : "float"},
                        {"sampling", {1, 1}}});
  }
  return {{"width", image.width}, {"height", image.height}, {"channels", channels}};
}

std::string InfoRow(const std::string& name, const std::string& text) {
  return text.empty() ? "" : FactRow(name, text);
}

// Names of channels, by type.
std::string ChannelsText(const Json& channels) {
  std::vector<std::pair<std::string, std::string>> types;
  for (const Json& c : channels) {
    const std::string type = c.at("type");
    std::string name = c.at("name");
    if (c.at("sampling") != Json{1, 1}) name += " (subsampled)";
    if (types.empty() || types.back().first != type) types.push_back({type, ""});
    types.back().second += (types.back().second.empty() ? "" : " ") + name;
  }
  std::string text;
  for (const auto& [type, names] : types) {
    text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", names, type);
  }
  return text;
}

std::string SizeText(const Json& part) {
  std::string text =
      fmt::format("{}x{}", part.at("width").get<int>(), part.at("height").get<int>());
  if (!part.contains("data_window")) return text;
  const std::array<int, 4> data = part.at("data_window"),
                           full = part.at("display_window");
  if (data == full) return text;
  return text + fmt::format(", pixels {},{} to {},{} of a picture of {}x{}", data[0],
                            data[1], data[2], data[3], full[2] - full[0] + 1,
                            full[3] - full[1] + 1);
}

std::string ErrorRowText(const Json& error) {
  if (error.is_null()) return "it says none";
  const auto percent = [](const Json& fraction) { return 100 * fraction.get<double>(); };
  if (error.at("high").is_null()) {
    return fmt::format("{:.3g} %, at least {:.3g} %: {}", percent(error.at("value")),
                       error.at("low").is_null() ? 0 : percent(error.at("low")),
                       error.at("why").get<std::string>());
  }
  return fmt::format("{:.3g} % [{:.3g}, {:.3g}] (root of the relative MSE, 95 %)",
                     percent(error.at("value")), percent(error.at("low")),
                     percent(error.at("high")));
}

std::string AttributeText(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  return value.is_number_float() ? fmt::format("{:.6g}", value.get<double>())
                                 : DumpJson(value);
}

// Returns the other attributes, one per row.
std::string OtherRows(const Json& part) {
  std::string text;
  for (const auto& [name, value] : part.at("attributes").items()) {
    const bool known =
        name.starts_with("relmse") ||
        std::ranges::any_of(kKnownAttributes, [&, key = name](const auto& pair) {
          return key == pair.first;
        });
    if (!known) text += InfoRow(name, AttributeText(value));
  }
  const auto others = part.at("other_attributes").get<std::vector<std::string>>();
  return text + InfoRow("and has", fmt::format("{}", fmt::join(others, ", ")));
}

std::string PartText(const Json& part) {
  std::string text = InfoRow("size", SizeText(part)) +
                     InfoRow("channels", ChannelsText(part.at("channels")));
  if (!part.contains("attributes")) return text;
  text += InfoRow("stored as",
                  fmt::format("{}, compression {}", part.at("kind").get<std::string>(),
                              part.at("compression").get<std::string>()));
  text += InfoRow("error", ErrorRowText(part.at("error")));
  const Json& attributes = part.at("attributes");
  for (const auto& [attribute, name] : kKnownAttributes) {
    const auto found = attributes.find(attribute);
    if (found == attributes.end()) continue;
    const std::string unit = std::string(name) == "samples" ? " per pixel"
                             : std::string(name) == "time"  ? " s"
                                                            : "";
    text += InfoRow(name, AttributeText(*found) + unit);
  }
  return text + OtherRows(part);
}

}  // namespace

nlohmann::json ImageInfoJson(const std::string& path) {
  Json parts = Json::array();
  if (std::filesystem::path(path).extension() == ".exr") {
    for (const ExrPart& part : ReadExrHeader(path)) parts.push_back(PartJson(part));
  } else {
    parts.push_back(PlainPart(ReadImage(path)));
  }
  return {{"image", path}, {"parts", parts}};
}

std::string ImageInfoText(const Json& info) {
  std::string text = InfoRow("image", info.at("image"));
  const Json& parts = info.at("parts");
  for (const Json& part : parts) {
    if (parts.size() > 1) text += "\n" + InfoRow("part", part.value("name", ""));
    text += PartText(part);
  }
  return text;
}

}  // namespace lanelight
