#include "src/render/job/saving.h"

#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "src/base/core/error.h"
#include "src/base/core/input_file.h"
#include "src/base/image/atomic_file.h"

namespace lanelight {
namespace {

namespace fs = std::filesystem;

std::string Reason() { return std::strerror(errno); }

// Returns the place of a file, with all links resolved.
fs::path Place(const std::string& path) {
  std::error_code ignored;
  return fs::weakly_canonical(fs::absolute(path, ignored), ignored);
}

bool SameFile(const std::string& a, const std::string& b) {
  std::error_code error;
  if (fs::equivalent(a, b, error)) return true;
  return a == b ||
         (!fs::exists(a, error) && !fs::exists(b, error) && Place(a) == Place(b));
}

bool LiesIn(const std::string& folder, const std::string& file) {
  const fs::path inside = Place(file), around = Place(folder);
  return std::mismatch(around.begin(), around.end(), inside.begin(), inside.end())
             .first == around.end();
}

void CheckNotOverwritten(const OutputPaths& outputs, const std::string& input) {
  for (const std::string& file : outputs.files) {
    if (!SameFile(file, input)) continue;
    throw WouldOverwrite("output '" + file + "' would overwrite '" + input +
                         "', which is an input: give the output another name");
  }
  for (const std::string& folder : outputs.folders) {
    if (!LiesIn(folder, input)) continue;
    throw WouldOverwrite(
        "'" + input + "', which is an input, lies in '" + folder +
        "', which this command writes: put it elsewhere, or give another "
        "directory");
  }
}

}  // namespace

void ResultWriter::Save(std::string& path,
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
    problems_.push_back("the result was written to '" + fallback + "'");
    path = fallback;
  } catch (const std::exception& error) {
    problems_.push_back("it could not be written elsewhere either: " +
                        WithoutPrefix(error));
  }
}

void ResultWriter::SaveText(std::string path, const std::string& text) {
  Save(path, [&](const std::string& p) { WriteFileAtomically(p, text); });
}

void CheckOutputPaths(OutputPaths outputs, const std::set<std::string>& inputs) {
  std::vector<std::string>& paths = outputs.files;
  std::erase_if(paths, [](const std::string& p) { return p.empty() || p == "-"; });
  for (const std::string& input : inputs) CheckNotOverwritten(outputs, input);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!SameFile(paths[i], paths[j])) continue;
      throw InputError("two outputs go to '" + paths[i] + "'" +
                       (paths[i] == paths[j] ? "" : ", which is '" + paths[j] + "'"));
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
  // A name that is too long, a loop of links, a folder that may not be entered.
  if (status.type() == fs::file_type::none) refuse(error.message());
  const std::string special = SpecialFile(path);
  if (!special.empty()) refuse("it is " + special + ", not a regular file");
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
  constexpr std::size_t kMaxNameLength = 200;
  std::string name = fs::path(path).filename();
  if (name.size() > kMaxNameLength) name.erase(0, name.size() - kMaxNameLength);
  // Results of one name, as those of a sweep's cells, each have a file of their own.
  for (int i = 0;; ++i) {
    const std::string number = i == 0 ? "" : fmt::format("-{}", i);
    const fs::path place =
        directory / fmt::format("lanelight-{}{}-{}", getpid(), number, name);
    if (!fs::exists(place, error)) return place.string();
  }
}

}  // namespace lanelight
