// Who may come in.
#include "src/measure/live/door.h"

#include <catch2/catch.hpp>
#include <set>

#include "src/measure/live/token.h"

namespace lanelight::live {
namespace {

const std::string kDoorToken = "0123456789abcdef0123456789abcdef";

Visit PageVisit() { return {"GET", "/" + kDoorToken + "/", "127.0.0.1:8080", "", false}; }
Visit SocketVisit() {
  return {"GET", "/" + kDoorToken + "/socket", "127.0.0.1:8080", "http://127.0.0.1:8080",
          true};
}

unsigned StatusOf(const Visit& visit) {
  return Door(8080, kDoorToken).Decide(visit).status;
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

TEST_CASE("the page and its socket are behind the token", "[live]") {
  const Door door(8080, kDoorToken);
  CHECK(door.Address() == "http://127.0.0.1:8080/" + kDoorToken + "/");
  CHECK(door.Decide(PageVisit()).answer == Answer::kPage);
  CHECK(door.Decide(SocketVisit()).answer == Answer::kSocket);
  for (const char* target : {"/", "", "x", "//", "/0123456789abcdef0123456789abcdee/",
                             "/0123456789abcdef0123456789abcdef", "/favicon.ico"}) {
    Visit visit = PageVisit();
    visit.target = target;
    INFO(target);
    CHECK(door.Decide(visit).answer == Answer::kRefused);
    CHECK(StatusOf(visit) == 404);
    visit = SocketVisit();
    visit.target = target + std::string("socket");
    CHECK(door.Decide(visit).answer == Answer::kRefused);
  }
}

TEST_CASE("names that were pointed at the loopback are refused", "[live]") {
  for (const char* host : {"", "evil.example:8080", "127.0.0.1", "127.0.0.1:80",
                           "127.0.0.1:8080.evil.example", "0.0.0.0:8080", "[::1]:8080"}) {
    Visit visit = PageVisit();
    visit.host = host;
    INFO(host);
    CHECK(StatusOf(visit) == 403);
  }
  Visit local = PageVisit();
  local.host = "localhost:8080";
  CHECK(StatusOf(local) == 200);
}

TEST_CASE("sockets of other pages are refused", "[live]") {
  for (const char* origin : {"", "null", "http://evil.example", "http://127.0.0.1",
                             "https://127.0.0.1:8080", "http://localhost:8080"}) {
    Visit visit = SocketVisit();
    visit.origin = origin;
    INFO(origin);
    CHECK(StatusOf(visit) == 403);
  }
  Visit post = PageVisit();
  post.method = "POST";
  CHECK(StatusOf(post) == 405);
}

}  // namespace lanelight::live
