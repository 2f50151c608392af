// Results go to files, whatever happens.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "src/base/core/error.h"

namespace lanelight {

/// Saves results and collects error messages.
class ResultWriter {
 public:
  /// Calls write(path); if that throws, writes into the temporary directory, so that no
  /// result is lost. Sets `path` to where the file is, or to nothing. Ignores an empty
  /// path.
  void Save(std::string& path, const std::function<void(const std::string&)>& write);
  void SaveText(std::string path, const std::string& text);

  /// Returns messages in order; empty if all files are in place.
  const std::vector<std::string>& problems() const { return problems_; }

 private:
  std::vector<std::string> problems_;
};

/// The outputs of a command.
struct OutputPaths {
  std::vector<std::string> files;         // empty, and "-", standard output: none
  std::vector<std::string> folders = {};  // whose content is the command's
};

/// An output would overwrite an input; nothing may be written then.
class WouldOverwrite : public InputError {
 public:
  using InputError::InputError;
};

/// Checks the outputs of a command before its work. Throws WouldOverwrite if one is among
/// `inputs`, and InputError if two outputs are the same file (links included), or one
/// cannot be written.
void CheckOutputPaths(OutputPaths outputs, const std::set<std::string>& inputs);

/// Throws InputError unless a file can be created at `path`: its directory exists and is
/// writable, and what exists there is a regular file. Leaves nothing behind.
void CheckWritable(const std::string& path);

/// Returns a new file of the temporary directory for a result that could not be written
/// to `path`.
std::string FallbackPath(const std::string& path);

}  // namespace lanelight
