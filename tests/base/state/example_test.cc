// A state that tests/base/state/h5py_test.py opens: every value follows from its place.
#include <catch2/catch.hpp>
#include <cstdlib>

#include "src/base/image/atomic_file.h"
#include "src/base/state/state_file.h"
#include "tests/base/image/temporary_folder.h"

namespace lanelight {
namespace {

constexpr PixelRect kWindow = {-3, 2, 197, 142};

// Random bits by the finaliser of splitmix64, which numpy computes as well.
std::uint64_t Bits(std::uint64_t n) {
  n = (n + 1) * 0x9e3779b97f4a7c15u;
  n = (n ^ (n >> 30)) * 0xbf58476d1ce4e5b9u;
  n = (n ^ (n >> 27)) * 0x94d049bb133111ebu;
  return n ^ (n >> 31);
}

struct Film {
  std::vector<double> sums;           // x + 1000 y + c / 16, of twelve c
  std::vector<std::uint64_t> bits;    // Bits(index)
  std::vector<std::int32_t> samples;  // -index
  std::vector<float> gray;            // x y
  std::vector<std::uint32_t> table;   // 0, 3, 6, ...

  Film() : table(70001) {
    for (int y = kWindow.y0; y < kWindow.y1; ++y) {
      for (int x = kWindow.x0; x < kWindow.x1; ++x) {
        const std::size_t index = bits.size();
        for (int c = 0; c < 12; ++c) sums.push_back(x + 1000 * y + c / 16.0);
        bits.push_back(Bits(index));
        samples.push_back(-static_cast<std::int32_t>(index));
        gray.push_back(static_cast<float>(x * y));
      }
    }
    for (std::size_t i = 0; i < table.size(); ++i) {
      table[i] = 3 * static_cast<std::uint32_t>(i);
    }
  }

  StateContent Content() const {
    return {R"({"scene": "Köln.pbrt"})",
            R"({"samples": 12})",
            kWindow,
            {{100, 2, 197, 100}, {-3, 2, 100, 100}, {-3, 100, 60, 142}},
            {MakeStateColumn<double>("sums", "sums of samples", sums, {4, 3}),
             MakeStateColumn<std::uint64_t>("bits", "random", bits),
             MakeStateColumn<std::int32_t>("samples", "numbers", samples),
             MakeStateColumn<float>("gray", "a plane", gray)},
            {MakeStateColumn<std::uint32_t>("table", "a table", table)}};
  }
};

}  // namespace

TEST_CASE("the example of a state can be written", "[state]") {
  const char* wanted = std::getenv("LANELIGHT_STATE_EXAMPLE");
  const TemporaryFolder folder;
  const std::string path = wanted != nullptr ? wanted : folder.File("state");
  const Film film;
  WriteState(film.Content(), path);
  CHECK(StateFile(path).identity() == R"({"scene": "Köln.pbrt"})");
}

}  // namespace lanelight
