// The one file that knows Boost.Beast: it is long to compile.
#include "src/live/server.h"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <deque>
#include <optional>
#include <set>
#include <utility>

#include "src/core/error.h"
#include "src/live/door.h"
#include "src/live/laboratory.h"
#include "src/live/token.h"
#include "src/report/page.h"

namespace lanelight::live {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using tcp = asio::ip::tcp;
using boost::system::error_code;

// A page that does not read is closed when so many messages wait for it: pictures and
// states wait for its word, so that these are answers to what it keeps asking.
constexpr std::size_t kMostWaiting = 64;
constexpr auto kLookForStop = std::chrono::milliseconds(50);
constexpr auto kGoodbye = std::chrono::milliseconds(500);
constexpr std::size_t kLongestHead = 8192;

struct Hall;

// What a page has open: messages in and out, in their order.
class PageSocket : public std::enable_shared_from_this<PageSocket> {
 public:
  PageSocket(beast::tcp_stream&& stream, Hall& hall)
      : socket_(std::move(stream)), hall_(hall) {}

  void Accept(const http::request<http::string_body>& request);
  void Queue(std::string message, bool binary);
  /// Sends what waits, then closes.
  void SayGoodbye();

 private:
  struct Message {
    std::string text;
    bool binary = false;
  };
  void Enter();
  void Read();
  void Write();
  void Close();

  websocket::stream<beast::tcp_stream> socket_;
  Hall& hall_;
  beast::flat_buffer read_;
  std::deque<Message> out_;  // the first is being written
  int session_ = 0;
  bool open_ = false, leaving_ = false;
};

// What all connections share. One thread.
struct Hall {
  int connections = 0;  // before what ends them
  asio::io_context io{1};
  tcp::acceptor acceptor{io};
  asio::steady_timer timer{io};
  std::optional<Door> door;
  std::optional<Laboratory> laboratory;
  std::set<std::shared_ptr<PageSocket>> pages;
  std::string page;  // the document
};

void PageSocket::Accept(const http::request<http::string_body>& request) {
  auto timeouts = websocket::stream_base::timeout::suggested(beast::role_type::server);
  timeouts.keep_alive_pings = true;
  socket_.set_option(timeouts);
  socket_.read_message_max(kLongestMessage);
  socket_.async_accept(request, [self = shared_from_this()](error_code error) {
    if (!error) self->Enter();
  });
}

void PageSocket::Enter() {
  open_ = true;
  hall_.pages.insert(shared_from_this());
  // The laboratory's thread does not touch the socket itself.
  session_ = hall_.laboratory->Enter(
      [weak = weak_from_this(), &io = hall_.io](std::string message, bool binary) {
        asio::post(io, [weak, message = std::move(message), binary]() mutable {
          if (const auto self = weak.lock()) self->Queue(std::move(message), binary);
        });
      });
  Read();
}

void PageSocket::Read() {
  socket_.async_read(read_, [self = shared_from_this()](error_code error, std::size_t) {
    if (error) return self->Close();
    self->hall_.laboratory->Receive(self->session_,
                                    beast::buffers_to_string(self->read_.data()));
    self->read_.consume(self->read_.size());
    self->Read();
  });
}

void PageSocket::Queue(std::string message, bool binary) {
  if (!open_ || leaving_) return;
  if (out_.size() >= kMostWaiting) return Close();
  out_.push_back({std::move(message), binary});
  if (out_.size() == 1) Write();
}

void PageSocket::Write() {
  socket_.binary(out_.front().binary);
  socket_.async_write(asio::buffer(out_.front().text),
                      [self = shared_from_this()](error_code error, std::size_t) {
                        if (error) return self->Close();
                        self->out_.pop_front();
                        if (!self->out_.empty()) return self->Write();
                        if (!self->leaving_) return;
                        self->socket_.async_close(websocket::close_code::going_away,
                                                  [self](error_code) { self->Close(); });
                      });
}

void PageSocket::SayGoodbye() {
  if (out_.size() > 1) out_.erase(out_.begin() + 1, out_.end());
  Queue("{\"kind\": \"goodbye\"}", false);
  leaving_ = true;
}

void PageSocket::Close() {
  if (!open_) return;
  open_ = false;
  hall_.laboratory->Leave(session_);
  beast::get_lowest_layer(socket_).close();
  hall_.pages.erase(shared_from_this());
}

// One request: the page, a socket, or a refusal.
class Visitor : public std::enable_shared_from_this<Visitor> {
 public:
  Visitor(tcp::socket&& socket, Hall& hall) : stream_(std::move(socket)), hall_(hall) {
    ++hall_.connections;
  }
  ~Visitor() { --hall_.connections; }

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
  Hall& hall_;
  beast::flat_buffer buffer_;
  http::request_parser<http::string_body> parser_;
  http::response<http::string_body> response_;
};

std::string TextOf(beast::string_view text) { return {text.data(), text.size()}; }

void Visitor::Answer() {
  const auto& request = parser_.get();
  const Decision decision = hall_.door->Decide(
      {TextOf(request.method_string()), TextOf(request.target()),
       TextOf(request[http::field::host]), TextOf(request[http::field::origin]),
       websocket::is_upgrade(request)});
  if (decision.answer == live::Answer::kPage) {
    return Reply(200, "text/html; charset=utf-8", hall_.page);
  }
  if (decision.answer == live::Answer::kRefused) {
    return Reply(decision.status, "text/plain; charset=utf-8", decision.why + "\n");
  }
  if (hall_.pages.size() >= kMostPages) {
    return Reply(503, "text/plain; charset=utf-8", "too many pages are open already\n");
  }
  stream_.expires_never();
  std::make_shared<PageSocket>(std::move(stream_), hall_)->Accept(parser_.get());
}

void Visitor::Reply(unsigned status, const char* type, std::string body) {
  response_.result(status);
  response_.set(http::field::content_type, type);
  // Nobody else gets the address, nor a copy; and no other page may frame this one.
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

void AcceptNext(Hall& hall) {
  hall.acceptor.async_accept([&hall](error_code error, tcp::socket socket) {
    if (error == asio::error::operation_aborted) return;
    if (!error && hall.connections < kMostConnections) {
      std::make_shared<Visitor>(std::move(socket), hall)->Start();
    }
    AcceptNext(hall);
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
        fmt::format("port {} of 127.0.0.1 cannot be had: {}; without --port "
                    "a free one is taken",
                    port, error.message()));
  }
}

// A signal only sets a flag.
void WatchForStop(Hall& hall, const std::atomic<bool>& stop) {
  hall.timer.expires_after(kLookForStop);
  hall.timer.async_wait([&](error_code) {
    if (!stop) return WatchForStop(hall, stop);
    hall.acceptor.close();
    for (const auto& page : hall.pages) page->SayGoodbye();
    hall.timer.expires_after(kGoodbye);
    hall.timer.async_wait([&](error_code) { hall.io.stop(); });
    if (hall.pages.empty()) hall.io.stop();
  });
}

}  // namespace

struct Server::Impl : Hall {};

Server::Server(Stage& stage, std::string command, std::uint16_t port)
    : impl_(std::make_unique<Impl>()) {
  Listen(impl_->acceptor, port);
  impl_->door.emplace(impl_->acceptor.local_endpoint().port(), MakeToken());
  impl_->page = LivePage();
  impl_->laboratory.emplace(stage, std::move(command));
}

Server::~Server() = default;

std::string Server::address() const { return impl_->door->Address(); }

void Server::Run(const std::atomic<bool>& stop) {
  AcceptNext(*impl_);
  WatchForStop(*impl_, stop);
  impl_->io.run();
  // Sockets leave the laboratory, which is still there.
  impl_->pages.clear();
  impl_->laboratory.reset();
}

}  // namespace lanelight::live
