// The connection of a page, and the state that all connections share. Boost.Beast is long
// to compile: only the two files of the server include this, and are compiled together.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <deque>
#include <memory>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "src/measure/live/access_check.h"
#include "src/measure/live/render_thread.h"

namespace lanelight::live {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using tcp = asio::ip::tcp;
using boost::system::error_code;

struct SharedState;

/// Messages of a page in and out, in their order.
class PageSocket : public std::enable_shared_from_this<PageSocket> {
 public:
  PageSocket(beast::tcp_stream&& stream, SharedState& shared)
      : socket_(std::move(stream)), shared_(shared) {}

  void Accept(const http::request<http::string_body>& request);
  void Queue(std::string message, bool binary);
  /// Sends what waits, then closes.
  void SendClose();

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
  SharedState& shared_;
  beast::flat_buffer read_;
  std::deque<Message> out_;  // the first is being written
  int session_ = 0;
  bool open_ = false, leaving_ = false;
};

/// State shared by all connections; used by one thread.
struct SharedState {
  // Before what ends them; of each address of a client.
  std::map<asio::ip::address, int> connections;
  asio::io_context io{1};
  tcp::acceptor acceptor{io};
  asio::steady_timer timer{io};
  std::optional<AccessCheck> access;
  std::optional<RenderThread> render_thread;
  std::set<std::shared_ptr<PageSocket>> pages;
  std::string page;  // the document
};

}  // namespace lanelight::live
