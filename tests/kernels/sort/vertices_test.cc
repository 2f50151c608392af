// Another event than a surface, here paths put into kVertex by hand, takes part in all
// that happens where a path scatters, without a change to the stages of surfaces.
#include <catch2/catch.hpp>
#include <set>

#include "kernels/stages.h"
#include "tests/support/each_target.h"
#include "tests/support/wave_fixture.h"

namespace lanelight {
namespace {

constexpr std::uint32_t kPaths = 37;
constexpr float kUndrawn = -1;

// Even slots are surfaces of a diffuse material, odd ones points of another kind.
CompiledScene TwoKinds() {
  CompiledScene scene;
  scene.materials.kind = {static_cast<std::uint32_t>(ShadeKind::kDiffuse),
                          static_cast<std::uint32_t>(ShadeKind::kDiffuseUniform)};
  return scene;
}

void Fill(Wave& wave) {
  for (std::uint32_t i = 0; i < kPaths; ++i) {
    wave.path.pixel[i] = i;
    wave.path.sample[i] = wave.path.depth[i] = wave.path.branch[i] = 0;
    wave.path.u_bsdf_0[i] = kUndrawn;
    wave.path.material[i] = i % 2;
    Queue& queue = wave.queue(i % 2 == 0 ? QueueId::kSurface : QueueId::kVertex);
    queue.items[queue.size++] = i;
  }
}

std::set<std::uint32_t> SlotsOf(const Queue& queue) {
  return {queue.items, queue.items + queue.size};
}

}  // namespace

TEST_CASE("vertices: media vertices draw numbers and are queued", "[sort]") {
  const CompiledScene scene = TwoKinds();
  const EachTarget target;
  WaveFixture f(scene, kPaths);
  f.wave.vertices = QueueId::kVertex;
  f.run.features = {Feature::kDiffuse, Feature::kDiffuseUniform};
  Fill(f.wave);
  f.Run(VerticesStage, {});
  CHECK(f.wave.queue(QueueId::kVertex).size == kPaths);
  f.Run(IndependentBounceStage, {});
  f.Run(RouteStage, {});
  for (std::uint32_t i = 0; i < kPaths; ++i) {
    const float u = f.wave.path.u_bsdf_0[i];
    CHECK((u >= 0 && u < 1));
    const ShadeKind kind = i % 2 == 0 ? ShadeKind::kDiffuse : ShadeKind::kDiffuseUniform;
    CHECK(SlotsOf(f.wave.queue(ShadeQueue(kind))).count(i) == 1);
  }
}

TEST_CASE("vertices: without scattering media only the surface queue exists", "[sort]") {
  const CompiledScene scene = TwoKinds();
  WaveFixture f(scene, kPaths);
  Fill(f.wave);
  CHECK(&f.wave.queue(QueueId::kVertex) == &f.wave.queue(QueueId::kSurface));
  f.Run(IndependentBounceStage, {});
  for (std::uint32_t i = 0; i < kPaths; ++i) {
    CHECK(f.wave.path.u_bsdf_0[i] != kUndrawn);
  }
}

}  // namespace lanelight
