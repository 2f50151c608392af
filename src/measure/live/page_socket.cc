#include "src/measure/live/page_socket.h"

#include <chrono>
#include <utility>

#include "src/measure/live/state_json.h"

namespace lanelight::live {
namespace {

// A page that does not read is closed when so many messages wait for it: pictures and
// states wait for its word, so that these are answers to what it keeps asking.
constexpr std::size_t kMaxQueuedMessages = 64;

}  // namespace

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
  shared_.pages.insert(shared_from_this());
  // The render_thread's thread does not touch the socket itself.
  session_ = shared_.render_thread->Enter(
      [weak = weak_from_this(), &io = shared_.io](std::string message, bool binary) {
        asio::post(io, [weak, message = std::move(message), binary]() mutable {
          if (const auto self = weak.lock()) self->Queue(std::move(message), binary);
        });
      });
  Read();
}

void PageSocket::Read() {
  socket_.async_read(read_, [self = shared_from_this()](error_code error, std::size_t) {
    if (error) return self->Close();
    self->shared_.render_thread->Receive(self->session_,
                                         beast::buffers_to_string(self->read_.data()));
    self->read_.consume(self->read_.size());
    self->Read();
  });
}

void PageSocket::Queue(std::string message, bool binary) {
  if (!open_ || leaving_) return;
  if (out_.size() >= kMaxQueuedMessages) return Close();
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

void PageSocket::SendClose() {
  if (out_.size() > 1) out_.erase(out_.begin() + 1, out_.end());
  Queue("{\"kind\": \"goodbye\"}", false);
  leaving_ = true;
}

void PageSocket::Close() {
  if (!open_) return;
  open_ = false;
  shared_.render_thread->RemoveSession(session_);
  beast::get_lowest_layer(socket_).close();
  shared_.pages.erase(shared_from_this());
}

}  // namespace lanelight::live
