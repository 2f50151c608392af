// The training pass of roulette=adjoint: its size, the values of cells, and the estimate
// of the image.
#include <catch2/catch.hpp>

#include "src/scene/prepare/cell_grid.h"
#include "src/scene/prepare/estimate_path_values.h"
#include "src/scene/prepare/tables.h"
#include "tests/agreement/agreement.h"

namespace lanelight::test {
TEST_CASE("training passes take a small fraction of the render", "[roulette]") {
  for (std::uint64_t spp : {1, 16, 256}) {
    TestRender t;
    t.spp = spp;
    t.planned_samples = spp * 16 * 16;
    t.strategy = "roulette=adjoint";
    const Rendered r = RenderDescription(SmallRoom(16, 5), t);
    CHECK(r.result.training.samples > 0);
    CHECK(r.result.training.note != "");
    CHECK(double(r.result.training.samples) < 0.12 * double(r.result.samples) + 64);
  }
}

TEST_CASE("cells cover the bounding box and are smoothed by their surroundings",
          "[roulette]") {
  const CellGrid flat = MakeCellGrid({-1, -1, 0}, {1, 1, 0}, 100'000);
  CHECK(flat.size[2] == 1);
  CHECK(flat.size[0] == flat.size[1]);
  CHECK(flat.size[0] > 20);
  CHECK(MakeCellGrid({0, 0, 0}, {0, 0, 0}, 1000).cells() == 6);
  CHECK(MakeCellGrid({0, 0, 0}, {1, 1, 1}, 1'000'000'000).size[0] <= 48);

  PathValues values;
  values.grid.size[0] = 8;
  CellRecords records(values.grid.cells());
  for (int i = 0; i < 1000; ++i) {
    records.Add(6, i % 2 == 0 ? 1 : 3);
    records.Add(0, 3);
  }
  SetCellValues(records, values);
  CHECK(values.survive[0] == Approx(3).epsilon(0.01));
  CHECK(values.survive[6] == Approx(2).epsilon(0.01));
  CHECK(values.survive[12] == Approx(2.5));  // nothing of its own
  CHECK(values.survive[4 * 6] < 0);          // in another coarse cell: unknown
  CHECK(values.survive[1] < 0);              // another face
}

TEST_CASE("the image estimate follows its tiles", "[roulette]") {
  std::vector<std::uint32_t> pixels;
  std::vector<Vec3f> samples;
  for (std::uint32_t y = 0; y < 32; ++y) {
    for (std::uint32_t x = 0; x < 64; x += 2) {
      pixels.push_back(y * 64 + x);
      const float v = x < 32 ? 1 : 4;
      samples.push_back({v, v / 2, v / 4});
    }
  }
  const PilotImage guess(64, 32, pixels, samples);
  // All channels count alike.
  CHECK(guess.Channel(1) == Approx(2 * guess.Channel(0)));
  CHECK(guess.Channel(2) == Approx(4 * guess.Channel(0)));
  CHECK(guess.Brightness(0) * 4 == Approx(guess.Brightness(63)));
  CHECK(guess.ErrorWeight(0, 0) == Approx(1 / 1.01));
  const auto inverse = guess.Inverse();
  // A whole path of the pixel's colour weighs one.
  double square = 0;
  for (int c = 0; c < 3; ++c) square += inverse[std::size_t(c)] * inverse[std::size_t(c)];
  CHECK(std::sqrt(square) * guess.Brightness(0) == Approx(1).epsilon(0.04));
  CHECK(PilotImage(64, 32, pixels, std::vector<Vec3f>(samples.size())).black());
}

}  // namespace lanelight::test
