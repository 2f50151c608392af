#include "src/render/job/checkpoint.h"

#include <fmt/format.h>

#include <unistd.h>

#include <climits>

#include "src/base/core/error.h"
#include "src/base/image/atomic_file.h"

namespace lanelight {
namespace {

std::string ProcessName() {
  char host[HOST_NAME_MAX + 1] = "";
  gethostname(host, sizeof(host) - 1);
  return fmt::format("process {} on {}", getpid(), host);
}

}  // namespace

StateLock::StateLock(const std::string& path,
                     const std::function<void(const std::string&)>& on_problem) {
  do {
    lock_.reset();
    file_.emplace(LinkTarget(path) + ".lock");
    if (!file_->supports_locks()) {
      on_problem(
          fmt::format("{}: this file system has no locks: make sure that no other "
                      "process writes '{}'",
                      file_->path(), path));
      unlink(file_->path().c_str());
      file_.reset();
      return;
    }
    lock_ = file_->TryLock("state");
    if (!lock_) {
      const std::string who = file_->Note();
      throw InputError(fmt::format(
          "'{}' is in use by {}: wait for it or stop it, or use another state file", path,
          who.empty() ? "another process" : who));
    }
    // The previous owner may have removed the file just after it was opened here.
  } while (!file_->IsNamed());
  file_->SetNote(ProcessName());
  // The owner of the lock is the only writer of these files.
  RemoveTemporaries(path);
}

// Removes the file before unlocking it: another process cannot own the lock of an
// existing file.
StateLock::~StateLock() {
  if (file_ && file_->IsNamed()) unlink(file_->path().c_str());
}

}  // namespace lanelight
