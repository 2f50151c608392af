// Films with columns of all types, of random bits.
#pragma once

#include <cstring>
#include <random>
#include <vector>

#include "src/base/core/input_file.h"
#include "src/base/state/state_file.h"
#include "tests/base/image/temporary_folder.h"

namespace lanelight {

// Two numbers of one kind.
struct Pair {
  std::int32_t a = 0, b = 0;
};

struct RandomFilm {
  PixelRect window;
  std::vector<float> radiance;
  std::vector<double> sums;
  std::vector<std::uint64_t> samples;
  std::vector<std::uint32_t> seeds;
  std::vector<Pair> pairs;

  /// All zero.
  explicit RandomFilm(const PixelRect& w)
      : window(w),
        radiance(3 * w.pixels()),
        sums(12 * w.pixels()),
        samples(w.pixels()),
        seeds(w.pixels() * 4),
        pairs(w.pixels()) {}

  static RandomFilm Make(const PixelRect& window, unsigned seed) {
    RandomFilm film(window);
    std::mt19937_64 random(seed);
    // Random bits are NaNs and infinities too; samples have few bits that are not zero.
    for (MutableStateColumn& c : film.Columns()) {
      for (std::size_t i = 0; i < c.Bytes() / 4; ++i) {
        const std::uint32_t bits = static_cast<std::uint32_t>(random());
        std::memcpy(static_cast<char*>(c.data) + 4 * i, &bits, 4);
      }
    }
    for (std::uint64_t& n : film.samples) n %= 40;
    return film;
  }

  std::vector<MutableStateColumn> Columns() {
    return ColumnsOf<MutableStateColumn>(*this);
  }
  std::vector<StateColumn> Columns() const { return ColumnsOf<StateColumn>(*this); }

  /// Returns the content of the pixels of these tiles.
  StateContent Content(const std::vector<PixelRect>& tiles) const {
    return {R"({"scene": "box"})",
            "{\"hours\": 7, \"wo\": \"Köln\"}",
            window,
            tiles,
            Columns(),
            {}};
  }

  /// Bytes of all columns at pixel `index`.
  std::vector<char> Pixel(std::size_t index) const {
    std::vector<char> bytes;
    for (const StateColumn& c : Columns()) {
      const char* row = static_cast<const char*>(c.data) + index * c.RowBytes();
      bytes.insert(bytes.end(), row, row + c.RowBytes());
    }
    return bytes;
  }

 private:
  template <class Column, class Film>
  static std::vector<Column> ColumnsOf(Film& film) {
    return {MakeStateColumn<float>("radiance", "of one sample", film.radiance, {3}),
            MakeStateColumn<double>("sums", "sums of samples", film.sums, {4, 3}),
            MakeStateColumn<std::uint64_t>("samples", "number of samples", film.samples),
            MakeStateColumn<std::uint32_t>("seeds", "state", film.seeds, {2, 2, 1}),
            MakeStateColumn<std::int32_t>("pairs", "two numbers", film.pairs)};
  }
};

/// The file of a state.
inline std::string StateBytes(const StateContent& content) {
  const TemporaryFolder folder;
  WriteState(content, folder.File("state"));
  return ReadWholeFile(folder.File("state"));
}

/// Returns whether each pixel of the window is that of `expected` in the tiles, and zero
/// outside.
inline bool HoldsTiles(const RandomFilm& film, const RandomFilm& expected,
                       const std::vector<PixelRect>& tiles) {
  const RandomFilm zero(film.window);
  const int width = film.window.width();
  for (std::size_t i = 0; i < film.samples.size(); ++i) {
    const int x = film.window.x0 + static_cast<int>(i) % width,
              y = film.window.y0 + static_cast<int>(i) / width;
    bool inside = false;
    for (const PixelRect& t : tiles) {
      inside |= t.x0 <= x && x < t.x1 && t.y0 <= y && y < t.y1;
    }
    if (film.Pixel(i) != (inside ? expected : zero).Pixel(i)) return false;
  }
  return true;
}

}  // namespace lanelight
