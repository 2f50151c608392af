#include "src/measure/live/access_check.h"

#include <fmt/format.h>

#include <random>

namespace lanelight::live {

std::string MakeToken() {
  std::random_device device;  // reads the system's randomness
  std::string token;
  for (int i = 0; i < 4; ++i) token += fmt::format("{:08x}", device() & 0xffffffffu);
  return token;
}

bool SameToken(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
  }
  return difference == 0;
}

bool AccessCheck::IsOwnHost(const std::string& host) const {
  return host == fmt::format("127.0.0.1:{}", port_) ||
         host == fmt::format("localhost:{}", port_);
}

std::string AccessCheck::Address() const {
  return fmt::format("http://127.0.0.1:{}/{}/", port_, token_);
}

Decision AccessCheck::Decide(const HttpRequest& request) const {
  if (!IsOwnHost(request.host)) {
    return {Answer::kRefused, 403, "the Host of the request is not this server's"};
  }
  if (request.method != "GET") {
    return {Answer::kRefused, 405, "only GET is understood"};
  }
  const std::size_t end = request.target.find('/', 1);
  const bool has_token =
      end != std::string::npos && request.target[0] == '/' &&
      SameToken(std::string_view(request.target).substr(1, end - 1), token_);
  if (!has_token) {
    return {
        Answer::kRefused, 404,
        "unknown address; open the address that `lanelight live` prints, with its token"};
  }
  const std::string rest = request.target.substr(end);
  if (rest == "/" && !request.upgrade) return {Answer::kPage, 200, ""};
  if (rest != "/socket" || !request.upgrade) {
    return {Answer::kRefused, 404,
            "unknown path; this server has only the page and its socket"};
  }
  if (request.origin != "http://" + request.host) {
    return {Answer::kRefused, 403, "the Origin of the socket is not this server's page"};
  }
  return {Answer::kSocket, 101, ""};
}

}  // namespace lanelight::live
