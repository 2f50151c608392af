// The server, by its sockets.
#include "src/measure/live/server.h"

#include <arpa/inet.h>
#include <catch2/catch.hpp>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <map>
#include <thread>
#include <vector>

#include "src/base/core/error.h"
#include "tests/measure/live/live_scene.h"

namespace lanelight::live {
namespace {

// A server that runs, and where it is.
class RunningServer {
 public:
  RunningServer() : server_(live_scene_, "", 0), thread_([this] { server_.Run(stop_); }) {
    const std::string address = server_.address();
    const std::size_t slash = address.find('/', 7);
    host = address.substr(7, slash - 7);
    path = address.substr(slash);
    port = static_cast<std::uint16_t>(std::stoi(host.substr(host.find(':') + 1)));
  }
  ~RunningServer() { Stop(); }
  void Stop() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
  }
  LiveScene& live_scene() { return live_scene_; }

  std::string host, path;
  std::uint16_t port = 0;

 private:
  LiveScene live_scene_ = SmallLiveScene();
  std::atomic<bool> stop_{false};
  Server server_;
  std::thread thread_;
};

// From the client's address, unless that is 0.
int Connect(std::uint32_t address, std::uint16_t port, std::uint32_t client = 0) {
  const int fd = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in from = {};
  from.sin_family = AF_INET;
  from.sin_addr.s_addr = htonl(client);
  if (client != 0) bind(fd, reinterpret_cast<sockaddr*>(&from), sizeof(from));
  sockaddr_in to = {};
  to.sin_family = AF_INET;
  to.sin_port = htons(port);
  to.sin_addr.s_addr = htonl(address);
  const timeval timeout = {20, 0};
  setsockopt(fd, SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof(timeout));
  if (connect(fd, reinterpret_cast<sockaddr*>(&to), sizeof(to)) == 0) return fd;
  close(fd);
  return -1;
}

struct RequestOptions {
  // The answer is read until it contains this, if it is not empty.
  std::string last = {};
  std::string then = {};     // sent after the first bytes of the answer
  std::uint32_t client = 0;  // address
};

// Returns what the server sends until it ends the connection.
std::string Request(const RunningServer& server, const std::string& text,
                    const RequestOptions& options = {}) {
  const int fd = Connect(INADDR_LOOPBACK, server.port, options.client);
  REQUIRE(fd >= 0);
  REQUIRE(send(fd, text.data(), text.size(), MSG_NOSIGNAL) ==
          static_cast<ssize_t>(text.size()));
  std::string answer;
  char buffer[4096];
  while (options.last.empty() || answer.find(options.last) == std::string::npos) {
    const ssize_t n = recv(fd, buffer, sizeof(buffer), 0);
    if (n <= 0) break;
    answer.append(buffer, static_cast<std::size_t>(n));
    const std::string& then = options.then;
    if (then.empty() || answer.size() > static_cast<std::size_t>(n)) continue;
    REQUIRE(send(fd, then.data(), then.size(), MSG_NOSIGNAL) > 0);
  }
  close(fd);
  return answer;
}

std::string GetText(const std::string& path, const std::string& host) {
  return "GET " + path + " HTTP/1.1\r\nHost: " + host + "\r\n\r\n";
}

std::string UpgradeText(const RunningServer& server, const std::string& origin) {
  return "GET " + server.path + "socket HTTP/1.1\r\nHost: " + server.host +
         "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nOrigin: " + origin +
         "\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
         "Sec-WebSocket-Version: 13\r\n\r\n";
}

}  // namespace

TEST_CASE("the page is served under its address, with security headers", "[live]") {
  const RunningServer server;
  const std::string page = Request(server, GetText(server.path, server.host));
  CHECK(page.rfind("HTTP/1.1 200", 0) == 0);
  CHECK_THAT(page, Catch::Contains("connect-src 'self'"));
  CHECK_THAT(page, Catch::Contains("Referrer-Policy: no-referrer"));
  CHECK_THAT(page, Catch::Contains("X-Frame-Options: DENY"));
  CHECK(Request(server, GetText("/", server.host)).rfind("HTTP/1.1 404", 0) == 0);
  CHECK(Request(server, GetText(server.path, "evil.example")).rfind("HTTP/1.1 403", 0) ==
        0);
}

TEST_CASE("a socket accepts its own page only", "[live]") {
  const RunningServer server;
  const std::string own = "http://" + server.host;
  const std::string good =
      Request(server, UpgradeText(server, own), {.last = "\r\n\r\n"});
  CHECK(good.rfind("HTTP/1.1 101", 0) == 0);
  // The example of RFC 6455.
  CHECK_THAT(good, Catch::Contains("s3pPLMBiTxaQ9kYGzzhZRbK+xOo="));
  const std::string other = Request(server, UpgradeText(server, "http://evil.example"));
  CHECK(other.rfind("HTTP/1.1 403", 0) == 0);
}

TEST_CASE("an invalid request closes only its own connection", "[live]") {
  const RunningServer server;
  Request(server, "\r\n\r\n\x01\x02\x03");
  Request(server, "GET " + std::string(100000, 'a') + " HTTP/1.1\r\n");
  // A frame of a socket that claims to be of 2^62 bytes.
  const std::string frame("\x82\xff\x40\0\0\0\0\0\0\0\0\0\0\0", 14);
  const std::string hung_up =
      Request(server, UpgradeText(server, "http://" + server.host), {.then = frame});
  CHECK_THAT(hung_up, Catch::Contains("101"));
  CHECK(Request(server, GetText(server.path, server.host)).rfind("HTTP/1.1 200", 0) == 0);
}

TEST_CASE("one client cannot block others", "[live]") {
  const RunningServer server;
  // Half-open requests from 127.0.0.1: half of all connections, however many it asks for.
  std::vector<int> open;
  for (int i = 0; i < 2 * kMaxConnections; ++i) {
    open.push_back(Connect(INADDR_LOOPBACK, server.port));
    REQUIRE(send(open.back(), "GET /", 5, MSG_NOSIGNAL) == 5);
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  int refused = 0;
  for (const int fd : open) {
    char byte;
    refused += recv(fd, &byte, 1, MSG_DONTWAIT) == 0 || errno == ECONNRESET;
  }
  CHECK(refused == 2 * kMaxConnections - kMaxPerAddress);
  // 127.0.0.2 of the same machine.
  const std::string page =
      Request(server, GetText(server.path, server.host), {.client = INADDR_LOOPBACK + 1});
  CHECK(page.rfind("HTTP/1.1 200", 0) == 0);
  for (const int fd : open) close(fd);
}

TEST_CASE("connections are limited in all, and from one address", "[live]") {
  std::map<int, int> connections = {{1, kMaxPerAddress - 1}};
  CHECK(MayConnect(connections, 1));
  connections[1] = kMaxPerAddress;
  CHECK_FALSE(MayConnect(connections, 1));
  CHECK(MayConnect(connections, 2));
  connections[2] = kMaxPerAddress;
  CHECK_FALSE(MayConnect(connections, 3));
}

TEST_CASE("the server listens on 127.0.0.1 only and reports used ports", "[live]") {
  RunningServer server;
  // Another address of this machine's loopback.
  CHECK(Connect(INADDR_LOOPBACK + 1, server.port) < 0);
  CHECK_THROWS_WITH(Server(server.live_scene(), "", server.port),
                    Catch::Contains("cannot use port"));
}

TEST_CASE("pages receive a close message", "[live]") {
  RunningServer server;
  std::string all;
  std::thread reader([&] {
    all = Request(server, UpgradeText(server, "http://" + server.host),
                  {.last = "\"goodbye\""});
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  server.Stop();
  reader.join();
  CHECK_THAT(all, Catch::Contains("\"goodbye\""));
}

}  // namespace lanelight::live
