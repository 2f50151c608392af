#include "src/ranks/mail.h"

#include <limits>
#include <utility>

#include "src/core/check.h"
#include "src/ranks/naps.h"

namespace lanelight {

Mail::Mail() {
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks_);
}

void Mail::Send(int to, Tag tag, std::string bytes) {
  LL_CHECK_LE(bytes.size(), std::size_t(std::numeric_limits<int>::max()));
  bytes_ += bytes.size();
  Letter& letter = letters_.emplace_back();
  letter.bytes = std::move(bytes);
  MPI_Isend(letter.bytes.data(), static_cast<int>(letter.bytes.size()), MPI_BYTE, to,
            static_cast<int>(tag), MPI_COMM_WORLD, &letter.request);
}

bool Mail::Sent() {
  letters_.remove_if([](Letter& letter) {
    int done = 0;
    MPI_Test(&letter.request, &done, MPI_STATUS_IGNORE);
    return done != 0;
  });
  return letters_.empty();
}

void Mail::AwaitSent() {
  for (Naps naps; !Sent();) naps.Take(false);
}

std::optional<Message> Mail::Receive(int from) {
  int there = 0, size = 0;
  MPI_Message handle;
  MPI_Status status;
  MPI_Improbe(from, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &handle, &status);
  if (!there) return std::nullopt;
  MPI_Get_count(&status, MPI_BYTE, &size);
  Message message = {static_cast<Tag>(status.MPI_TAG),
                     std::string(static_cast<std::size_t>(size), '\0')};
  bytes_ += message.bytes.size();
  MPI_Mrecv(message.bytes.data(), size, MPI_BYTE, &handle, MPI_STATUS_IGNORE);
  return message;
}

Message Mail::Await(int from) {
  for (Naps naps;; naps.Take(false)) {
    Sent();
    if (auto message = Receive(from)) return std::move(*message);
  }
}

}  // namespace lanelight
