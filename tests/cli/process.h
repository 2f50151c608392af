// Runs the program as a user would, and says what came of it.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace lanelight {

struct ProcessResult {
  int exit_code = -1;  // -1 if a signal ended it
  int signal = 0;
  std::string out, err;
  double seconds = 0;
};

struct ProcessOptions {
  std::string stdout_path;                // instead of capturing, e.g. /dev/full
  bool close_stdout_reader = false;       // close the reading end of standard output
  std::string trigger;                    // once this appears in standard error ...
  std::function<void(int child)> action;  // ... this is called with the process id
  long file_size_limit = 0;    // bytes; writes beyond it fail, as on a full disk
  std::string temp_directory;  // TMPDIR
  /// Of the terminal, COLUMNS: so wide that no line is broken within what a test looks
  /// for. Empty: not set.
  std::string columns = "1000";
  /// Called in the new process before the program; system calls only.
  std::function<void()> prepare;
  double timeout = 60;  // seconds, then it is killed
};

/// Runs lanelight with these arguments.
ProcessResult RunLanelight(const std::vector<std::string>& arguments,
                           const ProcessOptions& options = {});

/// For ProcessOptions::prepare: file locks (F_OFD_SETLK) fail as they do on a file system
/// that has none.
void ForbidLocks();

/// A directory that disappears with the object.
class TempDirectory {
 public:
  TempDirectory();
  ~TempDirectory();
  TempDirectory(const TempDirectory&) = delete;
  TempDirectory& operator=(const TempDirectory&) = delete;

  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  std::string path() const { return path_.string(); }
  /// Names of the files in it, sorted.
  std::vector<std::string> Files() const;

 private:
  std::filesystem::path path_;
};

/// Writes `text` to `path` and returns `path`.
std::string WriteText(const std::string& path, const std::string& text);

/// A small scene: a diffuse sphere under a point light, 32 x 24 pixels, 16 samples.
std::string WriteSphereScene(const TempDirectory& directory);

}  // namespace lanelight
