// Path reuse with wavelengths: the mean is that of paths alone, greys stay grey, and the
// wavelengths of a tile are even over its samples.
#include <algorithm>
#include <set>
#include <vector>

#include "src/base/image/spectrum.h"
#include "src/base/image/wavelengths.h"
#include "tests/agreement/spectral_reference.h"
#include "tests/kernels/reuse/same_light.h"
#include "tests/support/wave_fixture.h"

namespace lanelight::test {
namespace {

// Walls of one colour each, which light takes on as it bounces.
ReuseScene SaturatedRoom() {
  ReuseScene room = {SmallRoom(8, 4, 0.3)};
  room.description.materials[1].reflectance.constant = {0.8, 0.05, 0.03};
  room.description.materials[2].reflectance.constant = {0.04, 0.2, 0.8};
  room.description = Spectral(room.description);
  return room;
}

void MakeGrey(SceneDescription& scene) {
  for (Material& m : scene.materials) {
    for (ColorValue* c : {&m.reflectance, &m.eta, &m.k, &m.transmittance}) {
      c->constant = Grey(c->constant.y);
    }
  }
  for (AreaLight& light : scene.area_lights) light.radiance = Grey(light.radiance.y);
}

// Triples of samples of a pixel of an image that is 1000 wide.
std::vector<int> TriplesOf(std::uint32_t pixel, std::uint32_t samples,
                           std::uint32_t seed) {
  const CompiledScene scene;
  WaveFixture f(scene, samples);
  f.run.seed = seed;
  f.run.width = 1000;
  f.run.sampler.by_tile = true;
  PathColumns& p = f.wave.path;
  AlignedVector<float> wavelength(samples + 32);
  p.wavelength = wavelength.data();
  for (std::uint32_t i = 0; i < samples; ++i) {
    p.pixel[i] = pixel, p.sample[i] = i, p.depth[i] = 0, p.branch[i] = 0;
  }
  f.QueueAll(QueueId::kCamera, samples);
  f.Run(IndependentCameraStage, {});
  std::vector<int> triples;
  for (std::uint32_t i = 0; i < samples; ++i) {
    const float thirds = 3 * wavelength[i];
    CHECK((thirds >= 0 && thirds < 1));
    triples.push_back(static_cast<int>(thirds * kTriples));
  }
  return triples;
}

}  // namespace

TEST_CASE("spectral reuse: path reuse is unbiased", "[reuse][spectral]") {
  ReuseScene room = SaturatedRoom();
  CheckSame(room, "points=sobol", "reuse=block:16");
  CheckSame(room, "points=independent", "reuse=block:64");
  CheckSame(room, "points=halton,pairs=antithetic", "reuse=block:4:compact");
  CheckSame(room, "points=sobol,light-candidates=resampled", "reuse=block:32:compact");
}

TEST_CASE("spectral reuse: glossy second vertices", "[reuse][spectral]") {
  Material plastic;
  plastic.kind = MaterialKind::kCoatedDiffuse;
  plastic.reflectance.constant = {0.8, 0.2, 0.05};
  Material metal;
  metal.kind = MaterialKind::kConductor;
  metal.has_reflectance = true;
  metal.reflectance.constant = {0.9, 0.3, 0.1};
  for (Material* side : {&plastic, &metal}) {
    side->uroughness.constant = side->vroughness.constant = 0.3;
    side->remap_roughness = false;
    ReuseScene room = WithSides(*side, 4);
    room.description = Spectral(room.description);
    room.spp = 4096;
    room.power = 0.03;
    CheckSame(room, "points=sobol", "reuse=block:16");
  }
}

TEST_CASE("spectral reuse: grey scenes equal those in RGB", "[reuse][spectral]") {
  SceneDescription room = SmallRoom(16, 4);
  const auto difference = [](const SceneDescription& scene) {
    return LargestDifference(RenderWavefront(scene, 16, "reuse=block"),
                             RenderWavefront(Spectral(scene), 16, "reuse=block"));
  };
  CHECK(difference(room) > 1e-3);
  MakeGrey(room);
  CHECK(difference(room) < 1e-5);
}

TEST_CASE("spectral reuse: bit-identical for any threads and wavefront size",
          "[reuse][spectral][determinism]") {
  SceneDescription room = SaturatedRoom().description;
  room.film.width = 40;
  room.film.height = 24;
  for (const char* strategy : {"points=sobol,reuse=block:16",
                               "points=independent,reuse=block,pairs=antithetic"}) {
    TestRender base;
    base.strategy = strategy;
    base.spp = 12;
    base.threads = 1;
    base.wavefront = 1000;
    const Rendered reference = RenderDescription(room, base);
    CHECK(reference.plan.features.Has(Feature::kReuse));
    for (const std::uint32_t wavefront : {64u, 8192u}) {
      TestRender other = base;
      other.threads = 2;
      other.wavefront = wavefront;
      CHECK(Identical(RenderDescription(room, other).film, reference.film));
    }
  }
}

TEST_CASE("spectral reuse: a tile shares wavelength triples, uniform over its samples",
          "[reuse][spectral][points]") {
  const std::vector<int> triples = TriplesOf(16 * 1000 + 48, 256, 3);
  // The last pixel of the tile; then others, another tile, another seed.
  CHECK(TriplesOf(31 * 1000 + 63, 256, 3) == triples);
  CHECK(TriplesOf(16 * 1000 + 64, 256, 3) != triples);
  CHECK(TriplesOf(32 * 1000 + 48, 256, 3) != triples);
  CHECK(TriplesOf(16 * 1000 + 48, 256, 4) != triples);
  for (std::uint32_t r = 0; r < kReplicates; ++r) {
    for (const int count : {4, 16, 64}) {
      // Once on the way up, once on the way down.
      std::vector<int> in_range(static_cast<std::size_t>(count / 2));
      for (int i = 0; i < count; ++i) {
        const auto at = r + static_cast<std::uint32_t>(i) * kReplicates;
        ++in_range[static_cast<std::size_t>(triples[at] * count / 2 / kTriples)];
      }
      for (const int n : in_range) CHECK(n == 2);
    }
  }
  // Replicates begin elsewhere.
  std::set<std::vector<int>> replicates;
  for (std::uint32_t r = 0; r < kReplicates; ++r) {
    std::vector<int> mine;
    for (std::uint32_t i = r; i < 64; i += kReplicates) mine.push_back(triples[i]);
    replicates.insert(mine);
  }
  CHECK(replicates.size() == kReplicates);
}

TEST_CASE("spectral reuse: dispersive glass is refused", "[reuse][spectral]") {
  SceneDescription room = SaturatedRoom().description;
  Material& glass = room.materials.emplace_back();
  glass.kind = MaterialKind::kDielectric;
  glass.dispersion = std::make_shared<const Spectrum>(*SpectrumOfName("glass-F11"));
  room.shapes.back().material = static_cast<Index>(room.materials.size()) - 1;
  CHECK_THROWS_WITH(EstimateWith(room, "reuse=block", 4, 1),
                    Catch::Contains("dispersive glass"));
  room.integrator.transport = Transport::kRgb;
  EstimateWith(room, "reuse=block", 4, 1);
}

}  // namespace lanelight::test
