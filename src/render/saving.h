// Results go to files, whatever happens.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

namespace lanelight {

/// Saves results, and remembers what went wrong.
class Saver {
 public:
  /// Calls write(path); if that throws, writes into the temporary directory, so that
  /// nothing computed is lost. Replaces `path` by where the file is, or by nothing if
  /// nowhere. Nothing happens for an empty path.
  void Save(std::string& path, const std::function<void(const std::string&)>& write);
  /// Saves a text.
  void SaveText(std::string path, const std::string& text);

  /// Messages, in order; empty if all is where it should be.
  const std::vector<std::string>& problems() const { return problems_; }

 private:
  std::vector<std::string> problems_;
};

/// Throws InputError if an output would overwrite the scene or another one, or cannot be
/// written. Empty paths are left out, and so is "-", standard output. Files are the same
/// whatever links lead to them.
void CheckOutputPaths(std::vector<std::string> paths, const std::string& scene);

/// Throws InputError if an output would overwrite one of `inputs`.
void CheckInputsAreSpared(std::vector<std::string> paths,
                          const std::set<std::string>& inputs);

/// Throws InputError unless a file can be created at `path`: its directory exists and is
/// writable, and what exists there is a regular file. Leaves nothing behind.
void CheckWritable(const std::string& path);

/// Where a result goes that could not be written to `path`: the temporary directory.
std::string FallbackPath(const std::string& path);

}  // namespace lanelight
