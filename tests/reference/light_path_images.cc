#include "tests/reference/light_path_images.h"

#include "tests/reference/scenes.h"

namespace lanelight::test::bidirectional {

Comparison Compare(const Renders& a, const Renders& b) {
  Comparison out;
  for (const int tile : {kSide, kSide / 4}) {
    const auto tiles_a = TilesOf(a, tile), tiles_b = TilesOf(b, tile);
    const std::size_t tiles = tiles_a.mean.size();
    for (std::size_t i = 0; i < tiles; ++i) {
      const auto pixel = [&](const stat::ImageEstimate& of) {
        return stat::ImageEstimate{1, 1, of.observations, {of.mean[i]}, {of.variance[i]}};
      };
      const auto result =
          stat::CompareMeans(pixel(tiles_a), pixel(tiles_b),
                             {1, 1e-6 / double(tiles), kFloatTolerance, 1e-7});
      if (tile == kSide) out.detectable_bias = result.detectable_bias;
      if (result.same && tile != kSide) continue;
      out.same = out.same && result.same;
      out.text += fmt::format("tile {} of {}: {}\n", i, tiles, result.ToString());
    }
  }
  return out;
}

void CheckSame(const Comparison& result, double power, const std::string& what) {
  INFO(what << ": " << result.text);
  CHECK(result.same);
  CHECK(result.detectable_bias < power);
}

stat::ImageEstimate Image(std::vector<Rgb> mean) {
  mean.resize(kSide * kSide);
  return {kSide, kSide, 2, mean, std::vector<Rgb>(mean.size())};
}

stat::ImageEstimate Sum(const TechniqueImages& images, const TechniqueSet& of) {
  std::vector<Rgb> sum(kSide * kSide);
  for (const auto& [technique, image] : images) {
    for (std::size_t i = 0; of(technique) && i < sum.size(); ++i) sum[i] += image[i];
  }
  return Image(sum);
}

std::vector<BidirectionalImages> RenderTwin(const SceneDescription& scene,
                                            BidirectionalOptions options) {
  return Repeat([&](std::uint64_t i) {
    BidirectionalOptions own = options;
    own.seed = 100 + i;
    return RenderBidirectional(scene, own);
  });
}

bool WithLightSamples(Technique of) { return of.s == 0 || (of.s == 1 && of.t > 1); }
bool IsSplat(Technique of) { return of.t == 1 && of.s > 1; }
bool OfProduct(Technique of) { return WithLightSamples(of) || IsSplat(of); }

LightPathParts RenderParts(const SceneDescription& scene, std::uint64_t spp, int n) {
  LightPathParts out;
  for (int i = 0; i < kRenders; ++i) {
    TestRender options;
    options.spp = spp;
    options.seed = 500 + std::uint64_t(i);
    options.strategy = fmt::format("light-paths=splats:{}", n);
    options.planned_samples = kMinTrainingSamples;
    const Rendered render = RenderDescription(scene, options);
    CHECK(render.result.health.Total() == 0);
    std::vector<Rgb> splats, camera, all;
    for (std::size_t p = 0; p < std::size_t(scene.film.width * scene.film.height); ++p) {
      splats.push_back(render.film.splats()->Mean(p));
      all.push_back(
          render.film.Mean(int(p) % scene.film.width, int(p) / scene.film.width));
      camera.push_back(all.back() - splats.back());
    }
    out.splats.push_back(Image(splats));
    out.camera.push_back(Image(camera));
    out.all.push_back(Image(all));
  }
  return out;
}

TriangleMesh Tilted(Vec3d corner, Vec3d e1, Vec3d e2) {
  TriangleMesh mesh;
  mesh.positions = {corner, corner + e1, corner + e1 + e2, corner + e2};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  const Vec3d n = Normalize(Cross(e1, e2)), x = Normalize(e1), y = Normalize(e2);
  mesh.normals = {n - 0.6 * x - 0.3 * y, n + 0.5 * x - 0.4 * y, n + 0.4 * x + 0.6 * y,
                  n - 0.3 * x + 0.5 * y};
  return mesh;
}

SceneDescription LampRoom(int max_depth) {
  SceneBuilder b(kSide, kSide);
  b.scene() = SmallRoom(kSide, max_depth, 0.3);
  const Index glass = b.AddDielectric(1.5), black = b.AddDiffuse(Grey(0));
  b.AddSphere({-0.45, 0.3, 0.5}, 0.3, glass);
  b.AddMesh(Tilted({0.3, 1.1, -0.5}, {0.6, 0, 0}, {0, 0.5, -0.3}), 0);
  b.AddDisk({-0.9, 1.5, 0.2}, {1, 0, 0.1}, 0.2, black, b.AddEmission({5, 7, 9}));
  b.AddSphere({-0.3, 1.5, -0.4}, 0.1, black, b.AddEmission({12, 9, 7}));
  b.AddQuad({0.2, 1.5, -0.2}, {0.4, 0, 0}, {0, 0.2, 0.4}, black,
            b.AddEmission({8, 8, 6}, true));
  return b.Build();
}

SceneDescription TiltedFloor() {
  SceneBuilder b(kSide, kSide);
  b.Depth(2).Perspective({-3, 0, 0.8}, {0, 0, 0.5}, {0, 0, 1}, 40);
  const Index grey = b.AddDiffuse(Grey(0.8)), black = b.AddDiffuse(Grey(0));
  TriangleMesh floor = Tilted({-2, -2, 0}, {3, 0, 0}, {0, 4, 0});
  floor.normals.assign(4, {0.75, 0.2, 0.63});
  b.AddMesh(floor, grey);
  b.AddQuad({1, -2, 0}, {0, 0, 2}, {0, 4, 0}, grey);
  b.AddQuad({-1.2, -0.5, 0.01}, {0.8, 0, 0}, {0, 1, 0},
            b.AddConductor({0.2, 0.9, 1.1}, {3.9, 2.5, 2.2}));
  b.AddQuad({-0.2, -0.3, 0.3}, {0, 0.6, 0}, {0.6, 0, 0}, black, b.AddEmission({9, 9, 9}));
  return b.Build();
}

}  // namespace lanelight::test::bidirectional
