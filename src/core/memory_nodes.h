// Memory nodes (NUMA): which processors are near to which memory.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

namespace lanelight {

class MemoryNodes {
 public:
  /// Those of this machine on whose processors the process may run, as Linux lists them
  /// in `directory`; one node where it does not.
  static MemoryNodes OfMachine(
      const std::filesystem::path& directory = "/sys/devices/system/node");
  /// processors[n]: numbers of the processors of node n. Tests make up their own.
  explicit MemoryNodes(std::vector<std::vector<int>> processors);

  int size() const { return static_cast<int>(processors_.size()); }
  /// Node of the processor that runs this; 0 if that is unknown. A thread that the system
  /// moves to another processor is elsewhere from then on.
  int Here() const;
  /// Calls work(n) for each node in a thread of its own, which runs on processors of that
  /// node if the process may: what it is the first to write lies in the memory there. The
  /// first exception of one is rethrown, when all have ended.
  void OnEach(const std::function<void(int node)>& work) const;

 private:
  std::vector<std::vector<int>> processors_;
  std::vector<int> node_of_;  // of each processor; 0 for unknown ones
};

/// Those of this machine, looked up once.
const MemoryNodes& NodesOfMachine();

}  // namespace lanelight
