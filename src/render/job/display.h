// Shows a running render in a viewer that speaks tev's protocol.
#pragma once

#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "src/base/core/connection.h"
#include "src/base/image/pixel_rect.h"
#include "src/render/films/accumulator.h"

namespace lanelight {

/// The default port of tev.
inline constexpr EndpointType kDisplayEndpoint{14158};

/// Sends changed tiles of a film four times a second, from its own thread: a slow viewer
/// receives the last state of each tile, and the render never waits. If the viewer cannot
/// be reached or disconnects, it reports that once.
class Display {
 public:
  using OnProblem = std::function<void(const std::string&)>;

  /// `film` has no samples yet; its pixels are of `color_space` and are shown in linear
  /// sRGB, under the name `name`. `on_problem` is called from any thread.
  Display(const Endpoint& endpoint, const std::string& name, const FilmAccumulator& film,
          const std::string& color_space, OnProblem on_problem);
  /// Sends the remaining tiles, for at most kLastSeconds.
  ~Display();
  static constexpr double kLastSeconds = 2;

  /// Notes that these pixels have new samples. From any thread, for different pixels.
  void Changed(const FilmAccumulator& film, const PixelRect& place);
  /// Sends what has changed in the final film.
  void Finish(const FilmAccumulator& film);

 private:
  using Corner = std::pair<int, int>;
  struct Tile {
    PixelRect place;
    std::vector<float> rgb;
  };

  Tile TileOf(const FilmAccumulator& film, const PixelRect& place) const;
  /// Stores a tile as shown. Returns whether it differs from before.
  bool Keep(const Tile& tile);
  /// Runs in the thread.
  void Serve();
  bool SendAll(const std::vector<Tile>& tiles);
  void Fail(const std::string& message);

  const Endpoint endpoint_;
  const std::string name_, color_space_;
  const PixelRect window_;  // of the film in the image
  const OnProblem on_problem_;

  std::mutex mutex_;  // of all that follows
  std::condition_variable ended_cv_;
  std::map<Corner, Tile> changed_;      // since they were sent; by their corner
  std::vector<float> shown_;            // colours of all pixels, sent or about to be
  std::shared_ptr<Connection> server_;  // once there is one
  bool ended_ = false, failed_ = false;
  std::thread thread_;  // the last to be made
};

/// CreateImage (type 4): an image of channels R, G, B under this name, or an empty one
/// again if there is one of that name.
std::string CreateImagePacket(const std::string& name, int width, int height);

/// UpdateImage with offsets and strides (type 6): colours of the pixels of `place`, row
/// by row, three values each.
std::string UpdateImagePacket(const std::string& name, const PixelRect& place,
                              std::span<const float> rgb);

}  // namespace lanelight
