// The texture stage writes the parameters of every path from its material's constants or
// textures, in all four variants, and touches no column that is not live.
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "src/base/core/check.h"
#include "src/scene/compile/texture_programs.h"
#include "src/scene/compiled/scene.h"
#include "src/vocabulary/path/stage.h"
#include "tests/kernels/texture/texture_files.h"
#include "tests/reference/texture.h"
#include "tests/support/each_target.h"

namespace lanelight {

Stage TextureStage(SimdTarget target);

namespace {

constexpr int kPaths = 37, kRoom = kPaths + 16;

void AddMaterial(MaterialTable& m, ShadeKind kind, float color, std::int32_t texture) {
  m.kind.push_back(static_cast<std::uint32_t>(kind));
  for (auto* column :
       {&m.color0_r, &m.color0_g, &m.color0_b, &m.color1_r, &m.color1_g, &m.color1_b}) {
    column->push_back(color);
    color += 0.0625f;
  }
  m.alpha_x.push_back(0.5f), m.alpha_y.push_back(0.25f);
  m.color0_texture.push_back(texture), m.color1_texture.push_back(texture);
  m.alpha_x_texture.push_back(texture), m.alpha_y_texture.push_back(-1);
  m.alpha_remap.push_back(m.kind.size() % 2);
}

// Two textures, five materials with and without them, 37 paths in a shuffled queue.
struct Fixture {
  TemporaryFolder folder;
  std::vector<Texture> textures;
  CompiledScene scene;
  std::vector<float> columns[10];
  std::vector<std::uint32_t> material, queue;
  Wave wave;

  Fixture() {
    textures.push_back(ImageTexture(folder.Write("a.tga", RandomTga(8, 8, 24, 1))));
    textures.push_back(ConstantTexture({2.5, -1, 0.75}));
    scene.textures = CompileTextures(textures);
    AddMaterial(scene.materials, ShadeKind::kDiffuse, 0.125f, -1);
    AddMaterial(scene.materials, ShadeKind::kDiffuse, 0, 0);
    AddMaterial(scene.materials, ShadeKind::kCoatedDiffuseRough, 0, 1);
    AddMaterial(scene.materials, ShadeKind::kConductorRough, 0, 1);
    AddMaterial(scene.materials, ShadeKind::kConductorRough, 0, 0);
    std::mt19937 random(4);
    std::uniform_real_distribution<float> uniform(-2, 2);
    for (auto& column : columns) column.assign(kRoom, -77);
    for (int i = 0; i < kRoom; ++i) {
      columns[0][i] = uniform(random), columns[1][i] = uniform(random);
      material.push_back(random() % 5);
      if (i < kPaths) queue.push_back((i * 5) % kPaths);
    }
    queue.resize(kRoom);
    static_cast<SceneParts&>(wave) = PartsOf(scene, scene.view, nullptr);
    wave.queue(QueueId::kSurface) = {queue.data(), kPaths};
    PathColumns& path = wave.path;
    path.uv_u = columns[0].data(), path.uv_v = columns[1].data();
    path.material = material.data();
    path.color0_r = columns[2].data(), path.color0_g = columns[3].data();
    path.color0_b = columns[4].data();
  }
  void AddColor1() {
    wave.path.color1_r = columns[5].data(), wave.path.color1_g = columns[6].data();
    wave.path.color1_b = columns[7].data();
  }
  void AddRoughness() {
    wave.path.alpha_x = columns[8].data(), wave.path.alpha_y = columns[9].data();
  }
  // Returns the right value of channel c of a colour parameter whose first constant is
  // `base`.
  double Color(int i, int c, double base) const {
    const std::uint32_t m = material[i];
    const std::int32_t id = scene.materials.color0_texture[m];
    if (id < 0) return base + 0.0625 * c;
    const double value =
        reference::Textures(textures).Eval(id, columns[0][i], columns[1][i])[c];
    const bool index_of_refraction =
        scene.materials.kind[m] == static_cast<std::uint32_t>(ShadeKind::kConductorRough);
    return std::max(0.0, index_of_refraction ? value : std::min(value, 1.0));
  }
  double AlphaX(int i) const {
    const std::uint32_t m = material[i];
    const std::int32_t id = scene.materials.alpha_x_texture[m];
    if (id < 0) return 0.5;
    const double v =
        reference::Textures(textures).Eval(id, columns[0][i], columns[1][i]).x;
    return std::max(1e-4, m % 2 == 0 ? std::sqrt(std::max(0.0, v)) : v);
  }
};

}  // namespace

TEST_CASE("the texture stage writes the parameters of each material",
          "[texture][stage]") {
  const bool color1 = GENERATE(false, true), roughness = GENERATE(false, true);
  FeatureSet features = {Feature::kTextures, Feature::kUv};
  if (color1) features.Add(Feature::kTexturedColor1);
  if (roughness) features.Add(Feature::kTexturedRoughness);
  const EachTarget target;
  Fixture f;
  if (color1) f.AddColor1();
  if (roughness) f.AddRoughness();
  TextureStage(TestTarget()).resolve(features)(f.wave);
  CHECK(f.wave.lanes.items == kPaths);
  for (int i = 0; i < kPaths; ++i) {
    INFO(" path " << i << " material " << f.material[i]);
    for (int c = 0; c < 3; ++c) {
      CHECK(f.columns[2 + c][i] == Approx(f.Color(i, c, 0.125)).margin(2e-5));
      if (color1) {
        CHECK(f.columns[5 + c][i] == Approx(f.Color(i, c, 0.3125)).margin(2e-5));
      }
    }
    if (roughness) {
      CHECK(f.columns[8][i] == Approx(f.AlphaX(i)).margin(1e-4));
      CHECK(f.columns[9][i] == 0.25f);
    }
  }
  for (int c = 2; c < 10; ++c) CHECK(f.columns[c][kPaths] == -77);  // no other slot
}

TEST_CASE("the texture stage needs surface coordinates", "[texture][stage]") {
  CHECK_THROWS_AS(TextureStage(TestTarget()).resolve({Feature::kTextures}), CheckFailure);
}

}  // namespace lanelight
