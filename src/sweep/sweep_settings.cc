#include "src/sweep/sweep_settings.h"

#include <algorithm>
#include <functional>

#include "src/core/suggest.h"
#include "src/image/image.h"

namespace lanelight {
namespace {

using Reader = std::function<std::string(const TomlFile&, const std::string& key,
                                         const toml::node&, SweepSettings&)>;

std::string Bool(bool value) { return value ? "true" : "false"; }

std::string ReadCrop(const TomlFile& file, const std::string& key, const toml::node& node,
                     SweepSettings& settings) {
  const auto refuse = [&] {
    throw InputError(file.Where(node),
                     "crop is [x0, y0, x1, y1] in pixels with 0 <= x0 < x1 and "
                     "0 <= y0 < y1");
  };
  const toml::array* array = node.as_array();
  if (array == nullptr || array->size() != 4) refuse();
  std::array<int, 4> crop{};
  for (std::size_t i = 0; i < 4; ++i) {
    const std::int64_t side = file.Integer(key, (*array)[i]);
    if (side < 0 || side > kMaxImageSide) refuse();
    crop[i] = static_cast<int>(side);
  }
  if (crop[0] >= crop[2] || crop[1] >= crop[3]) refuse();
  settings.render.crop = crop;
  return fmt::format("{},{},{},{}", crop[0], crop[1], crop[2], crop[3]);
}

std::string OneOf(const TomlFile& file, const std::string& key, const toml::node& node,
                  const std::vector<std::string>& names) {
  std::string text = file.Text(key, node);
  if (std::find(names.begin(), names.end(), text) == names.end()) {
    ThrowUnknown(file.Where(node), key, text, names);
  }
  return text;
}

std::string ReadScattering(const TomlFile& file, const std::string& key,
                           const toml::node& node, SweepSettings& settings) {
  constexpr Scattering kModels[] = {Scattering::kLambertian, Scattering::kUniform,
                                    Scattering::kInSphere};
  std::vector<std::string> names;
  for (const Scattering model : kModels) names.push_back(ScatteringName(model));
  const std::string text = OneOf(file, key, node, names);
  const auto found = std::find(names.begin(), names.end(), text);
  settings.render.scattering = kModels[found - names.begin()];
  return text;
}

std::string ReadGbuffer(const TomlFile& file, const std::string& key,
                        const toml::node& node, SweepSettings& settings) {
  const std::string text = OneOf(file, key, node, {"camera", "world"});
  settings.render.gbuffer = text == "world" ? Gbuffer::kWorld : Gbuffer::kCamera;
  return text;
}

std::string ReadWavefront(const TomlFile& file, const std::string& key,
                          const toml::node& node, SweepSettings& settings) {
  const std::int64_t paths = file.Integer(key, node);
  if (paths < 0 || paths > kMaxWavefront) {
    throw InputError(
        file.Where(node),
        fmt::format("wavefront {} is not an integer from 0 to {}", paths, kMaxWavefront));
  }
  settings.render.wavefront = static_cast<std::uint32_t>(paths);
  return std::to_string(paths);
}

std::string ReadExposure(const TomlFile& file, const std::string& key,
                         const toml::node& node, SweepSettings& settings) {
  settings.exposure = file.Number(key, node);
  if (settings.exposure < -100 || settings.exposure > 100) {
    throw InputError(
        file.Where(node),
        fmt::format("exposure {} is not a number from -100 to 100", settings.exposure));
  }
  return fmt::format("{}", settings.exposure);
}

template <class Member>
Reader FlagReader(Member member) {
  return [member](const TomlFile& file, const std::string& key, const toml::node& node,
                  SweepSettings& settings) {
    return Bool(member(settings) = file.Flag(key, node));
  };
}

std::string ReadDepth(const TomlFile& file, const std::string& key,
                      const toml::node& node, SweepSettings& settings) {
  const std::string text = OneOf(file, key, node, {"float", "half"});
  settings.half = text == "half";
  return text;
}

const std::map<std::string, Reader>& Readers() {
  using S = SweepSettings;
  static const std::map<std::string, Reader> readers = {
      {"aov", FlagReader([](S& s) -> bool& { return s.render.aov; })},
      {"crop", ReadCrop},
      {"depth", ReadDepth},
      {"exposure", ReadExposure},
      {"gbuffer", ReadGbuffer},
      {"png", FlagReader([](S& s) -> bool& { return s.png; })},
      {"scattering", ReadScattering},
      {"skip-unsupported",
       FlagReader([](S& s) -> bool& { return s.render.skip_unsupported; })},
      {"wavefront", ReadWavefront},
  };
  return readers;
}

}  // namespace

SweepSettings ReadSweepSettings(const TomlFile& file, const toml::table& table) {
  SweepSettings settings;
  for (const auto& [toml_key, node] : table) {
    const std::string key(toml_key.str());
    const SourceLocation where = file.Where(toml_key.source());
    if (SweepAxisOf(key)) {
      throw InputError(where, fmt::format("{} is an axis: put it into [grid], with one "
                                          "value if it is the same for all cells",
                                          key));
    }
    const auto reader = Readers().find(key);
    if (reader == Readers().end()) {
      std::vector<std::string> names;
      for (const auto& [name, unused] : Readers()) names.push_back(name);
      ThrowUnknown(where, "setting", key, names);
    }
    settings.texts[key] = reader->second(file, key, node, settings);
  }
  return settings;
}

}  // namespace lanelight
