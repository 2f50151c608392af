#include "bench/resident.h"

#include <fstream>
#include <string>

namespace lanelight::bench {
namespace {

std::size_t FromStatus(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    std::size_t kib = 0;
    if (word == name && status >> kib) return kib << 10;
  }
  return 0;
}

}  // namespace

std::size_t ResidentBytes() { return FromStatus("VmRSS:"); }
std::size_t PeakResidentBytes() { return FromStatus("VmHWM:"); }

bool ForgetPeak() {
  std::ofstream refs("/proc/self/clear_refs");
  refs << "5" << std::flush;
  return refs.good();
}

}  // namespace lanelight::bench
