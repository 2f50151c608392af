// Writes files so that they are complete or absent.
#pragma once

#include <string>
#include <string_view>

namespace lanelight {

/// Writes `content` to a temporary file in the directory of `path`, flushes it to disk,
/// and renames it over `path` with the permissions of a new file. Then flushes the
/// directory. On failure (missing directory, no permission, full disk) the temporary file
/// is removed, `path` stays as it was, and InputError names the path and the reason. The
/// target of a symbolic link is replaced, not the link. Pipes and sockets are refused.
void WriteFileAtomically(const std::string& path, std::string_view content);

/// Follows symbolic links and returns the final path, whether it exists or not.
std::string LinkTarget(const std::string& path);

/// Returns the beginning of the names of temporary files of `path`, before
/// ".<digits>.<digits>.tmp": the path, shortened if needed.
std::string TemporaryStart(const std::string& path);
/// Removes temporary files of `path` left by killed processes. No process may be writing
/// `path` at the same time.
void RemoveTemporaries(const std::string& path);

/// Throws InputError if no temporary file can be created beside `path`, so that
/// WriteFileAtomically would fail.
void CheckCreatable(const std::string& path);

}  // namespace lanelight
