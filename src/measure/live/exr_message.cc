// The file that a page saves.
#include <unistd.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "src/base/core/input_file.h"
#include "src/base/core/version.h"
#include "src/measure/live/picture.h"
#include "src/measure/live/state_json.h"
#include "src/measure/live/access_check.h"
#include "src/render/job/output.h"

namespace lanelight::live {
namespace {

namespace fs = std::filesystem;

// A file with a unique name, removed on destruction.
class TemporaryFile {
 public:
  TemporaryFile() : path_(fs::temp_directory_path() / ("lanelight-" + MakeToken())) {}
  ~TemporaryFile() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  std::string path() const { return path_.string(); }

 private:
  fs::path path_;
};

}  // namespace

std::string ExrMessage(const LiveScene& live_scene, const PassRenderer& renderer) {
  const FilmAccumulator& film = renderer.film();
  ExrOptions options;
  options.x0 = film.x0();
  options.y0 = film.y0();
  options.full_width = renderer.view().film.width;
  options.full_height = renderer.view().film.height;
  options.color_space = renderer.view().film.color_space;
  options.attributes["spp"] = double(renderer.spp());
  options.attributes["renderTime"] = renderer.cpu_seconds();
  options.attributes["seed"] = std::to_string(live_scene.job.seed);
  options.attributes["strategy"] = "path, " + ToText(renderer.strategy());
  options.attributes["version"] = std::string(FullVersion());
  NoteVarianceUnit(film, options);
  const TemporaryFile file;
  WriteExr(file.path(), film.width(), film.height(),
           FilmPlanes(film, live_scene.job.scene.scale()), options);
  const std::string name = fs::path(live_scene.path).stem().string() + "-" +
                           std::to_string(renderer.spp()) + "spp.exr";
  return BinaryHead({{"kind", "file"}, {"name", name}}) + ReadWholeFile(file.path());
}

}  // namespace lanelight::live
