// roulette=efficiency against no roulette and roulette on the throughput: never worse
// than the better of them by more than a tenth; and the pieces it decides with.
#include <catch2/catch.hpp>

#include "src/scene/prepare/cell_grid.h"
#include "src/scene/prepare/estimate_path_values.h"
#include "src/scene/prepare/tables.h"
#include "tests/agreement/agreement.h"

namespace lanelight::test {
namespace {

struct Measured {
  double variance = 0,
         rays = 0;  // relative, of a pixel; in all, training passes included
  Roulette roulette = Roulette::kNone;
  std::string note;
  double Efficiency() const { return 1 / (variance * rays); }
};

Measured Measure(const SceneDescription& scene, const std::string& roulette,
                 std::uint64_t spp) {
  TestRender t;
  t.spp = spp;
  // A share of the render, however small the image is.
  t.planned_samples = spp * static_cast<std::uint64_t>(scene.film.width) *
                      static_cast<std::uint64_t>(scene.film.height);
  // Seen edges of the lamp cost rays that no roulette has a say in.
  t.strategy = "seen-lights=paths,roulette=" + roulette;
  const Rendered r = RenderDescription(scene, t);
  Measured m;
  for (int y = 0; y < r.film.height(); ++y) {
    for (int x = 0; x < r.film.width(); ++x) {
      const Rgb mean = r.film.Mean(x, y), variance = r.film.Variance(x, y);
      for (int c = 0; c < 3; ++c) {
        m.variance += variance[c] / (mean[c] * mean[c] + 0.01);
      }
    }
  }
  m.rays = double(r.result.rays_closest + r.result.rays_shadow + r.result.training.rays);
  m.roulette = r.result.roulette;
  m.note = r.result.training.note;
  return m;
}

// A lamp seen through a small hole: most paths in the dark part die of nothing.
SceneDescription SplitRoom() {
  SceneBuilder b(16, 16);
  b.Depth(8).Perspective({0, 0, 0.9}, {0, 0, -1}, {0, 1, 0}, 70);
  const Index wall = b.AddDiffuse({0.8, 0.7, 0.6});
  b.AddBox({-1, -1, -1}, {1, 1, 1}, wall).reverse_orientation = true;
  b.AddBox({-1, -0.1, -0.4}, {0.8, 0, 0.4}, wall);
  b.AddQuad({-0.3, 0.99, -0.3}, {0.6, 0, 0}, {0, 0, 0.6}, b.AddDiffuse(Grey(0)),
            b.AddEmission(Grey(5)));
  return b.Build();
}

}  // namespace

TEST_CASE("efficiency is at most a tenth below the better simple roulette",
          "[roulette]") {
  const std::pair<const char*, SceneDescription> scenes[] = {
      {"small room", SmallRoom(16, 5)},
      {"closed room", ClosedRoom(0.7, 20)},
      {"split room", SplitRoom()}};
  for (const auto& [name, scene] : scenes) {
    const std::uint64_t spp = scene.film.width < 16 ? 16384 : 1024;
    const Measured none = Measure(scene, "none", spp);
    const Measured throughput = Measure(scene, "throughput", spp);
    const Measured efficiency = Measure(scene, "efficiency", spp);
    const double best = std::max(none.Efficiency(), throughput.Efficiency());
    INFO(name << ": none " << none.Efficiency() / best << ", throughput "
              << throughput.Efficiency() / best << ", efficiency "
              << efficiency.Efficiency() / best << "; " << efficiency.note);
    // What falls back renders the same image as the simple roulette, so only a choice of
    // splitting has noise of its own: two percent and more with these samples.
    const double noise = efficiency.roulette == Roulette::kEfficiency ? 0.05 : 0;
    CHECK(efficiency.Efficiency() > (0.9 - noise) * best);
    CHECK(efficiency.note.find("rendered with") != std::string::npos);
  }
}

TEST_CASE("the fallback of efficiency gives the image of the simple roulette",
          "[roulette]") {
  TestRender t;
  t.spp = 512;
  t.strategy = "roulette=efficiency";
  const Rendered chosen = RenderDescription(ClosedRoom(0.7, 20), t);
  REQUIRE(chosen.result.roulette != Roulette::kEfficiency);
  t.strategy = std::string("roulette=") + Name(chosen.result.roulette);
  const Rendered simple = RenderDescription(ClosedRoom(0.7, 20), t);
  for (int i = 0; i < 16; ++i) {
    CHECK(chosen.film.Mean(i % 4, i / 4) == simple.film.Mean(i % 4, i / 4));
  }
  CHECK(chosen.result.rays_closest == simple.result.rays_closest);
}

TEST_CASE("training passes take a small fraction of the render", "[roulette]") {
  for (const char* roulette : {"adjoint", "efficiency"}) {
    for (std::uint64_t spp : {1, 16, 256}) {
      TestRender t;
      t.spp = spp;
      t.planned_samples = spp * 16 * 16;
      t.strategy = std::string("roulette=") + roulette;
      const Rendered r = RenderDescription(SmallRoom(16, 5), t);
      CHECK((r.result.training.samples > 0) == (spp == 256 || roulette[0] == 'a'));
      CHECK(r.result.training.note != "");
      CHECK(double(r.result.training.samples) < 0.12 * double(r.result.samples) + 64);
    }
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
    records.Add(6, i % 2 == 0 ? 1 : 3, 4);  // mean 2, variance 1
    records.Add(0, 3, 4);                   // well known
  }
  SetCellValues(records, false, values);
  CHECK(values.survive[0] == Approx(3).epsilon(0.01));
  CHECK(values.survive[6] == Approx(2).epsilon(0.01));
  CHECK(values.survive[12] == Approx(2.5));  // nothing of its own
  CHECK(values.survive[4 * 6] < 0);          // in another coarse cell: unknown
  CHECK(values.survive[1] < 0);              // another face
  SetCellValues(records, true, values);
  CHECK(values.split[0] < 0.1f);
  CHECK(values.split[6] == Approx(0.5).epsilon(0.01));
  CHECK(values.survive[6] == Approx(std::sqrt(5.0 / 4)).epsilon(0.01));
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
  const auto inverse = guess.Inverse(true);
  // A whole path of the pixel's colour weighs one.
  double square = 0;
  for (int c = 0; c < 3; ++c) square += inverse[std::size_t(c)] * inverse[std::size_t(c)];
  CHECK(std::sqrt(square) * guess.Brightness(0) == Approx(1).epsilon(0.04));
  CHECK(PilotImage(64, 32, pixels, std::vector<Vec3f>(samples.size())).black());
}

}  // namespace lanelight::test
