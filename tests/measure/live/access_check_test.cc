// Who may come in.
#include "src/measure/live/access_check.h"

#include <catch2/catch.hpp>
#include <set>

namespace lanelight::live {
namespace {

const std::string kAccessToken = "0123456789abcdef0123456789abcdef";

HttpRequest PageRequest() {
  return {"GET", "/" + kAccessToken + "/", "127.0.0.1:8080", "", false};
}
HttpRequest SocketRequest() {
  return {"GET", "/" + kAccessToken + "/socket", "127.0.0.1:8080",
          "http://127.0.0.1:8080", true};
}

unsigned StatusOf(const HttpRequest& request) {
  return AccessCheck(8080, kAccessToken).Decide(request).status;
}

}  // namespace

TEST_CASE("tokens are long, different, and compared as a whole", "[live]") {
  std::set<std::string> tokens;
  for (int i = 0; i < 100; ++i) tokens.insert(MakeToken());
  CHECK(tokens.size() == 100);
  for (const std::string& token : tokens) {
    CHECK(token.size() == 32);
    CHECK(token.find_first_not_of("0123456789abcdef") == std::string::npos);
  }
  CHECK(SameToken("abc", "abc"));
  CHECK_FALSE(SameToken("abc", "abd"));
  CHECK_FALSE(SameToken("abc", "ab"));
  CHECK_FALSE(SameToken("", "abc"));
}

TEST_CASE("the page and its socket require the token", "[live]") {
  const AccessCheck access(8080, kAccessToken);
  CHECK(access.Address() == "http://127.0.0.1:8080/" + kAccessToken + "/");
  CHECK(access.Decide(PageRequest()).answer == Answer::kPage);
  CHECK(access.Decide(SocketRequest()).answer == Answer::kSocket);
  for (const char* target : {"/", "", "x", "//", "/0123456789abcdef0123456789abcdee/",
                             "/0123456789abcdef0123456789abcdef", "/favicon.ico"}) {
    HttpRequest request = PageRequest();
    request.target = target;
    INFO(target);
    CHECK(access.Decide(request).answer == Answer::kRefused);
    CHECK(StatusOf(request) == 404);
    request = SocketRequest();
    request.target = target + std::string("socket");
    CHECK(access.Decide(request).answer == Answer::kRefused);
  }
}

TEST_CASE("foreign host names that resolve to loopback are refused", "[live]") {
  for (const char* host : {"", "evil.example:8080", "127.0.0.1", "127.0.0.1:80",
                           "127.0.0.1:8080.evil.example", "0.0.0.0:8080", "[::1]:8080"}) {
    HttpRequest request = PageRequest();
    request.host = host;
    INFO(host);
    CHECK(StatusOf(request) == 403);
  }
  HttpRequest local = PageRequest();
  local.host = "localhost:8080";
  CHECK(StatusOf(local) == 200);
}

TEST_CASE("sockets of other pages are refused", "[live]") {
  for (const char* origin : {"", "null", "http://evil.example", "http://127.0.0.1",
                             "https://127.0.0.1:8080", "http://localhost:8080"}) {
    HttpRequest request = SocketRequest();
    request.origin = origin;
    INFO(origin);
    CHECK(StatusOf(request) == 403);
  }
  HttpRequest post = PageRequest();
  post.method = "POST";
  CHECK(StatusOf(post) == 405);
}

}  // namespace lanelight::live
