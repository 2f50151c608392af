// Records, bit reversal and renormalisation against plain loops.
#include "kernels/simd/each_target-inl.h"

#include "kernels/simd/records-inl.h"
#include "kernels/simd/rng-inl.h"

LANELIGHT_BEGIN_KERNELS

std::size_t VectorLanes() { return hn::Lanes(DF()); }

// out[4 k + w] = word first + w of record index[k].
void LoadWords(const float* records, int stride, const int* index, int first,
               float* out) {
  const DF df;
  VF words[4];
  Records(records, stride, hn::LoadU(DI(), index)).Load4(first, words);
  const VI at = hn::ShiftLeft<2>(hn::Iota(DI(), 0));
  for (int w = 0; w < 4; ++w) hn::ScatterIndex(words[w], df, out + w, at);
}

void Reverse(std::uint32_t* words, std::size_t count) {
  const DU du;
  for (std::size_t i = 0; i < count; i += hn::Lanes(du)) {
    hn::StoreU(ReverseBits32(hn::LoadU(du, words + i)), du, words + i);
  }
}

void RenormalizeAll(float* x, float* y, float* z, std::size_t count) {
  const DF df;
  for (std::size_t i = 0; i < count; i += hn::Lanes(df)) {
    const V3 v =
        Renormalize({hn::LoadU(df, x + i), hn::LoadU(df, y + i), hn::LoadU(df, z + i)});
    hn::StoreU(v.x, df, x + i);
    hn::StoreU(v.y, df, y + i);
    hn::StoreU(v.z, df, z + i);
  }
}

LANELIGHT_END_KERNELS

#if HWY_ONCE
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "tests/support/each_target.h"

namespace lanelight {

HWY_EXPORT(VectorLanes);
HWY_EXPORT(LoadWords);
HWY_EXPORT(Reverse);
HWY_EXPORT(RenormalizeAll);

TEST_CASE("records: four words of each lane's record", "[simd]") {
  const EachTarget target;
  std::mt19937 engine(5);
  for (int stride : {4, 6, 9, 12, 20}) {
    std::vector<float> records(50 * std::size_t(stride));
    for (std::size_t i = 0; i < records.size(); ++i) records[i] = float(i);
    const std::size_t lanes = LANELIGHT_ON(TestTarget(), VectorLanes)();
    std::vector<int> index(lanes);
    for (int& i : index) i = static_cast<int>(engine() % 50);
    std::vector<float> out(4 * lanes);
    for (int first = 0; first + 4 <= stride; ++first) {
      LANELIGHT_ON(TestTarget(), LoadWords)
      (records.data(), stride, index.data(), first, out.data());
      for (std::size_t k = 0; k < out.size(); ++k) {
        const int word = index[k / 4] * stride + first + static_cast<int>(k % 4);
        REQUIRE(out[k] == float(word));
      }
    }
  }
}

TEST_CASE("ReverseBits32 moves bit i to bit 31 - i", "[simd]") {
  const EachTarget target;
  std::mt19937 engine(6);
  std::vector<std::uint32_t> words(4096);
  for (std::uint32_t& w : words) w = static_cast<std::uint32_t>(engine());
  for (std::uint32_t i = 0; i < 32; ++i) words[i] = 1u << i;
  std::vector<std::uint32_t> reversed = words;
  LANELIGHT_ON(TestTarget(), Reverse)(reversed.data(), reversed.size());
  for (std::size_t i = 0; i < words.size(); ++i) {
    std::uint32_t expected = 0;
    for (int b = 0; b < 32; ++b) expected |= (words[i] >> b & 1u) << (31 - b);
    REQUIRE(reversed[i] == expected);
  }
}

TEST_CASE("Renormalize: 3/8 e^2 and rounding", "[simd]") {
  const EachTarget target;
  constexpr std::size_t kCount = 1 << 14;
  std::mt19937 engine(8);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> excess(-1e-3, 1e-3);
  std::vector<float> x(kCount), y(kCount), z(kCount);
  std::vector<double> e(kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    const double a = normal(engine), b = normal(engine), c = normal(engine);
    const double scale = std::sqrt((1 + excess(engine)) / (a * a + b * b + c * c));
    x[i] = float(a * scale), y[i] = float(b * scale), z[i] = float(c * scale);
    e[i] = double(x[i]) * x[i] + double(y[i]) * y[i] + double(z[i]) * z[i] - 1;
  }
  LANELIGHT_ON(TestTarget(), RenormalizeAll)(x.data(), y.data(), z.data(), kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    const double length = std::hypot(double(x[i]), double(y[i]), double(z[i]));
    REQUIRE(std::abs(length - 1) < 0.375 * e[i] * e[i] * 1.01 + 2.5e-7);
  }
}

}  // namespace lanelight
#endif  // HWY_ONCE
