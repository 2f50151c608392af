#include "src/base/core/connection.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <limits>

#include "src/base/core/stopwatch.h"
#include "src/base/core/value_types.h"

namespace lanelight {
namespace {

constexpr int kPollMilliseconds = 50;

double Now() { return SecondsSince({}); }

// True if the socket can be written to in time; false with errno 0 if not.
bool WaitToWrite(int socket, int milliseconds) {
  pollfd file = {socket, POLLOUT, 0};
  errno = 0;
  return poll(&file, 1, milliseconds) > 0;
}

// Returns 0, or the error number.
int Connect(int socket, const addrinfo& address, double seconds) {
  if (connect(socket, address.ai_addr, address.ai_addrlen) == 0) return 0;
  if (errno != EINPROGRESS) return errno;
  if (!WaitToWrite(socket, static_cast<int>(1000 * seconds))) return ETIMEDOUT;
  int error = 0;
  socklen_t size = sizeof(error);
  getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &size);
  return error;
}

}  // namespace

std::string Endpoint::Text() const {
  const bool v6 = host.find(':') != host.npos;
  return fmt::format("{}{}{}:{}", v6 ? "[" : "", host, v6 ? "]" : "", port);
}

std::optional<Endpoint> EndpointType::Read(const std::string& text) const {
  std::string host = text, port;
  const std::size_t bracket = text.rfind(']');
  const std::size_t colon = text.rfind(':');
  const bool is_behind = bracket == text.npos || (colon != text.npos && colon > bracket);
  if (colon != text.npos && is_behind) {
    host = text.substr(0, colon);
    port = text.substr(colon + 1);
    if (port.empty()) return {};
  }
  if (host.starts_with('[') && host.ends_with(']')) {
    host = host.substr(1, host.size() - 2);
  } else if (host.find(':') != host.npos) {
    return {};  // an address of IPv6, whose last part may be a port or not
  }
  const auto number =
      port.empty() ? default_port : ParseNumber<std::uint16_t>(port).value_or(0);
  if (host.empty() || number == 0) return {};
  return Endpoint{host, number};
}

std::string EndpointType::Right(const std::string&) const {
  return fmt::format("HOST:PORT, e.g. localhost:{} or [::1]:{}", default_port,
                     default_port);
}

std::unique_ptr<Connection> Connection::Open(const Endpoint& endpoint, double seconds,
                                             std::string& why) {
  addrinfo hints = {};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const std::string port = std::to_string(endpoint.port);
  const int failed = getaddrinfo(endpoint.host.c_str(), port.c_str(), &hints, &found);
  if (failed != 0) {
    why = gai_strerror(failed);
    return nullptr;
  }
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> addresses(found, freeaddrinfo);
  for (const addrinfo* a = found; a != nullptr; a = a->ai_next) {
    FileDescriptor descriptor(socket(
        a->ai_family, a->ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, a->ai_protocol));
    const int error =
        descriptor.get() < 0 ? errno : Connect(descriptor.get(), *a, seconds);
    if (error == 0) {
      return std::unique_ptr<Connection>(new Connection(std::move(descriptor)));
    }
    why = std::strerror(error);
  }
  return nullptr;
}

Connection::Sent Connection::Send(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = send(socket_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (n >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(n));
      continue;
    }
    if (errno == EINTR) continue;
    if (errno != EAGAIN && errno != EWOULDBLOCK) {
      error_ = errno;
      return Sent::kFailed;
    }
    if (IsOver()) return Sent::kGaveUp;
    WaitToWrite(socket_.get(), kPollMilliseconds);
  }
  return Sent::kAll;
}

void Connection::SetDeadline(double seconds) { deadline_ = Now() + seconds; }

bool Connection::IsOver() const { return Now() > deadline_; }

std::string Connection::Reason() const { return std::strerror(error_); }

}  // namespace lanelight
