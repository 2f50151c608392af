// The image is a pure function of the scene and the seed: bit-identical for any number of
// threads and any wavefront size, statistically equal over SIMD targets.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/render/run/render_fixture.h"
#include "tests/support/test_target.h"

namespace lanelight {
namespace {

// Every kind of stage that can go wrong with order: several materials, light shapes,
// vertex-normal-free triangles, spheres, planes, roulette.
const char* kScene = R"(
LookAt 0 2 -6  0 0.8 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 37 "integer yresolution" 29
PixelFilter "gaussian"
Integrator "path" "integer maxdepth" 7
WorldBegin
LightSource "infinite" "rgb L" [ 0.2 0.3 0.4 ]
LightSource "point" "point3 from" [ 2 4 -2 ] "rgb I" [ 9 9 9 ]
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 6 5 4 ]
  Translate -2 3 0
  Shape "sphere" "float radius" 0.3
AttributeEnd
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 3 3 3 ]
  Shape "trianglemesh" "point3 P" [ 1 3 1  2 3 1  2 3 2 ] "integer indices" [ 0 1 2 ]
AttributeEnd
AttributeBegin
  Rotate -90 1 0 0
  Material "diffuse" "rgb reflectance" [ 0.6 0.5 0.4 ]
  Shape "plane"
AttributeEnd
Material "dielectric" "float eta" 1.5
AttributeBegin
  Translate -0.8 0.7 -1
  Shape "sphere" "float radius" 0.7
AttributeEnd
Material "conductor" "float roughness" 0.2
AttributeBegin
  Translate 0.9 0.8 0
  Shape "sphere" "float radius" 0.8
AttributeEnd
Material "coateddiffuse" "rgb reflectance" [ 0.1 0.3 0.6 ] "float roughness" 0.1
Shape "trianglemesh" "point3 P" [ -3 0 2  3 0 2  3 3 2.5  -3 3 2.5 ] "integer indices" [ 0 1 2 0 2 3 ]
)";

// Walks through media that vary, of different lengths in the lanes of a vector, and media
// behind them, which draw again.
const char* kCloudScene = R"(
LookAt 0 0 -4  0 0 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 24 "integer yresolution" 18
Integrator "volpath" "integer maxdepth" 9
WorldBegin
LightSource "distant" "point3 from" [ -2 3 -2 ] "rgb L" [ 3 2.8 2.5 ]
LightSource "infinite" "rgb L" [ 0.2 0.3 0.4 ]
MakeNamedMedium "lump" "string type" "cloud" "float density" 2
  "rgb sigma_a" [ 0.1 0.2 0.3 ] "rgb sigma_s" [ 7 6 5 ]
  "point3 p0" [ -1 -0.7 -1 ] "point3 p1" [ 1 0.8 1 ]
Material "interface"
MediumInterface "lump" ""
Shape "sphere" "float radius" 1.1
MakeNamedMedium "haze" "string type" "homogeneous"
  "rgb sigma_a" [ 0.1 0.1 0.1 ] "rgb sigma_s" [ 0.9 0.7 0.5 ]
MediumInterface "haze" ""
Translate 0 0 3
Shape "sphere" "float radius" 1.8
)";

}  // namespace

TEST_CASE("images of clouds are bit-identical for any wavefront size", "[determinism]") {
  TestRender base;
  base.spp = 8;
  base.threads = 1;
  base.wavefront = 1000;
  const Rendered reference = RenderText(kCloudScene, base);
  CHECK(reference.result.health.Total() == 0);
  for (std::uint32_t wavefront : {64u, 192u, 8192u}) {
    TestRender other = base;
    other.wavefront = wavefront;
    INFO("wavefront " << wavefront);
    CHECK(Identical(RenderText(kCloudScene, other).film, reference.film));
  }
}

TEST_CASE("images are bit-identical for any threads and wavefront size",
          "[determinism]") {
  for (SampleSequence sampler :
       {SampleSequence::kIndependent, SampleSequence::kStratified, SampleSequence::kSobol,
        SampleSequence::kHalton}) {
    TestRender base;
    base.sampler = sampler;
    base.spp = 12;
    base.threads = 1;
    base.wavefront = 1000;
    const Rendered reference = RenderText(kScene, base);
    CHECK(reference.result.health.Total() == 0);
    for (int threads : {1, 2}) {
      for (std::uint32_t wavefront : {64u, 1000u, 8192u}) {
        TestRender other = base;
        other.threads = threads;
        other.wavefront = wavefront;
        INFO(threads << " threads, wavefront " << wavefront);
        CHECK(Identical(RenderText(kScene, other).film, reference.film));
      }
    }
    TestRender seeded = base;
    seeded.seed = 2;
    CHECK_FALSE(Identical(RenderText(kScene, seeded).film, reference.film));
  }
}

TEST_CASE("path reuse is bit-identical for any threads and wavefront size",
          "[determinism]") {
  for (const char* strategy :
       {"reuse=block:16", "reuse=block:64:compact", "reuse=block:4,directions=uniform",
        "light-paths=splats:5", "reuse=block,pixel-samples=shared"}) {
    INFO(strategy);
    TestRender base;
    base.strategy = strategy;
    base.spp = 12;
    base.threads = 1;
    base.wavefront = 1000;
    const Rendered reference = RenderText(kScene, base);
    CHECK(reference.result.health.Total() == 0);
    CHECK(reference.plan.features.HasAny({Feature::kReuse, Feature::kLightPaths}));
    for (const std::uint32_t wavefront : {64u, 8192u}) {
      TestRender other = base;
      other.threads = 2;
      other.wavefront = wavefront;
      CHECK(Identical(RenderText(kScene, other).film, reference.film));
    }
    TestRender alone = base;
    alone.strategy = "reuse=none,light-paths=none";
    CHECK_FALSE(Identical(RenderText(kScene, alone).film, reference.film));
  }
}

TEST_CASE("all SIMD targets give statistically the same image", "[determinism]") {
  std::vector<Rgb> means, errors;
  for (const std::string& target : AvailableTargets()) {
    ForceTarget(target);
    TestRender t;
    t.spp = 256;
    t.seed = 10 + means.size();  // independent images, so that the errors add
    const Rendered r = RenderText(kScene, t);
    CHECK(r.result.health.Total() == 0);
    means.push_back(ImageMean(r.film));
    errors.push_back(ImageStandardError(r.film));
  }
  ForceTarget("");
  for (std::size_t i = 1; i < means.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const double sigma = std::hypot(errors[0][c], errors[i][c]);
      INFO("target " << AvailableTargets()[i] << " channel " << c);
      // 5 sigma: one false alarm in 10^6 comparisons; a 3 % bias would be caught.
      CHECK(std::abs(means[i][c] - means[0][c]) < 5 * sigma);
      CHECK(5 * sigma < 0.03 * means[0][c]);
    }
  }
}

}  // namespace lanelight
