// The texture kernel of every target against the scalar twin.
#include "kernels/simd/each_target-inl.h"

#include "kernels/texture/texture-inl.h"

LANELIGHT_BEGIN_KERNELS

// Textures ids[i] at (u[i], v[i]) for a multiple of 16 points; planes of rgb. Lanes
// without a texture get (-1, -2, -3).
void EvalPoints(const TextureTable& table, const int32_t* ids, const float* u,
                const float* v, float* rgb, std::size_t count) {
  const DF df;
  const DI di;
  for (std::size_t i = 0; i < count; i += hn::Lanes(df)) {
    const UvPoint at = {hn::LoadU(df, u + i), hn::LoadU(df, v + i)};
    const V3 color = EvalTextures(table, hn::LoadU(di, ids + i), at, Splat3(-1, -2, -3));
    hn::StoreU(color.x, df, rgb + i);
    hn::StoreU(color.y, df, rgb + count + i);
    hn::StoreU(color.z, df, rgb + 2 * count + i);
  }
}

void AlphaPoint(const TextureTable& table, int32_t id, float u, float v, float* alpha) {
  *alpha = EvalAlphaAt(table, id, u, v, 0.25f);
}

LANELIGHT_END_KERNELS

#if HWY_ONCE

#include <catch2/catch.hpp>
#include <limits>

#include "src/scene/compile/texture_programs.h"
#include "tests/kernels/texture/texture_files.h"
#include "tests/reference/texture.h"
#include "tests/support/each_target.h"

namespace lanelight {

HWY_EXPORT(EvalPoints);
HWY_EXPORT(AlphaPoint);

namespace {

struct DrawnPoints {
  std::vector<std::int32_t> ids;
  std::vector<float> u, v;
  std::size_t size() const { return u.size(); }
  void Add(std::int32_t id, float pu, float pv) {
    ids.push_back(id), u.push_back(pu), v.push_back(pv);
  }
  void Pad() {
    while (size() % 16 != 0) Add(kNone, 0, 0);
  }
};

std::vector<float> Eval(const TextureTable& table, DrawnPoints points) {
  points.Pad();
  std::vector<float> rgb(3 * points.size());
  LANELIGHT_ON(TestTarget(), EvalPoints)
  (table, points.ids.data(), points.u.data(), points.v.data(), rgb.data(), points.size());
  return rgb;
}

// Inside, outside, exactly on texel edges and centres of images with up to 8 texels, far
// away (where floats still have fractions).
std::vector<float> Coordinates(std::mt19937& random) {
  std::uniform_real_distribution<float> inside(0, 1), around(-4, 4), far(-30000, 30000);
  std::vector<float> out = {0, 1, -0.0f, -1, 2, 0.99999994f, -1e-9f, 1e-9f};
  for (int i = 0; i < 40; ++i) {
    out.insert(out.end(), {inside(random), around(random), far(random)});
    out.push_back(static_cast<float>(static_cast<int>(random() % 64) - 32) / 16);
  }
  return out;
}

// True where rounding may decide which texel or cell is meant: within `margin` of an edge
// but not on it.
bool NearEdge(double x, double margin) {
  const double distance = std::abs(x - std::round(x));
  return distance < margin && distance != 0;
}

// Compares all textures at random points, on every target.
void CompareAll(const std::vector<Texture>& textures, std::uint32_t seed) {
  const TextureTable table = CompileTextures(textures);
  const reference::Textures twin(textures);
  std::mt19937 random(seed);
  DrawnPoints points;
  for (float u : Coordinates(random)) {
    const auto id = static_cast<std::int32_t>(random() % (textures.size() + 1)) - 1;
    const std::vector<float> vs = Coordinates(random);
    for (int k = 0; k < 12; ++k) points.Add(id, u, vs[random() % vs.size()]);
  }
  points.Pad();
  for (const std::string& target : AvailableTargets()) {
    ForceTarget(target);
    const std::vector<float> rgb = Eval(table, points);
    int compared = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Index id = points.ids[i];
      if (id < 0) {
        CHECK(rgb[i] == -1);
        CHECK(rgb[2 * points.size() + i] == -3);
        continue;
      }
      const Texture& t = textures[id];
      const double s = t.mapping.su * points.u[i] + t.mapping.du;
      const double y = t.mapping.sv * points.v[i] + t.mapping.dv;
      const double size = t.kind == TextureKind::kImage ? 8 : 1;
      const double error =
          2e-7 * (std::abs(s) + std::abs(y) + 1);  // of float coordinates
      const bool steps = t.kind != TextureKind::kImage || !t.bilinear;
      if (steps &&
          (NearEdge(s * size, error * size) || NearEdge(y * size, error * size))) {
        continue;
      }
      const Rgb want = twin.Eval(id, points.u[i], points.v[i]);
      const bool rounded = t.mapping.su != 1 || t.wrap != WrapMode::kRepeat;
      const double margin =
          1e-5 + (rounded ? 4 * size * error * 4 * std::abs(t.scale) : 1e-5);
      for (int c = 0; c < 3; ++c) {
        INFO(target << ": " << t.name << " " << id << " at (" << points.u[i] << ", "
                    << points.v[i] << ") channel " << c);
        CHECK(std::abs(rgb[c * points.size() + i] - want[c]) <= margin);
      }
      ++compared;
    }
    CHECK(compared > 700);
  }
  ForceTarget("");
}

}  // namespace

TEST_CASE("image textures: every wrap mode, filter and file type", "[texture]") {
  const TemporaryFolder folder;
  const std::vector<std::string> files = {
      folder.Write("color.tga", RandomTga(8, 4, 24, 1)),
      folder.Write("alpha.tga", RandomTga(4, 8, 32, 2)),
      folder.Write("grey.tga", RandomTga(8, 8, 8, 3)),
      folder.Write("one.tga", RandomTga(1, 1, 24, 4)),
      folder.File("color.pfm"),
      folder.File("grey.pfm"),
      folder.File("alpha.exr")};
  WritePfm(files[4], RandomFloats(8, 2, 3, 5));
  WritePfm(files[5], RandomFloats(2, 8, 1, 6));
  WriteRandomExr(files[6], 4, 4, true);
  std::uint32_t seed = 0;
  for (const WrapMode wrap : {WrapMode::kRepeat, WrapMode::kClamp, WrapMode::kBlack,
                              WrapMode::kOctahedralSphere}) {
    for (const bool bilinear : {true, false}) {
      std::vector<Texture> textures;
      for (const std::string& file : files) {
        Texture t = ImageTexture(file);
        t.wrap = wrap;
        t.bilinear = bilinear;
        t.is_float = seed % 3 == 0;
        t.encoding = seed % 3 == 1 ? Encoding::kLinear : Encoding::kSrgb;
        if (seed % 5 == 2) t.encoding = Encoding::kGamma;
        t.scale = seed % 2 ? 1 : 0.75;
        t.invert = seed % 4 == 3;
        textures.push_back(t);
        ++seed;
      }
      CompareAll(textures, seed);
    }
  }
}

TEST_CASE("octahedral images are folded once at each edge", "[texture]") {
  const TemporaryFolder folder;
  // Texel (i, j) is 10 j + i + 1.
  Image image = MakeImage(4, 4, {"Y"});
  for (int k = 0; k < 16; ++k) {
    image.pixels[k] = static_cast<float>(10 * (k / 4) + k % 4 + 1);
  }
  WritePfm(folder.File("a.pfm"), image);
  Texture t = ImageTexture(folder.File("a.pfm"));
  t.wrap = WrapMode::kOctahedralSphere;
  t.bilinear = false;
  const TextureTable table = CompileTextures({t});
  struct Texel {
    double i, j;  // column and row, from the top
    float expected;
  };
  // Beyond an edge the other coordinate is mirrored; below 0 pbrt leaves out the first.
  const Texel lookups[] = {{1, 2, 22},  {-1, 1, 22}, {-2, 0, 33},  {4, 1, 24}, {5, 3, 3},
                           {2, -1, 12}, {0, 4, 34},  {-1, -1, 33}, {4, 4, 11}};
  DrawnPoints points;
  for (const Texel& l : lookups) {
    points.Add(0, static_cast<float>((l.i + 0.5) / 4),
               static_cast<float>(1 - (l.j + 0.5) / 4));
  }
  points.Pad();
  const std::vector<float> rgb = Eval(table, points);
  for (std::size_t k = 0; k < std::size(lookups); ++k) {
    CAPTURE(lookups[k].i, lookups[k].j);
    CHECK(rgb[k] == lookups[k].expected);
  }
}

TEST_CASE("odd sizes interpolate as well", "[texture]") {
  const TemporaryFolder folder;
  std::vector<Texture> textures = {
      ImageTexture(folder.Write("a.tga", RandomTga(7, 5, 24, 1))),
      ImageTexture(folder.Write("b.tga", RandomTga(1, 3, 24, 2)))};
  textures[1].mapping = {2.5, -1.75, 0.125, 10};
  CompareAll(textures, 11);
}

TEST_CASE("combined textures: checkerboard, mix, scale, nested and shared", "[texture]") {
  const TemporaryFolder folder;
  std::vector<Texture> textures;
  textures.push_back(ImageTexture(folder.Write("a.tga", RandomTga(8, 8, 24, 1))));
  textures.push_back(ConstantTexture({0.25, 0.5, 0.75}));
  Texture t;
  t.name = "checkerboard";
  t.kind = TextureKind::kCheckerboard;
  t.mapping = {4, 2, 0.5, 0};
  t.tex1 = {{0.1, 0.2, 0.3}, kNone};
  t.tex2 = {{}, 1};
  textures.push_back(t);
  t.name = "checkerboard of mixes";
  t.mapping = {};
  t.tex1 = {{1, 0, 0}, kNone};
  t.tex2 = {{0, 0, 1}, kNone};
  textures.push_back(t);
  Texture mix;
  mix.name = "mix";
  mix.kind = TextureKind::kMix;
  mix.tex1 = {{}, 0};
  mix.tex2 = {{}, 1};
  mix.amount = {0.3, kNone};
  textures.push_back(mix);
  Texture amount = ImageTexture(textures[0].path);
  amount.is_float = true;
  textures.push_back(amount);
  mix.name = "mix by an image";
  mix.tex2 = {{}, 4};
  mix.amount = {0, 5};
  textures.push_back(mix);
  Texture scale;
  scale.name = "scale";
  scale.kind = TextureKind::kScale;
  scale.tex1 = {{}, 6};
  scale.amount = {0, 5};
  textures.push_back(scale);

  const TextureTable table = CompileTextures(textures);
  CHECK(table.images.size() == 2);      // colour and its mean
  CHECK(table.programs[2].count == 1);  // the constant child is folded
  CHECK(table.programs[4].count == 2);
  CHECK(table.programs[7].count == 5);  // 0, 4, 5, 6, 7, each once

  // The twin's steps must be judged by the steps of the children as well: compare at
  // points away from the edges of eighths.
  const reference::Textures twin(textures);
  std::mt19937 random(3);
  DrawnPoints points;
  for (int i = 0; i < 2000; ++i) {
    const auto at = [&] { return (static_cast<int>(random() % 400) - 200 + 0.37f) / 8; };
    points.Add(static_cast<std::int32_t>(random() % textures.size()), at(), at());
  }
  const EachTarget target;
  const std::vector<float> rgb = Eval(table, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Rgb want = twin.Eval(points.ids[i], points.u[i], points.v[i]);
    INFO(" " << textures[points.ids[i]].name);
    for (int c = 0; c < 3; ++c) {
      CHECK(rgb[c * points.size() + i] == Approx(want[c]).margin(2e-5));
    }
  }
}

TEST_CASE("checkerboard parity holds for negative and huge cells", "[texture]") {
  Texture t;
  t.kind = TextureKind::kCheckerboard;
  t.tex1 = {{1, 1, 1}, kNone};
  t.tex2 = {{0, 0, 0}, kNone};
  const TextureTable table = CompileTextures({t});
  DrawnPoints points;
  const std::vector<std::pair<float, int>> cells = {
      {0.5f, 0}, {1.5f, 1},    {-0.5f, 1},   {-1.5f, 0},    {2, 0},     {-1, 1},
      {-2, 0},   {8388607, 1}, {8388606, 0}, {16777216, 0}, {3e30f, 0}, {-3e30f, 0}};
  for (const auto& s : cells) {
    for (const auto& v : cells) points.Add(0, s.first, v.first);
  }
  const EachTarget target;
  const std::vector<float> rgb = Eval(table, points);
  std::size_t i = 0;
  for (const auto& s : cells) {
    for (const auto& v : cells) {
      INFO(s.first << ", " << v.first);
      CHECK(rgb[i++] == ((s.second + v.second) % 2 == 0 ? 1 : 0));
    }
  }
}

TEST_CASE("NaN coordinates stay inside the image", "[texture]") {
  const TemporaryFolder folder;
  const float inf = std::numeric_limits<float>::infinity(), nan = std::nanf("");
  std::vector<Texture> textures;
  for (int w = 0; w < 4; ++w) {
    textures.push_back(ImageTexture(folder.Write("a.tga", RandomTga(3, 3, 24, 1))));
    textures.back().wrap = static_cast<WrapMode>(w);
  }
  const TextureTable table = CompileTextures(textures);
  DrawnPoints points;
  for (float u : {nan, inf, -inf, 3e38f, -3e38f, 0.5f}) {
    for (float v : {nan, inf, -inf, 3e38f, -3e38f, 0.5f}) {
      for (int id = 0; id < 4; ++id) points.Add(id, u, v);
    }
  }
  const EachTarget target;
  const std::vector<float> rgb = Eval(table, points);  // must not read outside (asan)
  const std::size_t last = points.size() - 4;          // (0.5, 0.5) with every mode
  for (int id = 0; id < 4; ++id) CHECK((rgb[last + id] >= 0 && rgb[last + id] <= 1));
  const std::size_t clamped = 4 * (1 * 6 + 2) + 1;  // u = inf, v = -inf, clamp
  CHECK((rgb[clamped] >= 0 && rgb[clamped] <= 1));
}

TEST_CASE("alpha of one hit", "[texture]") {
  const TemporaryFolder folder;
  Texture t = ImageTexture(folder.Write("a.tga", RandomTga(4, 4, 32, 8)));
  t.is_float = true;
  const std::vector<Texture> textures = {t};
  const TextureTable table = CompileTextures(textures);
  const EachTarget target;
  float alpha = 0;
  LANELIGHT_ON(TestTarget(), AlphaPoint)(table, 0, 0.3f, 0.6f, &alpha);
  CHECK(alpha == Approx(reference::EvalTexture(textures, 0, 0.3f, 0.6f).x).margin(1e-5));
  LANELIGHT_ON(TestTarget(), AlphaPoint)(table, kNone, 0.3f, 0.6f, &alpha);
  CHECK(alpha == 0.25f);
}

}  // namespace lanelight

#endif  // HWY_ONCE
