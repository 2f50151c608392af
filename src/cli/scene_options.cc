#include "src/cli/scene_options.h"

#include <charconv>
#include <fmt/ranges.h>

#include <map>
#include <string_view>
#include <vector>

#include "kernels/simd/target.h"
#include "src/cli/console.h"
#include "src/cli/defaults.h"
#include "src/cli/validators.h"
#include "src/image/image.h"
#include "src/strategy/named_strategy.h"

namespace lanelight {
namespace {

// Integers separated by `separator`; empty if the text is anything else.
std::vector<int> ParseInts(const std::string& text, char separator) {
  std::vector<int> values;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (true) {
    int value = 0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc()) return {};
    values.push_back(value);
    if (next == end) return values;
    if (*next != separator) return {};
    at = next + 1;
  }
}

void SetResolution(RenderSettings& settings, const std::string& text) {
  const std::vector<int> v = ParseInts(text, 'x');
  if (v.size() != 2 || v[0] < 1 || v[1] < 1 || v[0] > kMaxImageSide ||
      v[1] > kMaxImageSide) {
    throw CLI::ValidationError(
        "--resolution",
        fmt::format("'{}' is not WIDTHxHEIGHT with sides of 1 to {} pixels, "
                    "e.g. 640x480",
                    text, kMaxImageSide));
  }
  settings.resolution = {v[0], v[1]};
}

void SetCrop(RenderSettings& settings, const std::string& text) {
  const std::vector<int> v = ParseInts(text, ',');
  if (v.size() != 4 || v[0] < 0 || v[1] < 0 || v[2] <= v[0] || v[3] <= v[1]) {
    throw CLI::ValidationError(
        "--crop", "'" + text + "' is not x0,y0,x1,y1 in pixels with x0 < x1 and y0 < y1");
  }
  settings.crop = {v[0], v[1], v[2], v[3]};
}

}  // namespace

void AddWindowOptions(CLI::App& command, RenderSettings& s) {
  command
      .add_option_function<std::string>(
          "--resolution", [&s](const std::string& text) { SetResolution(s, text); },
          WithSceneDefault("Size of the image in pixels",
                           fmt::format("{}x{}", Film{}.width, Film{}.height)))
      ->type_name("WxH");
  command
      .add_option_function<std::string>(
          "--crop", [&s](const std::string& text) { SetCrop(s, text); },
          WithSceneDefault("Render these pixels only; x1 and y1 are exclusive", "all"))
      ->type_name("x0,y0,x1,y1");
}

namespace {

// A flag whose value is one of a few names: its type, from which shells complete it.
template <class T>
void AddNameOption(CLI::App& command, const std::string& flag, std::optional<T>& value,
                   std::map<std::string, T> names, const std::string& meaning) {
  std::string list, type;
  for (const auto& [name, unused] : names) {
    list += (list.empty() ? "" : ", ") + name;
    type += (type.empty() ? "" : "|") + name;
  }
  command
      .add_option_function<std::string>(
          flag,
          [&value, names, flag, list](const std::string& text) {
            const auto found = names.find(text);
            if (found == names.end()) {
              throw CLI::ValidationError(flag, "'" + text + "' is not one of " + list);
            }
            value = found->second;
          },
          meaning)
      ->type_name(type);
}

// Reads the text of --strategy.
void SetStrategyChanges(RenderSettings& settings, const std::string& text) {
  try {
    settings.strategy = ParseStrategy(text, {});
  } catch (const InputError& error) {
    const std::string message = error.what();
    throw CLI::ValidationError("--strategy", message.substr(message.find("strategy ")));
  }
}

}  // namespace

void AddStrategyOptions(CLI::App& command, RenderSettings& s) {
  std::map<std::string, Points> samplers;
  for (int i = 0; i < kNumPoints; ++i) {
    samplers[Name(static_cast<Points>(i))] = static_cast<Points>(i);
  }
  command
      .add_option_function<std::string>(
          "--strategy", [&s](const std::string& text) { SetStrategyChanges(s, text); },
          WithSceneDefault("How to sample: key=value,... (see `lanelight strategies`)",
                           fmt::format("'{}'", kDefaultStrategyName)))
      ->type_name("TEXT");
  AddNameOption<Points>(command, "--sampler", s.points, samplers,
                        WithDefault("Sample points", "those of the strategy"));
}

void AddSeedOption(CLI::App& command, RenderSettings& s) {
  command
      .add_option("--seed", s.seed,
                  WithSceneDefault("Seed of the random numbers", Sampler{}.seed))
      ->check(SeedRange())
      ->type_name("S");
}

void AddThreadsOption(CLI::App& command, int& threads) {
  command
      .add_option("--threads", threads, WithDefault("Threads; 0 = all cores", threads))
      ->check(CLI::Range(0, 1024).description(""))
      ->type_name("T");
}

void AddTransportOptions(CLI::App& command, RenderSettings& s) {
  command
      .add_option(
          "--max-depth", s.max_depth,
          WithSceneDefault("Most scattering events of a path", Integrator{}.max_depth))
      ->check(CLI::Range(0, kMaxDepth).description(""))
      ->type_name("D");
  AddNameOption<Scattering>(command, "--scattering", s.scattering,
                            {{"lambertian", Scattering::kLambertian},
                             {"uniform", Scattering::kUniform},
                             {"insphere", Scattering::kInSphere}},
                            WithSceneDefault("Model of all diffuse materials",
                                             ScatteringName(Material{}.scattering)));
}

void AddBuildCacheOptions(CLI::App& command, TreeFolder& folder) {
  folder.on_wait = PrintError;
  CLI::Option* directory =
      command
          .add_option(
              "--build-cache", folder.path,
              "Keep the trees over shapes in files here, and map those that are there "
              "instead of building")
          ->check([](const std::string& text) {
            return text.empty() ? std::string("a directory has a name") : std::string();
          })
          ->type_name("DIR");
  command
      .add_option("--build-cache-size", folder.most_bytes,
                  WithDefault("Most that these files take together, 0: any number; those "
                              "that were used least recently go",
                              fmt::format("{}GB", folder.most_bytes / 1'000'000'000)))
      ->transform(ByteSize())
      ->type_name("SIZE")
      ->needs(directory);
}

void AddExecutionOptions(CLI::App& command, SceneOptions& options) {
  command
      .add_option("--wavefront", options.settings.wavefront,
                  WithDefault("Paths in flight per thread; 0 = fit the cache",
                              options.settings.wavefront))
      ->check(CLI::Range(0u, kMaxWavefront).description(""))
      ->type_name("N");
  AddNameOption<BuildQuality>(
      command, "--build", options.settings.build,
      {{"fast", BuildQuality::kFast}, {"high", BuildQuality::kHigh}},
      WithDefault("How to build the trees over shapes, in less time or for faster rays",
                  BuildName(CompileOptions{}.build)));
  AddBuildCacheOptions(command, options.settings.trees.folder);
  command
      .add_option(
          "--copied-triangles", options.settings.copied_triangles,
          WithDefault("Copy small instances into the world, as long as that makes "
                      "at most so many triangles more; 0: none",
                      options.settings.copied_triangles))
      ->check(CLI::Range(std::uint64_t{0}, kMostCopiedTriangles).description(""))
      ->type_name("N");
  AddThreadsOption(command, options.threads);
  command
      .add_option("--target", options.target,
                  WithDefault("SIMD target (see `lanelight info`)", "the best there is"))
      ->check(CLI::IsMember(AvailableTargets(), CLI::ignore_case).description(""))
      ->type_name("NAME");
  command.add_flag(
      "--skip-unsupported", options.settings.skip_unsupported,
      "Leave out what cannot be rendered (media) instead of refusing the scene");
}

void AddSceneOptions(CLI::App& command, SceneOptions& options) {
  RenderSettings& s = options.settings;
  command.add_option("SCENE", options.scene, "Scene file in the text format of pbrt-v4")
      ->required()
      ->type_name("");
  AddWindowOptions(command, s);
  command.add_flag("--aov", s.aov, "Write albedo, normal and depth of the first hit too");
  AddNameOption<Gbuffer>(
      command, "--gbuffer", s.gbuffer,
      {{"camera", Gbuffer::kCamera}, {"world", Gbuffer::kWorld}},
      "Write these, and point, normals, u, v and slopes of the first hit in that space");
  AddStrategyOptions(command, s);
  AddTransportOptions(command, s);
  AddExecutionOptions(command, options);
}

std::string FlagsText(const SceneOptions& options) {
  const RenderSettings& s = options.settings;
  std::string text;
  if (s.resolution) {
    text += fmt::format(" --resolution {}x{}", (*s.resolution)[0], (*s.resolution)[1]);
  }
  if (s.crop) text += fmt::format(" --crop {}", fmt::join(*s.crop, ","));
  if (s.aov) text += " --aov";
  if (s.gbuffer) text += fmt::format(" --gbuffer {}", GbufferName(*s.gbuffer));
  if (s.max_depth) text += fmt::format(" --max-depth {}", *s.max_depth);
  if (s.seed) text += fmt::format(" --seed {}", *s.seed);
  if (s.scattering)
    text += fmt::format(" --scattering {}", ScatteringName(*s.scattering));
  if (s.build) {
    text += fmt::format(" --build {}", BuildName(*s.build));
  }
  if (const TreeFolder& folder = s.trees.folder; !folder.path.empty()) {
    text += " --build-cache " + ShellWord(folder.path);
    if (folder.most_bytes != kTreeFolderBytes) {
      text += fmt::format(" --build-cache-size {}", folder.most_bytes);
    }
  }
  if (s.copied_triangles != kCopiedTriangles) {
    text += fmt::format(" --copied-triangles {}", s.copied_triangles);
  }
  if (s.wavefront > 0) text += fmt::format(" --wavefront {}", s.wavefront);
  if (options.threads > 0) text += fmt::format(" --threads {}", options.threads);
  if (!options.target.empty()) text += " --target " + options.target;
  if (s.skip_unsupported) text += " --skip-unsupported";
  return text;
}

std::string ShellWord(const std::string& text) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
  if (!text.empty() && text.find_first_not_of(kPlain) == text.npos) return text;
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

}  // namespace lanelight
