// Results go to files, whatever happens.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "src/base/core/error.h"

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

/// What a command writes.
struct OutputPaths {
  std::vector<std::string> files;         // empty, and "-", standard output: none
  std::vector<std::string> folders = {};  // whose content is the command's
};

/// An output would overwrite what is read: nothing at all is to be written.
class WouldOverwrite : public InputError {
 public:
  using InputError::InputError;
};

/// For every command that writes, before its work, with what it reads as far as that is
/// known: throws WouldOverwrite for one of `inputs`, and InputError if two outputs are
/// one file, or one cannot be written. Files are the same whatever links lead to them.
void CheckOutputPaths(OutputPaths outputs, const std::set<std::string>& inputs);

/// Throws InputError unless a file can be created at `path`: its directory exists and is
/// writable, and what exists there is a regular file. Leaves nothing behind.
void CheckWritable(const std::string& path);

/// Where a result goes that could not be written to `path`: a file of the temporary
/// directory that does not exist.
std::string FallbackPath(const std::string& path);

}  // namespace lanelight
