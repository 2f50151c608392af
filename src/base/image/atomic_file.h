// Files that appear whole or not at all.
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

/// The file that a symbolic link leads to, by whatever links, whether it exists or not;
/// other paths as they are.
std::string LinkTarget(const std::string& path);

/// What the names of its temporary files begin with, before ".<digits>.<digits>.tmp":
/// `path`, or as much of it as leaves room for that.
std::string TemporaryStart(const std::string& path);
/// Removes the temporary files of `path` that killed processes left. No process may be
/// writing `path`.
void RemoveTemporaries(const std::string& path);

/// Throws InputError with the system's reason if WriteFileAtomically could not even
/// begin: no temporary file can be created beside `path`. Leaves nothing behind.
void CheckCreatable(const std::string& path);

}  // namespace lanelight
