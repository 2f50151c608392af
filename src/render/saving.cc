#include "src/render/saving.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "src/core/error.h"
#include "src/core/error_text.h"
#include "src/image/atomic_file.h"

namespace lanelight {
namespace {

namespace fs = std::filesystem;

std::string Reason() { return std::strerror(errno); }

void EraseUnwritten(std::vector<std::string>& paths) {
  std::erase_if(paths, [](const std::string& p) { return p.empty() || p == "-"; });
}

// Whether two paths lead to one file, by whatever links, or will once it is there.
bool SameFile(const std::string& a, const std::string& b) {
  std::error_code error;
  if (fs::equivalent(a, b, error)) return true;
  const auto place = [](const std::string& path) {
    std::error_code ignored;
    return fs::weakly_canonical(fs::absolute(path, ignored), ignored);
  };
  return a == b ||
         (!fs::exists(a, error) && !fs::exists(b, error) && place(a) == place(b));
}

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
    problems_.push_back("nor could it be kept elsewhere: " + WithoutPrefix(error));
  }
}

void Saver::SaveText(std::string path, const std::string& text) {
  Save(path, [&](const std::string& p) { WriteFileAtomically(p, text); });
}

void CheckOutputPaths(std::vector<std::string> paths, const std::string& scene) {
  EraseUnwritten(paths);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (SameFile(paths[i], scene)) {
      throw InputError("output '" + paths[i] + "' would overwrite the scene");
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (!SameFile(paths[i], paths[j])) continue;
      throw InputError("two outputs go to '" + paths[i] + "'" +
                       (paths[i] == paths[j] ? "" : ", which is '" + paths[j] + "'"));
    }
    CheckWritable(paths[i]);
  }
}

void CheckInputsAreSpared(std::vector<std::string> paths,
                          const std::set<std::string>& inputs) {
  EraseUnwritten(paths);
  for (const std::string& path : paths) {
    for (const std::string& input : inputs) {
      if (!SameFile(path, input)) continue;
      throw InputError("output '" + path + "' would overwrite '" + input +
                       "', which is read: give the output another name");
    }
  }
}

void CheckWritable(const std::string& path) {
  const auto refuse = [&](const std::string& reason) {
    throw InputError("cannot write '" + path + "': " + reason);
  };
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  // A name that is too long, a loop of links, a folder that may not be entered.
  if (status.type() == fs::file_type::none) refuse(error.message());
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
  CheckCreatable(path);
}

std::string FallbackPath(const std::string& path) {
  std::error_code error;
  fs::path directory = fs::temp_directory_path(error);
  if (error) directory = "/tmp";
  // The end of a long name, with its extension.
  constexpr std::size_t kMostOfName = 200;
  std::string name = fs::path(path).filename();
  if (name.size() > kMostOfName) name.erase(0, name.size() - kMostOfName);
  return (directory / fmt::format("lanelight-{}-{}", getpid(), name)).string();
}

}  // namespace lanelight
