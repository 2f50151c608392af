// The page and its sockets, on the loopback alone.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "src/measure/live/view.h"

namespace lanelight::live {

/// Sockets at once, and pages that are being fetched.
inline constexpr int kMaxPages = 8;
inline constexpr int kMaxConnections = 32;
/// Maximum number of connections from one address, so that one client cannot take all.
inline constexpr int kMaxPerAddress = kMaxConnections / 2;

/// Returns whether a client may connect, given how many connections each address has.
template <typename Counts, typename Address>
bool MayConnect(const Counts& connections, const Address& client) {
  int all = 0, own = 0;
  for (const auto& [address, count] : connections) {
    all += count;
    if (address == client) own = count;
  }
  return all < kMaxConnections && own < kMaxPerAddress;
}

class Server {
 public:
  /// Listens on 127.0.0.1; port 0: any that is free. `command` as of Session. Throws
  /// InputError if the port cannot be had.
  Server(const LiveScene& live_scene, std::string command, std::uint16_t port);
  ~Server();

  /// Returns the address of the page, with the token.
  std::string address() const;
  /// Serves until `stop` is set; then it says goodbye to all pages.
  void Run(const std::atomic<bool>& stop);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lanelight::live
