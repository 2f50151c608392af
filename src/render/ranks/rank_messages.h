// Messages between ranks: tiles with the film data of their pixels, and what workers
// receive before a run and after the training.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "src/base/image/pixel_rect.h"
#include "src/render/schedule/scheduler.h"
#include "src/render/wave/films.h"
#include "src/render/wave/run_state.h"

namespace lanelight {

/// Pixels of a message: 3 to 25 MB of films, in memory that all pieces use.
inline constexpr std::uint64_t kPixelsOfPiece = 1 << 15;

/// Appends these tiles and their pixels in all columns of the films. `tiles`: the places
/// of all tiles.
void SerializeTiles(std::span<const TileProgress> packed,
                    const std::vector<PixelRect>& tiles, Films& films, std::string& out);
/// Divides tiles into pieces of some megabytes; at least one piece, which may be empty.
std::vector<std::span<const TileProgress>> InPieces(
    const std::vector<TileProgress>& owned, const std::vector<PixelRect>& tiles);
/// Copies the pixels into the films and returns the tiles. `bytes` must hold nothing
/// else.
std::vector<TileProgress> DeserializeTiles(std::string_view bytes,
                                           const std::vector<PixelRect>& tiles,
                                           Films& films);

struct RunStart {
  std::vector<PixelRect> tiles;
  bool have_samples = false;           // the run goes on
  std::uint64_t planned_training = 0;  // TrainingOptions::planned_samples; 0: no training
};

struct RunTraining {
  bool trained = false;  // with what follows
  std::string changes;
  std::vector<TrainedTable> tables;
};

/// Convert messages to bytes, and back with the same bits.
std::string ToBytes(const RunStart& start);
std::string ToBytes(const RunTraining& training);
RunStart RunStartFromBytes(const std::string& bytes);
RunTraining RunTrainingFromBytes(const std::string& bytes);

}  // namespace lanelight
