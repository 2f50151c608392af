#include "src/measure/live/server.h"

#include <chrono>
#include <utility>

#include "src/base/core/error.h"
#include "src/measure/live/page_socket.h"
#include "src/measure/live/access_check.h"
#include "src/measure/report/page.h"

namespace lanelight::live {
namespace {

constexpr auto kStopPollInterval = std::chrono::milliseconds(50);
constexpr auto kCloseTimeout = std::chrono::milliseconds(500);
constexpr std::size_t kLongestHead = 8192;

// One request: the page, a socket, or a refusal.
class HttpClient : public std::enable_shared_from_this<HttpClient> {
 public:
  HttpClient(tcp::socket&& socket, const asio::ip::address& client, SharedState& shared)
      : stream_(std::move(socket)), client_(client), shared_(shared) {
    ++shared_.connections[client_];
  }
  ~HttpClient() {
    if (--shared_.connections[client_] == 0) shared_.connections.erase(client_);
  }

  void Start() {
    stream_.expires_after(std::chrono::seconds(10));
    parser_.header_limit(kLongestHead);
    parser_.body_limit(0);
    http::async_read(stream_, buffer_, parser_,
                     [self = shared_from_this()](error_code error, std::size_t) {
                       if (!error) self->Answer();
                     });
  }

 private:
  void Answer();
  void Reply(unsigned status, const char* type, std::string body);

  beast::tcp_stream stream_;
  asio::ip::address client_;
  SharedState& shared_;
  beast::flat_buffer buffer_;
  http::request_parser<http::string_body> parser_;
  http::response<http::string_body> response_;
};

std::string TextOf(beast::string_view text) { return {text.data(), text.size()}; }

void HttpClient::Answer() {
  const auto& request = parser_.get();
  const Decision decision = shared_.access->Decide(
      {TextOf(request.method_string()), TextOf(request.target()),
       TextOf(request[http::field::host]), TextOf(request[http::field::origin]),
       websocket::is_upgrade(request)});
  if (decision.answer == live::Answer::kPage) {
    return Reply(200, "text/html; charset=utf-8", shared_.page);
  }
  if (decision.answer == live::Answer::kRefused) {
    return Reply(decision.status, "text/plain; charset=utf-8", decision.why + "\n");
  }
  if (shared_.pages.size() >= kMaxPages) {
    return Reply(503, "text/plain; charset=utf-8", "too many pages are open already\n");
  }
  stream_.expires_never();
  std::make_shared<PageSocket>(std::move(stream_), shared_)->Accept(parser_.get());
}

void HttpClient::Reply(unsigned status, const char* type, std::string body) {
  response_.result(status);
  response_.set(http::field::content_type, type);
  // The address is sent to no other site, and no other page may frame this one.
  response_.set("Referrer-Policy", "no-referrer");
  response_.set(http::field::cache_control, "no-store");
  response_.set("X-Content-Type-Options", "nosniff");
  response_.set("X-Frame-Options", "DENY");
  response_.set("Cross-Origin-Resource-Policy", "same-origin");
  response_.keep_alive(false);
  response_.body() = std::move(body);
  response_.prepare_payload();
  http::async_write(
      stream_, response_, [self = shared_from_this()](error_code, std::size_t) {
        error_code ignored;
        self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
      });
}

void AcceptNext(SharedState& shared) {
  shared.acceptor.async_accept([&shared](error_code error, tcp::socket socket) {
    if (error == asio::error::operation_aborted) return;
    error_code gone;
    const asio::ip::address client =
        error ? asio::ip::address() : socket.remote_endpoint(gone).address();
    if (!error && !gone && MayConnect(shared.connections, client)) {
      std::make_shared<HttpClient>(std::move(socket), client, shared)->Start();
    }
    AcceptNext(shared);
  });
}

void Listen(tcp::acceptor& acceptor, std::uint16_t port) {
  const tcp::endpoint loopback(asio::ip::address_v4::loopback(), port);
  error_code error;
  acceptor.open(loopback.protocol());
  acceptor.set_option(asio::socket_base::reuse_address(true));
  acceptor.bind(loopback, error);
  if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
  if (error) {
    throw InputError(
        fmt::format("cannot use port {} of 127.0.0.1: {}; omit --port to use a free one",
                    port, error.message()));
  }
}

// A signal only sets a flag.
void WatchForStop(SharedState& shared, const std::atomic<bool>& stop) {
  shared.timer.expires_after(kStopPollInterval);
  shared.timer.async_wait([&](error_code) {
    if (!stop) return WatchForStop(shared, stop);
    shared.acceptor.close();
    for (const auto& page : shared.pages) page->SendClose();
    shared.timer.expires_after(kCloseTimeout);
    shared.timer.async_wait([&](error_code) { shared.io.stop(); });
    if (shared.pages.empty()) shared.io.stop();
  });
}

}  // namespace

struct Server::Impl : SharedState {};

Server::Server(const LiveScene& live_scene, std::string command, std::uint16_t port)
    : impl_(std::make_unique<Impl>()) {
  Listen(impl_->acceptor, port);
  impl_->access.emplace(impl_->acceptor.local_endpoint().port(), MakeToken());
  impl_->page = LivePage();
  impl_->render_thread.emplace(live_scene, std::move(command));
}

Server::~Server() = default;

std::string Server::address() const { return impl_->access->Address(); }

void Server::Run(const std::atomic<bool>& stop) {
  AcceptNext(*impl_);
  WatchForStop(*impl_, stop);
  impl_->io.run();
  // Sockets leave the render_thread, which is still there.
  impl_->pages.clear();
  impl_->render_thread.reset();
}

}  // namespace lanelight::live
