#include "src/sweep/claims.h"

#include <chrono>
#include <thread>
#include <utility>

#include "src/core/error.h"
#include "src/sweep/grid.h"

namespace lanelight {
namespace {

// Bytes beyond the end of a file can be locked too.
std::uint64_t ByteOf(const std::string& key) {
  return HashText(key) & ((std::uint64_t{1} << 62) - 1);
}

}  // namespace

Claims::Claim::Claim(Claim&& other) noexcept
    : file_(std::exchange(other.file_, nullptr)), byte_(other.byte_) {}

Claims::Claim::~Claim() {
  if (file_ != nullptr) file_->Unlock(byte_, 1);
}

Claims::Claims(const std::string& path, bool optional) : file_(path) {
  const std::uint64_t probe = ByteOf("is there locking?");
  const LockOutcome outcome = file_.TryLock(probe, 1);
  if (outcome == LockOutcome::kTaken) file_.Unlock(probe, 1);
  if (outcome != LockOutcome::kUnknown) return;
  locking_ = false;
  if (optional) return;
  throw InputError(
      fmt::format("the file system of '{}' has no locks, by which processes agree on who "
                  "renders what; give each process a part of its own with --part I/N",
                  path));
}

std::optional<Claims::Claim> Claims::Take(const std::string& key) const {
  if (!locking_) return Claim(nullptr, 0);
  const std::uint64_t byte = ByteOf(key);
  if (file_.TryLock(byte, 1) != LockOutcome::kTaken) return std::nullopt;
  return Claim(&file_, byte);
}

std::optional<Claims::Claim> Claims::Wait(const std::string& key,
                                          const std::atomic<bool>* stop) const {
  // Not F_OFD_SETLKW, which signals do not end where they restart system calls.
  constexpr auto kPause = std::chrono::milliseconds(50);
  while (stop == nullptr || !*stop) {
    if (auto claim = Take(key)) return claim;
    std::this_thread::sleep_for(kPause);
  }
  return std::nullopt;
}

}  // namespace lanelight
