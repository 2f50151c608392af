// The processes (ranks) that were started together, from the first line of main to the
// last. There are two of these: alone.cc, and mpi.cc with all other files of this folder;
// a program is linked with one of them.
#pragma once

#include <memory>
#include <string>

#include "src/wavefront/crew.h"

namespace lanelight {

class Ranks {
 public:
  virtual ~Ranks() = default;
  virtual Crew& crew() = 0;
  /// All ranks call this. On the leader: which rank, on which host, has another number
  /// than itself, e.g. "rank 2 on node7"; empty if none has, and on the others.
  virtual std::string WhoDiffers(int number) = 0;
  /// The last call where all went well, also after a signal: returns the exit code.
  virtual int Leave(int exit_code) = 0;
  /// The last call of a rank that has failed: the leader, who has said why itself, ends
  /// all ranks; another one tells the leader and waits for its end. Returns the exit code
  /// where there is nobody else.
  virtual int Fail(int exit_code, const std::string& message) = 0;
};

/// Before anything else; both are as main has them.
std::unique_ptr<Ranks> JoinRanks(int* argc, char*** argv);

}  // namespace lanelight
