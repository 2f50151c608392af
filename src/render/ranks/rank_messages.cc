#include "src/render/ranks/rank_messages.h"

#include <cstring>
#include <nlohmann/json.hpp>

#include "src/base/core/check.h"

namespace lanelight {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PixelRect, x0, y0, x1, y1)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(TrainedTable, name, values)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RunStart, tiles, have_samples, planned_training)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RunTraining, trained, changes, tables)

namespace {

// CBOR keeps every bit of a double, of infinities too.
std::string Cbor(const nlohmann::json& json) {
  std::string bytes;
  nlohmann::json::to_cbor(json, bytes);
  return bytes;
}

// Calls copy(address, bytes) for each row of each tile in each column of the films.
template <class Copy>
void ForEachRow(std::span<const TileProgress> packed, const std::vector<PixelRect>& tiles,
                Films& films, const Copy& copy) {
  const FilmAccumulator& film = films.film();
  for (const MutableStateColumn& column : films.Columns()) {
    for (const TileProgress& one : packed) {
      const PixelRect& tile = tiles[one.tile];
      for (int y = tile.y0; y < tile.y1; ++y) {
        const auto row = std::size_t(y - film.y0()) * std::size_t(film.width()) +
                         std::size_t(tile.x0 - film.x0());
        copy(static_cast<char*>(column.data) + row * column.RowBytes(),
             std::size_t(tile.width()) * column.RowBytes());
      }
    }
  }
}

}  // namespace

void SerializeTiles(std::span<const TileProgress> packed,
                    const std::vector<PixelRect>& tiles, Films& films, std::string& out) {
  const std::uint64_t count = packed.size();
  out.append(reinterpret_cast<const char*>(&count), sizeof(count));
  out.append(reinterpret_cast<const char*>(packed.data()), packed.size_bytes());
  ForEachRow(packed, tiles, films,
             [&](const char* from, std::size_t size) { out.append(from, size); });
}

std::vector<std::span<const TileProgress>> InPieces(
    const std::vector<TileProgress>& packed, const std::vector<PixelRect>& tiles) {
  std::vector<std::span<const TileProgress>> pieces(1);
  std::uint64_t pixels = 0;
  for (const TileProgress& one : packed) {
    if (pixels >= kPixelsOfPiece) {
      pieces.push_back({&one, 0});
      pixels = 0;
    }
    const auto last = pieces.back();
    pieces.back() = {last.empty() ? &one : last.data(), last.size() + 1};
    pixels += tiles[one.tile].pixels();
  }
  return pieces;
}

std::vector<TileProgress> DeserializeTiles(std::string_view bytes,
                                           const std::vector<PixelRect>& tiles,
                                           Films& films) {
  const auto read = [&bytes](void* to, std::size_t size) {
    LL_CHECK_GE(bytes.size(), size);
    if (size > 0) std::memcpy(to, bytes.data(), size);
    bytes.remove_prefix(size);
  };
  std::uint64_t count = 0;
  read(&count, sizeof(count));
  LL_CHECK_LE(count, tiles.size());
  std::vector<TileProgress> packed(count);
  read(packed.data(), count * sizeof(TileProgress));
  for (const TileProgress& one : packed) LL_CHECK_LT(one.tile, tiles.size());
  ForEachRow(packed, tiles, films, read);
  LL_CHECK(bytes.empty());
  return packed;
}

std::string ToBytes(const RunStart& start) { return Cbor(start); }

std::string ToBytes(const RunTraining& training) { return Cbor(training); }

RunStart RunStartFromBytes(const std::string& bytes) {
  return nlohmann::json::from_cbor(bytes);
}

RunTraining RunTrainingFromBytes(const std::string& bytes) {
  return nlohmann::json::from_cbor(bytes);
}

}  // namespace lanelight
