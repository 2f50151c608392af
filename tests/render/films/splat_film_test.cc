// Sums of splats are exact, whatever their order, and their statistics are those of
// independent subpaths.
#include "src/render/films/splat_film.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

namespace lanelight {
namespace {

std::vector<PixelSplat> RandomSplats(std::size_t count, std::uint32_t pixels) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> exponent(-40, 11), sign(-0.2f, 1);
  std::vector<PixelSplat> splats;
  for (std::size_t i = 0; i < count; ++i) {
    PixelSplat splat = {static_cast<std::uint32_t>(random() % pixels), {}};
    for (float& light : splat.light) {
      light = std::copysign(std::exp2(exponent(random)), sign(random));
    }
    splats.push_back(splat);
  }
  return splats;
}

std::vector<std::uint64_t> Bits(SplatFilm& film) {
  std::vector<std::uint64_t> bits;
  for (const MutableStateColumn& column : film.Columns()) {
    const auto* data = static_cast<const std::uint64_t*>(column.data);
    bits.insert(bits.end(), data, data + column.rows * column.ValuesPerRow());
  }
  return bits;
}

}  // namespace

TEST_CASE("sums of splats do not depend on their order or on tasks", "[film]") {
  std::vector<PixelSplat> splats = RandomSplats(3000, 4);
  SplatFilm whole(4, 1), parts(4, 1);
  whole.Add(splats, 36);
  std::shuffle(splats.begin(), splats.end(), std::mt19937(3));
  const auto middle = splats.begin() + 1100;
  parts.Add({middle, splats.end()}, 18);
  Bits(parts);  // a state between tasks changes nothing
  parts.Add({splats.begin(), middle}, 18);
  CHECK(Bits(parts) == Bits(whole));
  splats[0].light[1] = std::nextafter(splats[0].light[1], 0.0f);
  SplatFilm other(4, 1);
  other.Add(splats, 36);
  CHECK(Bits(other) != Bits(whole));
}

TEST_CASE("sums of splats are those of double precision, and below zero", "[film]") {
  SplatSums sums;
  double light = 0, squares = 0;
  for (const PixelSplat& splat : RandomSplats(1000, 1)) {
    sums.Add(splat.light);
    light += double(splat.light[2]);
    squares += double(splat.light[2]) * double(splat.light[2]);
  }
  CHECK(sums.Value(2) == Approx(light).epsilon(1e-13));
  CHECK(sums.Value(5) == Approx(squares).epsilon(1e-13));
  SplatSums small;
  const float dim[3] = {-1e-6f, 1e-9f, 0};
  for (int i = 0; i < 1000; ++i) small.Add(dim);
  CHECK(small.Value(0) == Approx(-1e-3).epsilon(1e-6));
  CHECK(small.Value(1) == Approx(1e-6).epsilon(1e-6));
  CHECK(small.Value(2) == 0);
}

TEST_CASE("many splats of one pixel carry over", "[film]") {
  SplatSums sums;
  sums.low[0] = (std::int64_t{1} << 62) - 1;
  const double before = sums.Value(0);
  const float light[3] = {0x1p-26f, 0, 0};
  sums.Add(light);
  CHECK(std::abs(sums.low[0]) <= std::int64_t{1} << 39);
  CHECK(sums.Value(0) == Approx(before + 0x1p-26).epsilon(1e-15));
}

TEST_CASE("mean and variance of a pixel are those of independent subpaths", "[film]") {
  // Of 8 subpaths, started for 2 pixels of the image, 3 bring something to pixel 1.
  SplatFilm film(2, 4);
  film.Add({{1, {1, 0, 0}}, {1, {2, 0, 0}}}, 4);
  film.Add({{1, {5, 0, 0}}}, 4);
  CHECK(film.Mean(1).x == Approx(2 * 4 * 8 / 8.0));
  CHECK(film.Mean(0).x == 0);
  const double squares = 1 + 4 + 25, mean = 1;
  CHECK(film.Variance(1).x == Approx(64 * (squares / 8 - mean * mean) / 7));
  CHECK(film.Variance(1).y == 0);
}

}  // namespace lanelight
