#include "src/render/mpi/mpi_group.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "src/base/core/check.h"
#include "src/render/mpi/join_ranks.h"

namespace lanelight {
namespace {

using std::chrono::microseconds;

// Naps of a rank that waits: a tenth of what it has waited, since a collective takes some
// steps that are made when all have called again. Each nap costs two switches of
// processes where ranks share a core.
constexpr microseconds kMinPollDelay(100), kMaxPollDelay(10000);
// While bytes are on their way, which MPI moves piece by piece when it is called.
constexpr microseconds kTransferPollDelay(100);

// Returns whether the request has ended; if not, the caller has given up.
bool Await(MPI_Request request, microseconds longest = kMaxPollDelay,
           const std::function<bool()>& should_stop = nullptr) {
  int done = 0;
  for (microseconds waited(0), nap(0);; waited += nap) {
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done != 0) return true;
    if (should_stop && should_stop()) return false;
    nap = std::clamp(waited / 10, kMinPollDelay, longest);
    std::this_thread::sleep_for(nap);
  }
}

// MPI counts in int.
constexpr std::size_t kPiece = std::size_t{1} << 30;

// Calls post(address, count), which returns a request, for one piece after the other.
template <class Post>
void InPieces(char* bytes, std::size_t size, const Post& post) {
  for (std::size_t at = 0; at < size; at += kPiece) {
    Await(post(bytes + at, int(std::min(kPiece, size - at))), kTransferPollDelay);
  }
}

void Send(std::span<const char> bytes, int to) {
  // MPI does not write to what it sends.
  InPieces(const_cast<char*>(bytes.data()), bytes.size(), [to](char* at, int count) {
    MPI_Request request;
    MPI_Isend(at, count, MPI_BYTE, to, 0, MPI_COMM_WORLD, &request);
    return request;
  });
}

void Receive(std::span<char> bytes, int from) {
  InPieces(bytes.data(), bytes.size(), [from](char* at, int count) {
    MPI_Request request;
    MPI_Irecv(at, count, MPI_BYTE, from, 0, MPI_COMM_WORLD, &request);
    return request;
  });
}

}  // namespace

MpiGroup::MpiGroup() {
  int ranks = 1, length = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  constexpr std::size_t kSize = MPI_MAX_PROCESSOR_NAME;
  char own[kSize] = {};
  MPI_Get_processor_name(own, &length);
  std::vector<char> hosts(kSize * std::size_t(ranks));
  MPI_Allgather(own, kSize, MPI_CHAR, hosts.data(), kSize, MPI_CHAR, MPI_COMM_WORLD);
  for (int r = 0; r < ranks; ++r) {
    hosts_.emplace_back(&hosts[kSize * std::size_t(r)]);
  }
}

std::string MpiGroup::Name(int rank) const {
  return fmt::format("rank {} on {}", rank, hosts_[std::size_t(rank)]);
}

std::vector<int> MpiGroup::AllGather(int number) {
  PollFailures();
  std::vector<int> numbers(hosts_.size());
  MPI_Request request;
  MPI_Iallgather(&number, 1, MPI_INT, numbers.data(), 1, MPI_INT, MPI_COMM_WORLD,
                 &request);
  Await(request);
  return numbers;
}

void MpiGroup::Broadcast(std::span<char> bytes) {
  PollFailures();
  bytes_ += bytes.size();
  InPieces(bytes.data(), bytes.size(), [](char* at, int count) {
    MPI_Request request;
    MPI_Ibcast(at, count, MPI_BYTE, 0, MPI_COMM_WORLD, &request);
    return request;
  });
}

void MpiGroup::Gather(std::string_view bytes, const Receiver& receive) {
  PollFailures();
  Collect(bytes, receive);
}

// One worker after the other: the leader has room for the largest part only.
void MpiGroup::Collect(std::string_view bytes, const Receiver& receive) {
  std::uint64_t size = bytes.size();
  const std::span<char> head(reinterpret_cast<char*>(&size), sizeof(size));
  if (!is_leader()) {
    Send(head, 0);
    return Send(bytes, 0);
  }
  for (int r = 1; r < ranks(); ++r) {
    Receive(head, r);
    in_.resize(size);
    Receive(in_, r);
    bytes_ += size;
    receive(r, in_);
  }
}

bool MpiGroup::SwapBytes(int partner, std::span<char> out, std::span<char> in,
                         const std::function<bool()>& should_stop) {
  constexpr int kTag = 1;
  MPI_Request requests[2];
  MPI_Isend(out.data(), int(out.size()), MPI_BYTE, partner, kTag, MPI_COMM_WORLD,
            &requests[0]);
  MPI_Irecv(in.data(), int(in.size()), MPI_BYTE, partner, kTag, MPI_COMM_WORLD,
            &requests[1]);
  bytes_ += out.size() + in.size();
  return Await(requests[1], kTransferPollDelay, should_stop) &&
         Await(requests[0], kTransferPollDelay, should_stop);
}

std::optional<std::string> MpiGroup::Swap(int partner, std::string bytes,
                                          const std::function<bool()>& should_stop) {
  out_ = std::move(bytes);
  out_size_ = out_.size();
  LL_CHECK_LE(out_size_, kPiece);
  const auto span = [](std::uint64_t& size) {
    return std::span<char>(reinterpret_cast<char*>(&size), sizeof(size));
  };
  aborted_ = !SwapBytes(partner, span(out_size_), span(in_size_), should_stop);
  if (aborted_) return std::nullopt;
  in_.resize(in_size_);
  aborted_ = !SwapBytes(partner, out_, in_, should_stop);
  if (aborted_) return std::nullopt;
  return in_;
}

std::optional<RankStatus> MpiGroup::Sum(const RankStatus& own,
                                        const std::function<bool()>& should_stop) {
  static_assert(sizeof(RankStatus) % sizeof(std::uint64_t) == 0);
  sum_ = own;
  MPI_Request request;
  MPI_Iallreduce(MPI_IN_PLACE, &sum_, sizeof(sum_) / sizeof(std::uint64_t), MPI_UINT64_T,
                 MPI_SUM, MPI_COMM_WORLD, &request);
  aborted_ = !Await(request, kMaxPollDelay, should_stop);
  if (aborted_) return std::nullopt;
  return sum_;
}

// Precedes every collective call; a failed rank calls only this.
void MpiGroup::PollFailures() {
  if (Sum({}, nullptr)->failed > 0) ThrowFailure();
}

void MpiGroup::ThrowFailure() {
  failed_ = true;
  std::string first;
  Collect("", [&](int rank, std::string_view why) {
    if (first.empty() && !why.empty()) first = fmt::format("{}: {}", Name(rank), why);
  });
  throw RankFailure("error: " + first);
}

// A rank that has not answered will not come to the end either.
int MpiGroup::Leave(int exit_code) {
  if (aborted_) MPI_Abort(MPI_COMM_WORLD, exit_code);
  MPI_Finalize();
  return exit_code;
}

int MpiGroup::Fail(int exit_code, const std::string& message) {
  if (is_leader()) {
    if (ranks() > 1) MPI_Abort(MPI_COMM_WORLD, exit_code);
    MPI_Finalize();
    return exit_code;
  }
  if (!failed_) {
    RankStatus status;
    status.failed = 1;
    Sum(status, nullptr);
    Collect(message, nullptr);
  }
  while (true) std::this_thread::sleep_for(std::chrono::hours(1));  // for the leader
}

std::unique_ptr<RankGroup> JoinRanks(int* argc, char*** argv) {
  int provided = 0;
  MPI_Init_thread(argc, argv, MPI_THREAD_FUNNELED, &provided);
  LL_CHECK_GE(provided, int{MPI_THREAD_FUNNELED});
  return std::make_unique<MpiGroup>();
}

}  // namespace lanelight
