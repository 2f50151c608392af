// A TCP connection to a server that only sends, with a limit on how long it waits.
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "src/base/core/input_file.h"

namespace lanelight {

struct Endpoint {
  std::string host;
  std::uint16_t port = 0;

  /// "localhost:14158"
  std::string Text() const;
};

/// "HOST:PORT", or a host alone with `default_port`; an IPv6 address in brackets. As in
/// src/base/core/value_types.h.
struct EndpointType {
  std::uint16_t default_port;

  std::optional<Endpoint> Read(const std::string& text) const;
  std::string Write(const Endpoint& endpoint) const { return endpoint.Text(); }
  std::string Right(const std::string&) const;
};

class Connection {
 public:
  /// Connects, waiting up to `seconds` for each address of the host. Null, with the
  /// reason in `why`, if none answers.
  static std::unique_ptr<Connection> Open(const Endpoint& endpoint, double seconds,
                                          std::string& why);

  enum class Sent { kAll, kFailed, kGaveUp };
  /// Sends all, without a time limit until SetDeadline() is called. kFailed: the
  /// connection is lost; Reason() then says why.
  Sent Send(std::string_view bytes);
  /// Limits sending to `seconds` from now on. Called once, from any thread.
  void SetDeadline(double seconds);
  std::string Reason() const;

 private:
  explicit Connection(FileDescriptor socket) : socket_(std::move(socket)) {}
  bool IsOver() const;

  FileDescriptor socket_;
  int error_ = 0;
  // Seconds of the steady clock.
  std::atomic<double> deadline_{std::numeric_limits<double>::infinity()};
};

}  // namespace lanelight
