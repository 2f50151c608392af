#include "src/core/memory_nodes.h"

#if defined(__linux__)
#include <sched.h>
#endif

#include <algorithm>
#include <charconv>
#include <exception>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

namespace lanelight {
namespace {

// The numbers n of the entries "<prefix>n" of a directory, ascending; none if it cannot
// be read.
std::vector<int> NumberedEntries(const std::filesystem::path& directory,
                                 std::string_view prefix) {
  std::vector<int> numbers;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(directory, error), end;
       !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with(prefix)) continue;
    const char* const last = name.data() + name.size();
    int number = 0;
    const auto read = std::from_chars(name.data() + prefix.size(), last, number);
    if (read.ec == std::errc() && read.ptr == last) numbers.push_back(number);
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

// Whether the process may run on one of them; true where that is not known.
bool MayRunOn([[maybe_unused]] const std::vector<int>& processors) {
#if defined(__linux__)
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof(set), &set) != 0) return true;
  return std::any_of(processors.begin(), processors.end(),
                     [&](int p) { return p < CPU_SETSIZE && CPU_ISSET(p, &set); });
#else
  return true;
#endif
}

// Where the process may not run on any of them, this thread stays where it is.
void RunOn([[maybe_unused]] const std::vector<int>& processors) {
#if defined(__linux__)
  cpu_set_t set;
  CPU_ZERO(&set);
  for (const int p : processors) {
    if (p < CPU_SETSIZE) CPU_SET(p, &set);
  }
  sched_setaffinity(0, sizeof(set), &set);
#endif
}

}  // namespace

MemoryNodes MemoryNodes::OfMachine(const std::filesystem::path& directory) {
  std::vector<std::vector<int>> processors;
  for (const int node : NumberedEntries(directory, "node")) {
    auto own = NumberedEntries(directory / ("node" + std::to_string(node)), "cpu");
    if (!own.empty() && MayRunOn(own)) processors.push_back(std::move(own));
  }
  if (processors.empty()) processors.emplace_back();
  return MemoryNodes(std::move(processors));
}

MemoryNodes::MemoryNodes(std::vector<std::vector<int>> processors)
    : processors_(std::move(processors)) {
  for (int node = 0; node < size(); ++node) {
    for (const int p : processors_[static_cast<std::size_t>(node)]) {
      const auto index = static_cast<std::size_t>(p);
      if (node_of_.size() <= index) node_of_.resize(index + 1, 0);
      node_of_[index] = node;
    }
  }
}

int MemoryNodes::Here() const {
#if defined(__linux__)
  if (size() == 1) return 0;
  const int processor = sched_getcpu();
  if (processor < 0 || static_cast<std::size_t>(processor) >= node_of_.size()) return 0;
  return node_of_[static_cast<std::size_t>(processor)];
#else
  return 0;
#endif
}

void MemoryNodes::OnEach(const std::function<void(int node)>& work) const {
  std::vector<std::exception_ptr> failed(processors_.size());
  std::vector<std::thread> threads;
  for (std::size_t n = 0; n < processors_.size(); ++n) {
    threads.emplace_back([&, n] {
      RunOn(processors_[n]);
      try {
        work(static_cast<int>(n));
      } catch (...) {
        failed[n] = std::current_exception();
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const std::exception_ptr& failure : failed) {
    if (failure) std::rethrow_exception(failure);
  }
}

const MemoryNodes& NodesOfMachine() {
  static const MemoryNodes nodes = MemoryNodes::OfMachine();
  return nodes;
}

}  // namespace lanelight
