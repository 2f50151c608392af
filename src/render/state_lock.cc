#include "src/render/state_lock.h"

#include <unistd.h>

#include <climits>

#include "src/core/error.h"
#include "src/image/atomic_file.h"

namespace lanelight {
namespace {

std::string WhoAmI() {
  char host[HOST_NAME_MAX + 1] = "";
  gethostname(host, sizeof(host) - 1);
  return fmt::format("process {} on {}", getpid(), host);
}

}  // namespace

StateLock::StateLock(const std::string& path,
                     const std::function<void(const std::string&)>& on_problem) {
  const std::string name = path + ".lock";
  for (;;) {
    auto file = std::make_unique<LockFile>(name);
    const LockOutcome outcome = file->TryLock(0, 1);
    if (outcome == LockOutcome::kUnknown) {
      on_problem(fmt::format(
          "{}: this file system knows no locks: see to it that nobody else keeps '{}'",
          name, path));
      unlink(name.c_str());
      return;
    }
    if (outcome == LockOutcome::kBusy) {
      const std::string who = file->Note();
      throw InputError(fmt::format(
          "'{}' is being kept by {}: let that end or stop it, or keep this state "
          "in another file",
          path, who.empty() ? "another process" : who));
    }
    // Who had it before may have removed the file just after it was opened here.
    if (!file->IsNamed()) continue;
    file->SetNote(WhoAmI());
    file_ = std::move(file);
    // Only who keeps a state writes it: with the lock, nobody is at work on these.
    RemoveTemporaries(path);
    return;
  }
}

// Removed first, unlocked then: nobody else can have the lock of a file that is there.
StateLock::~StateLock() {
  if (file_ && file_->IsNamed()) unlink(file_->path().c_str());
}

}  // namespace lanelight
