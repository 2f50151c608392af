// Pyramids against averages over areas, and lookups in them against closed forms.
#include <catch2/catch.hpp>
#include <numeric>

#include "kernels/stages.h"
#include "src/scene/compile/texture_programs.h"
#include "tests/kernels/surface/bump_files.h"
#include "tests/support/each_target.h"
#include "tests/support/wave_fixture.h"

namespace lanelight {
namespace {

// 256 linear values, as of an image of linear bytes.
std::vector<float> LinearBytes() {
  std::vector<float> decode(256);
  for (int i = 0; i < 256; ++i) decode[static_cast<std::size_t>(i)] = i / 255.0f;
  return decode;
}

TextureImage Floats(int width, int height) {
  TextureImage image;
  image.width = width;
  image.height = height;
  std::mt19937 random(5);
  std::uniform_real_distribution<float> uniform(0, 2);
  for (int i = 0; i < 3 * width * height; ++i) image.rgb.push_back(uniform(random));
  return image;
}

double Mean(const TextureImage& image, std::size_t level, int channel) {
  double sum = 0;
  const int n = image.level_width[level] * image.level_height[level];
  for (int i = 0; i < n; ++i) {
    sum += image.rgb[3 * static_cast<std::size_t>(image.level_begin[level] + i) +
                     static_cast<std::size_t>(channel)];
  }
  return sum / n;
}

// One material whose reflectance is the texture; the colours that the stage gives to
// points with a footprint.
struct Lookups {
  CompiledScene scene;
  TemporaryFolder folder;

  Lookups(int size, const std::function<double(double, double)>& f, ImageFilter filter,
          double max_anisotropy = 8) {
    WriteGreyImage(folder.File("i.exr"), size, f);
    Texture texture = ImageTexture(folder.File("i.exr"));
    texture.filter = filter;
    texture.max_anisotropy = max_anisotropy;
    scene.textures = CompileTextures({texture});
    MaterialTable& m = scene.materials;
    m.kind = {0};
    m.color0_r = m.color0_g = m.color0_b = {0.5f};
    m.color0_texture = {0};
  }
  explicit Lookups(const Texture& texture) {
    scene.textures = CompileTextures({texture});
    MaterialTable& m = scene.materials;
    m.kind = {0};
    m.color0_r = m.color0_g = m.color0_b = {0.5f};
    m.color0_texture = {0};
  }
  struct Point {
    float u, v, dudx = 0, dudy = 0, dvdx = 0, dvdy = 0;
    Vec3f p{}, tg{}, tv{};
  };
  std::vector<float> Eval(const std::vector<Point>& points) {
    const auto n = static_cast<std::uint32_t>(points.size());
    WaveFixture f(scene, n);
    PathColumns& p = f.wave.path;
    p.alpha_x = p.alpha_y = p.color1_r = p.color1_g = p.color1_b = nullptr;
    p.coat_thickness = p.coat_g = nullptr;
    for (std::uint32_t i = 0; i < n; ++i) {
      p.material[i] = 0;
      p.uv_u[i] = points[i].u, p.uv_v[i] = points[i].v;
      p.footprint_0[i] = points[i].dudx, p.footprint_1[i] = points[i].dudy;
      p.footprint_2[i] = points[i].dvdx, p.footprint_3[i] = points[i].dvdy;
      const auto [at, tg, tv] = std::tie(points[i].p, points[i].tg, points[i].tv);
      p.p_x[i] = at.x, p.p_y[i] = at.y, p.p_z[i] = at.z;
      p.tg_x[i] = tg.x, p.tg_y[i] = tg.y, p.tg_z[i] = tg.z;
      p.tv_x[i] = tv.x, p.tv_y[i] = tv.y, p.tv_z[i] = tv.z;
    }
    f.QueueAll(QueueId::kSurface, n);
    f.Run(TextureStage, {Feature::kTextures, Feature::kUv, Feature::kTextureFootprints});
    return {p.color0_r, p.color0_r + n};
  }
};

}  // namespace

TEST_CASE("levels are averages over areas", "[texture][levels]") {
  const std::vector<float> decode = LinearBytes();
  SECTION("powers of two: over 2 x 2 texels") {
    TextureImage image = Floats(8, 4);
    AddMipLevels(decode.data(), image);
    REQUIRE(image.level_width == AlignedVector<std::int32_t>{8, 4, 2, 1});
    REQUIRE(image.level_height == AlignedVector<std::int32_t>{4, 2, 1, 1});
    REQUIRE(image.level_begin == AlignedVector<std::int32_t>{0, 32, 40, 42});
    for (int j = 0; j < 2; ++j) {
      for (int i = 0; i < 4; ++i) {
        float sum = 0;
        for (int k = 0; k < 4; ++k) {
          sum += image.rgb[static_cast<std::size_t>(
              3 * ((2 * j + k / 2) * 8 + 2 * i + k % 2) + 1)];
        }
        CHECK(image.rgb[static_cast<std::size_t>(3 * (32 + j * 4 + i) + 1)] ==
              Approx(sum / 4).epsilon(1e-6));
      }
    }
  }
  SECTION("any size: the mean stays, and bounds hold") {
    for (const auto& [w, h] : {std::pair{7, 5}, {1, 9}, {13, 2}, {100, 37}}) {
      CAPTURE(w, h);
      TextureImage image = Floats(w, h);
      AddMipLevels(decode.data(), image);
      for (std::size_t l = 1; l < image.level_begin.size(); ++l) {
        CHECK(image.level_width[l] == std::max(1, image.level_width[l - 1] / 2));
        for (int c = 0; c < 3; ++c) {
          CHECK(Mean(image, l, c) == Approx(Mean(image, 0, c)).epsilon(1e-5));
        }
      }
      CHECK(image.level_width.back() * image.level_height.back() == 1);
    }
  }
  SECTION("bytes: rounded to the nearest, once") {
    TextureImage image;
    image.width = image.height = 16;
    std::mt19937 random(6);
    double sum = 0;
    for (int i = 0; i < 256; ++i) {
      image.rgba8.push_back(random() & 255);
      sum += image.rgba8.back() / 255.0;
    }
    AddMipLevels(decode.data(), image);
    REQUIRE(image.rgba8.size() == 256 + 64 + 16 + 4 + 1);
    CHECK(std::abs((image.rgba8.back() & 255) / 255.0 - sum / 256) < 0.5001 / 255);
  }
}

TEST_CASE("without a footprint filters use the finest level", "[texture][levels]") {
  const auto f = [](double u, double v) { return 0.2 + 0.5 * u + 0.1 * v; };
  for (const ImageFilter filter : {ImageFilter::kTrilinear, ImageFilter::kEwa}) {
    Lookups lookups(32, f, filter);
    for (const float u : {0.1f, 0.5f, 0.77f}) {
      CHECK(lookups.Eval({{u, 0.3f}})[0] == Approx(f(u, 0.3)).epsilon(1e-5));
    }
  }
}

TEST_CASE("trilinear: level log2 of twice the longest step", "[texture][levels]") {
  const EachTarget target;
  // Columns of 0 and 1 in turn: level 0 is 0 or 1 at texel centres, all others 1/2.
  Lookups lookups(
      64, [](double u, double) { return static_cast<int>(u * 64) % 2; },
      ImageFilter::kTrilinear);
  const float centre = 33.5f / 64, texel = 1.0f / 64;
  const auto c = lookups.Eval({{centre, 0.5f, texel / 2},                  // one texel
                               {centre, 0.5f, 0, texel},                   // two: level 1
                               {centre, 0.5f, 0, 0, texel * 0.70710678f},  // 2^0.5
                               {centre, 0.5f, 0, 0, 0, 10},
                               {centre, 0.5f, 1e8f},
                               {centre, 0.5f, -texel}});
  CHECK(c[0] == Approx(1).margin(1e-4));
  CHECK(c[1] == Approx(0.5).margin(1e-4));
  CHECK(c[2] == Approx(0.75).margin(1e-3));
  CHECK(c[3] == Approx(0.5).margin(1e-4));
  CHECK(c[4] == Approx(0.5).margin(1e-4));
  CHECK(c[5] == Approx(0.5).margin(1e-4));
}

TEST_CASE("ewa keeps detail across the long axis", "[texture][levels]") {
  const auto stripes = [](double u, double) { return static_cast<int>(u * 64) / 8 % 2; };
  const float texel = 1.0f / 64, u = 12.0f / 64;  // middle of a bright stripe
  const Lookups::Point along = {u, 0.5f, texel / 2, 0, 0, 8 * texel};
  const Lookups::Point across = {u, 0.5f, 16 * texel, 0, 0, texel};
  Lookups ewa(64, stripes, ImageFilter::kEwa, 16);
  Lookups trilinear(64, stripes, ImageFilter::kTrilinear);
  CHECK(ewa.Eval({along})[0] == Approx(1).margin(1e-3));
  CHECK(trilinear.Eval({along})[0] < 0.6f);
  CHECK(ewa.Eval({across})[0] == Approx(0.5).margin(0.1));
  // Bounded anisotropy blurs, and the mean over a period stays.
  Lookups isotropic(64, stripes, ImageFilter::kEwa, 1);
  const Lookups::Point longer = {u, 0.5f, texel / 2, 0, 0, 16 * texel};
  CHECK(isotropic.Eval({longer})[0] < 0.8f);
  CHECK(ewa.Eval({longer})[0] > 0.9f);
  std::vector<Lookups::Point> period;
  for (int i = 0; i < 256; ++i) {
    period.push_back({static_cast<float>(i) / 256, 0.4f, 3 * texel, texel, 0, 2 * texel});
  }
  const std::vector<float> all = ewa.Eval(period);
  CHECK(std::accumulate(all.begin(), all.end(), 0.0) / 256 == Approx(0.5).epsilon(1e-4));
}

TEST_CASE("images have mipmap levels only where a filter uses them",
          "[texture][levels]") {
  Lookups plain(16, [](double u, double) { return u; }, ImageFilter::kBilinear);
  CHECK(plain.scene.textures.images[0].level_begin.empty());
  CHECK(plain.scene.textures.images[0].rgb.size() == 3 * 256);
  Lookups filtered(16, [](double u, double) { return u; }, ImageFilter::kTrilinear);
  CHECK(filtered.scene.textures.images[0].level_begin.size() == 5);
}

TEST_CASE("checkerboards are filtered by a triangle of 1.5 steps to either side",
          "[texture][levels]") {
  Texture texture;
  texture.kind = TextureKind::kCheckerboard;
  texture.filter = ImageFilter::kTrilinear;
  texture.mapping = {2, 3, 0.25, 0};
  texture.tex1.constant = {1, 1, 1};
  texture.tex2.constant = {0.25, 0.25, 0.25};
  Lookups lookups(texture);
  // The mean of a square wave over the triangle, by the midpoint rule.
  const auto mean = [](double x, double reach) {
    constexpr int kSteps = 20000;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
      const double at = (i + 0.5) / kSteps * 2 - 1;
      const bool odd = std::fmod(std::floor(x + at * reach) + 1000, 2) != 0;
      sum += (odd ? -1 : 1) * (1 - std::abs(at)) * 2 / kSteps;
    }
    return sum;
  };
  for (const float step : {0.0f, 0.003f, 0.05f, 0.15f, 0.4f, 3.0f}) {
    for (const float u : {0.1f, 0.37f, 0.38f, 0.62f, -4.9f}) {
      for (const float v : {0.01f, 0.33f, 0.5f}) {
        CAPTURE(step, u, v);
        // The longer of both steps counts, in the texture's own coordinates.
        const float value =
            lookups.Eval({{u, v, step, -step / 2, 0.1f * step, -step}})[0];
        const double product =
            mean(2.0 * u + 0.25, 1.5 * 2 * step) * mean(3.0 * v, 1.5 * 3 * step);
        CHECK(value == Approx(0.625 + 0.375 * product).margin(5e-4));
      }
    }
  }
}

TEST_CASE("mappings by position are filtered by steps along the surface",
          "[texture][levels]") {
  constexpr float kPi = 3.14159265f, kStep = 0.02f;
  Texture texture;
  texture.kind = TextureKind::kCheckerboard;
  texture.filter = ImageFilter::kTrilinear;
  texture.tex1.constant = {1, 1, 1};
  // The weight of tex1 at `edge` of a reach from the only edge: 1 - (1 - edge)^2 / 2.
  const auto check = [&](MappingKind kind, Lookups::Point at, double edge) {
    texture.mapping.kind = kind;
    const float value = Lookups(texture).Eval({at})[0];
    const double less = std::pow(1 - edge, 2) / 2;
    CAPTURE(static_cast<int>(kind), edge, value);
    CHECK(value == Approx(1 - less).margin(2e-3));
  };
  // Planar: s = x. A reach is 1.5 steps.
  check(MappingKind::kPlanar,
        {0, 0, kStep, 0, 0, 0, {0.75f * kStep, 0.5f, 0}, {1, 0, 0}, {0, 1, 0}}, 0.5);
  // About z from -x: at (-1, -y) turns begin, and a step around by kStep is that over 2
  // pi.
  const float angle = 0.75f * kStep;
  const Vec3f start = {-std::cos(angle), -std::sin(angle), 0.5f};
  check(MappingKind::kCylindrical,
        {0, 0, kStep, 0, 0, 0, start, {std::sin(angle), -std::cos(angle), 0}, {}}, 0.5);
  // The angle to z over pi is s: with an edge at the pole, at 0.75 of a step from it the
  // turns are 1/8, of which a step along the meridian is none.
  const Vec3f down = {std::cos(angle) * std::sqrt(0.5f),
                      std::cos(angle) * std::sqrt(0.5f), -std::sin(angle)};
  const Vec3f pole = {std::sin(angle) * std::sqrt(0.5f),
                      std::sin(angle) * std::sqrt(0.5f), std::cos(angle)};
  check(MappingKind::kSpherical, {0, 0, kStep, 0, 0, 0, pole, down, {}}, 0.5);
  CHECK(angle < kPi / 8);
}

TEST_CASE("checkerboards of programs and solid ones stay sharp", "[texture][levels]") {
  Texture texture;
  texture.kind = TextureKind::kCheckerboard;
  texture.tex1.constant = {1, 1, 1};
  CHECK(Lookups(texture).Eval({{0.01f, 0.5f, 1, 1, 1, 1}})[0] == 1);
  texture.filter = ImageFilter::kTrilinear;
  texture.dimension = 3;
  CHECK(CompileTextures({texture}).nodes[0].filter == ImageFilter::kBilinear);
}

}  // namespace lanelight
