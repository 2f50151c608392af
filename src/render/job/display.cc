#include "src/render/job/display.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <concepts>
#include <cstdint>
#include <fmt/format.h>

#include "src/base/core/check.h"
#include "src/base/image/spectrum.h"
#include "src/render/wave/tiles.h"

namespace lanelight {
namespace {

constexpr char kCreateImage = 4, kUpdateImage = 6;
constexpr const char* kChannels[] = {"R", "G", "B"};

class Packet {
 public:
  explicit Packet(char type) : bytes_(4, '\0') { bytes_ += type; }

  template <std::integral T>
  void Add(T value) {
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      bytes_ += static_cast<char>((std::uint64_t(value) >> (8 * i)) & 0xff);
    }
  }
  void Add(float value) { Add(std::bit_cast<std::uint32_t>(value)); }
  void Add(const std::string& text) { bytes_ += text + '\0'; }
  void AddChannels() {
    Add(std::int32_t{3});
    for (const std::string channel : kChannels) Add(channel);
  }
  void Reserve(std::size_t bytes) { bytes_.reserve(bytes_.size() + bytes); }

  /// All of it, with its length.
  std::string Bytes() && {
    for (std::size_t i = 0; i < 4; ++i) {
      bytes_[i] = static_cast<char>((bytes_.size() >> (8 * i)) & 0xff);
    }
    return std::move(bytes_);
  }

 private:
  std::string bytes_;
};

constexpr auto kBetween = std::chrono::milliseconds(250);
constexpr double kConnectSeconds = 2;

}  // namespace

std::string CreateImagePacket(const std::string& name, int width, int height) {
  Packet packet(kCreateImage);
  packet.Add(std::uint8_t{1});  // it is brought to the front
  packet.Add(name);
  packet.Add(std::int32_t{width});
  packet.Add(std::int32_t{height});
  packet.AddChannels();
  return std::move(packet).Bytes();
}

std::string UpdateImagePacket(const std::string& name, const PixelRect& place,
                              std::span<const float> rgb) {
  LL_CHECK_EQ(rgb.size(), 3 * place.pixels());
  Packet packet(kUpdateImage);
  packet.Reserve(name.size() + 128 + 4 * rgb.size());
  packet.Add(std::uint8_t{0});
  packet.Add(name);
  packet.AddChannels();
  for (const int v : {place.x0, place.y0, place.width(), place.height()}) {
    packet.Add(std::int32_t{v});
  }
  for (std::int64_t offset = 0; offset < 3; ++offset) packet.Add(offset);
  for (int channel = 0; channel < 3; ++channel) packet.Add(std::int64_t{3});
  for (const float value : rgb) packet.Add(value);
  return std::move(packet).Bytes();
}

Display::Display(const Endpoint& endpoint, const std::string& name,
                 const FilmAccumulator& film, const std::string& color_space,
                 OnProblem on_problem)
    : endpoint_(endpoint),
      name_(name),
      color_space_(color_space),
      window_(WindowOf(film)),
      on_problem_(std::move(on_problem)),
      shown_(3 * window_.pixels()),
      thread_([this] { Serve(); }) {}

Display::~Display() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    if (server_) server_->SetDeadline(kLastSeconds);
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
      for (int c = 0; c < 3; ++c) tile.rgb.push_back(float(mean[c]));
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
  const auto width = std::size_t(window_.width());
  const auto row = 3 * std::size_t(tile.place.width());
  bool differs = false;
  for (int y = tile.place.y0; y < tile.place.y1; ++y) {
    const float* const from = tile.rgb.data() + std::size_t(y - tile.place.y0) * row;
    float* const to =
        shown_.data() + 3 * (std::size_t(y) * width + std::size_t(tile.place.x0));
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
    Fail(fmt::format(
        "the display server {} {}; the render continues without it", endpoint_.Text(),
        sent == Connection::Sent::kFailed ? "went away (" + server_->Reason() + ")"
                                          : "is too slow: the last tiles were not sent"));
    return false;
  }
  return true;
}

void Display::Serve() {
  std::string why;
  std::shared_ptr<Connection> server = Connection::Open(endpoint_, kConnectSeconds, why);
  if (!server) {
    return Fail(
        fmt::format("no display server at {} ({}): the render continues without it; "
                    "start `tev` first, or give its host and "
                    "port",
                    endpoint_.Text(), why));
  }
  std::unique_lock lock(mutex_);
  server_ = std::move(server);
  if (ended_) server_->SetDeadline(kLastSeconds);
  lock.unlock();
  if (server_->Send(CreateImagePacket(name_, window_.width(), window_.height())) !=
      Connection::Sent::kAll) {
    return Fail(
        fmt::format("the display server {} does not accept images", endpoint_.Text()));
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
