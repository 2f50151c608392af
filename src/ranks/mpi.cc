// Ranks that talk by MPI (docs/mpi.md). Only the main thread of a process calls MPI, and
// nobody waits in it: all waiting is polling with naps, so that a rank that waits leaves
// its core to others.
//
// The leader sends batches of tiles, each with the sums of its pixels so far, and gets
// the sums back with more samples in them. The samples of a pixel are so always added in
// the same order, whoever renders them: the image has the bits of a single process.
#include <mpi.h>

#include <vector>

#include "src/core/check.h"
#include "src/ranks/mpi_crew.h"
#include "src/ranks/ranks.h"

namespace lanelight {
namespace {

class MpiRanks : public Ranks {
 public:
  Crew& crew() override { return crew_; }

  std::string WhoDiffers(int number) override {
    std::vector<int> numbers(static_cast<std::size_t>(crew_.ranks()));
    MPI_Allgather(&number, 1, MPI_INT, numbers.data(), 1, MPI_INT, MPI_COMM_WORLD);
    for (int r = 1; r < crew_.ranks(); ++r) {
      if (crew_.leads() && numbers[static_cast<std::size_t>(r)] != number) {
        return crew_.Name(r);
      }
    }
    return "";
  }

  // A rank that has not answered will not come to the end either.
  int Leave(int exit_code) override {
    if (crew_.gave_up()) MPI_Abort(MPI_COMM_WORLD, exit_code);
    MPI_Finalize();
    return exit_code;
  }

  int Fail(int exit_code, const std::string& message) override {
    if (!crew_.leads()) crew_.Confess(message);
    if (crew_.ranks() > 1) MPI_Abort(MPI_COMM_WORLD, exit_code);
    MPI_Finalize();
    return exit_code;
  }

 private:
  MpiCrew crew_;
};

}  // namespace

std::unique_ptr<Ranks> JoinRanks(int* argc, char*** argv) {
  int provided = 0;
  MPI_Init_thread(argc, argv, MPI_THREAD_FUNNELED, &provided);
  LL_CHECK_GE(provided, int{MPI_THREAD_FUNNELED});
  return std::make_unique<MpiRanks>();
}

}  // namespace lanelight
