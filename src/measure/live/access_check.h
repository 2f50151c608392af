// Access rules of the live server, apart from its sockets: addresses, origins and the
// secret token.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace lanelight::live {

/// Returns 128 bits from the system's source of randomness, as 32 hexadecimal digits.
std::string MakeToken();

/// Returns whether both are the same, in a time that does not depend on their contents.
bool SameToken(std::string_view a, std::string_view b);

/// The parts of a request that decide access; parts that are missing are empty.
struct HttpRequest {
  std::string method, target, host, origin;
  bool upgrade = false;  // it asks for a WebSocket
};

enum class Answer { kPage, kSocket, kRefused };

struct Decision {
  Answer answer = Answer::kRefused;
  unsigned status = 404;  // of HTTP, if it is refused
  std::string why;        // if it is refused
};

/// Host must be this loopback address and port: a name that an attacker has pointed at
/// the loopback (DNS rebinding) is not. A socket's Origin must be this very server: pages
/// of others may open sockets to anywhere, and browsers tell whose page it is. The page
/// lies at /TOKEN/ and its socket at /TOKEN/socket; without the token nothing is there.
class AccessCheck {
 public:
  AccessCheck(std::uint16_t port, std::string token)
      : port_(port), token_(std::move(token)) {}

  Decision Decide(const HttpRequest& request) const;
  /// "http://127.0.0.1:PORT/TOKEN/".
  std::string Address() const;

 private:
  bool IsOwnHost(const std::string& host) const;

  std::uint16_t port_;
  std::string token_;
};

}  // namespace lanelight::live
