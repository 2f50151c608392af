#include "src/render/saving.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "src/core/error.h"
#include "src/image/atomic_file.h"

namespace lanelight {
namespace {

namespace fs = std::filesystem;

std::string Reason() { return std::strerror(errno); }

}  // namespace

void Saver::Save(std::string& path,
                 const std::function<void(const std::string&)>& write) {
  if (path.empty()) return;
  try {
    return write(path);
  } catch (const std::exception& error) {
    problems_.push_back(error.what());
  }
  const std::string fallback = FallbackPath(path);
  path.clear();
  try {
    write(fallback);
    problems_.push_back("the result is kept in '" + fallback + "'");
    path = fallback;
  } catch (const std::exception& error) {
    problems_.push_back(std::string("nor could it be kept elsewhere: ") + error.what());
  }
}

void Saver::SaveText(std::string path, const std::string& text) {
  Save(path, [&](const std::string& p) { WriteFileAtomically(p, text); });
}

void CheckOutputPaths(std::vector<std::string> paths, const std::string& scene) {
  std::erase_if(paths, [](const std::string& p) { return p.empty() || p == "-"; });
  for (std::size_t i = 0; i < paths.size(); ++i) {
    std::error_code error;
    if (fs::equivalent(paths[i], scene, error)) {
      throw InputError("output '" + paths[i] + "' would overwrite the scene");
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (paths[i] == paths[j]) throw InputError("two outputs go to '" + paths[i] + "'");
    }
    CheckWritable(paths[i]);
  }
}

void CheckWritable(const std::string& path) {
  const auto refuse = [&](const std::string& reason) {
    throw InputError("cannot write '" + path + "': " + reason);
  };
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) refuse("it is a directory");
  if (fs::exists(status) && !fs::is_regular_file(status))
    refuse("it is not a regular file");
  const fs::path directory =
      fs::path(path).has_parent_path() ? fs::path(path).parent_path() : ".";
  if (!fs::is_directory(directory, error)) {
    refuse("there is no directory '" + directory.string() + "'");
  }
  if (fs::exists(status) && access(path.c_str(), W_OK) != 0) refuse(Reason());
  // access() does not see read-only and full file systems; creating a file does.
  std::string probe = (directory / ".lanelight-probe-XXXXXX").string();
  const int file = mkstemp(probe.data());
  if (file < 0) refuse(Reason());
  close(file);
  unlink(probe.c_str());
}

std::string FallbackPath(const std::string& path) {
  std::error_code error;
  fs::path directory = fs::temp_directory_path(error);
  if (error) directory = "/tmp";
  const fs::path name = fs::path(path).filename();
  return (directory / fmt::format("lanelight-{}-{}", getpid(), name.string())).string();
}

}  // namespace lanelight
