#include "src/render/job/display.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "src/base/image/spectrum.h"
#include "src/render/job/display_packets.h"
#include "src/render/wave/tiles.h"

namespace lanelight {
namespace {

constexpr auto kBetween = std::chrono::milliseconds(250);
constexpr double kConnectSeconds = 2;

}  // namespace

Display::Display(const Endpoint& endpoint, const std::string& name,
                 const FilmAccumulator& film, const std::string& color_space,
                 OnProblem on_problem)
    : endpoint_(endpoint),
      name_(name),
      color_space_(color_space),
      window_{film.x0(), film.y0(), film.x0() + film.width(), film.y0() + film.height()},
      on_problem_(std::move(on_problem)),
      shown_(3 * window_.pixels()),
      thread_([this] { Serve(); }) {}

Display::~Display() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    if (server_) server_->Hurry(kLastSeconds);
  }
  ended_cv_.notify_all();
  thread_.join();
}

Display::Tile Display::TileOf(const FilmAccumulator& film, const PixelRect& place) const {
  Tile tile = {{place.x0 - window_.x0, place.y0 - window_.y0, place.x1 - window_.x0,
                place.y1 - window_.y0},
               {}};
  tile.rgb.reserve(3 * place.pixels());
  for (int y = place.y0; y < place.y1; ++y) {
    for (int x = place.x0; x < place.x1; ++x) {
      const Rgb mean = ToSrgb(color_space_, film.Mean(x, y), SpectrumUse::kUnbounded);
      for (int c = 0; c < 3; ++c) tile.rgb.push_back(static_cast<float>(mean[c]));
    }
  }
  return tile;
}

void Display::Changed(const FilmAccumulator& film, const PixelRect& place) {
  Tile tile = TileOf(film, place);
  const std::lock_guard lock(mutex_);
  if (failed_ || !Keep(tile)) return;
  changed_.insert_or_assign(Corner{place.x0, place.y0}, std::move(tile));
}

bool Display::Keep(const Tile& tile) {
  const auto width = static_cast<std::size_t>(window_.width());
  const auto row = 3 * static_cast<std::size_t>(tile.place.width());
  bool differs = false;
  for (int y = tile.place.y0; y < tile.place.y1; ++y) {
    const float* const from =
        tile.rgb.data() + static_cast<std::size_t>(y - tile.place.y0) * row;
    float* const to = shown_.data() + 3 * (static_cast<std::size_t>(y) * width +
                                           std::size_t(tile.place.x0));
    differs |= !std::equal(from, from + row, to);
    std::copy(from, from + row, to);
  }
  return differs;
}

// Tiles of other ranks, and what a control variate has corrected in the end.
void Display::Finish(const FilmAccumulator& film) {
  constexpr int kSide = 16;
  for (const PixelRect& tile : TilesOf(window_, kSide)) Changed(film, tile);
}

void Display::Fail(const std::string& message) {
  {
    const std::lock_guard lock(mutex_);
    failed_ = true;
    changed_.clear();
  }
  on_problem_(message);
}

bool Display::SendAll(const std::vector<Tile>& tiles) {
  for (const Tile& tile : tiles) {
    const auto sent = server_->Send(UpdateImagePacket(name_, tile.place, tile.rgb));
    if (sent == Connection::Sent::kAll) continue;
    Fail(fmt::format("the display server {} {}; the render is not touched by it",
                     endpoint_.Text(),
                     sent == Connection::Sent::kFailed
                         ? "went away (" + server_->Reason() + ")"
                         : "is too slow for the last tiles, which it does not get"));
    return false;
  }
  return true;
}

void Display::Serve() {
  std::string why;
  std::shared_ptr<Connection> server = Connection::Open(endpoint_, kConnectSeconds, why);
  if (!server) {
    return Fail(
        fmt::format("no display server at {} ({}): nothing is shown, and the "
                    "render goes on; start `tev` first, or give its host and "
                    "port",
                    endpoint_.Text(), why));
  }
  std::unique_lock lock(mutex_);
  server_ = std::move(server);
  if (ended_) server_->Hurry(kLastSeconds);
  lock.unlock();
  if (server_->Send(CreateImagePacket(name_, window_.width(), window_.height())) !=
      Connection::Sent::kAll) {
    return Fail(fmt::format("the display server {} does not listen", endpoint_.Text()));
  }
  lock.lock();
  while (true) {
    const bool last = ended_;
    std::vector<Tile> tiles;
    for (auto& [corner, tile] : changed_) tiles.push_back(std::move(tile));
    changed_.clear();
    lock.unlock();
    if (!SendAll(tiles) || last) return;
    lock.lock();
    ended_cv_.wait_for(lock, kBetween, [this] { return ended_; });
  }
}

}  // namespace lanelight
