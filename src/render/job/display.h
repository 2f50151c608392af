// Shows a render while it goes on, in a viewer that speaks tev's protocol.
#pragma once

#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "src/base/core/connection.h"
#include "src/base/image/pixel_rect.h"
#include "src/render/films/accumulator.h"

namespace lanelight {

/// Where tev listens.
inline constexpr EndpointType kDisplayEndpoint{14158};

/// Sends the tiles of a film that have changed, four times a second, from a thread of its
/// own: what a slow viewer has not read yet is sent in its last state, and the render
/// never waits. Where nobody listens, or the viewer goes away, it says so once, and
/// nothing else happens.
class Display {
 public:
  using OnProblem = std::function<void(const std::string&)>;

  /// `film` has no samples yet; its pixels are of `color_space` and are shown in linear
  /// sRGB, under this name. `on_problem` is called from any thread.
  Display(const Endpoint& endpoint, const std::string& name, const FilmAccumulator& film,
          const std::string& color_space, OnProblem on_problem);
  /// Sends what is left, for kLastSeconds at most.
  ~Display();
  static constexpr double kLastSeconds = 2;

  /// The film has new samples in these pixels. From any thread, for different pixels.
  void Changed(const FilmAccumulator& film, const PixelRect& place);
  /// The film is as it will be: what it has that was not told of is sent too.
  void Finish(const FilmAccumulator& film);

 private:
  using Corner = std::pair<int, int>;
  struct Tile {
    PixelRect place;
    std::vector<float> rgb;
  };

  Tile TileOf(const FilmAccumulator& film, const PixelRect& place) const;
  /// Keeps a tile as what is shown. Whether it is anything else than before.
  bool Keep(const Tile& tile);
  /// The thread.
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

}  // namespace lanelight
