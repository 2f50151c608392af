// Paths that carry wavelengths: closed forms, and the scalar tracer, which renders each
// triple of wavelengths by itself (AtTriple).
#include <catch2/catch.hpp>

#include "src/base/image/spectrum.h"
#include "tests/agreement/spectral_reference.h"
#include "tests/base/image/temporary_folder.h"
#include "tests/reference/measured.h"

namespace lanelight::test {
namespace {

// Of a colour that is the spectrum under D65, or that of the light.
ColorValue Reflecting(const Spectrum& spectrum) {
  return {ColorUnderD65(spectrum), kNone, Own(spectrum)};
}

void CheckColor(const SceneDescription& scene, std::uint64_t spp, Rgb exact,
                double tolerance, const std::string& strategy = "") {
  const auto image = RenderWavefront(Spectral(scene), spp, strategy);
  const auto result = stat::CompareMeans(
      image,
      stat::ExpectedImage(image.width, image.height, [&](int, int) { return exact; }),
      {4, 1e-6, tolerance, tolerance * 0.02});
  INFO(result.ToString());
  CHECK(result.same);
  CHECK(result.detectable_bias < 0.02);
}

// Colours of every kind, by spectra and not.
SceneDescription ColorfulRoom() {
  SceneBuilder b(8, 8);
  b.Depth(3).Perspective({0, -4, 3}, {0, 0, 0.3}, {0, 0, 1}, 40);
  b.AddPlane({0, 0, 0}, {0, 0, 1}, b.AddDiffuse({0.63, 0.065, 0.05}));
  Material copper;
  copper.kind = MaterialKind::kConductor;
  for (const char* name : {"metal-Cu-eta", "metal-Cu-k"}) {
    const Spectrum s = *SpectrumOfName(name);
    (name[9] == 'e' ? copper.eta : copper.k) = {ColorUnderD65(s), kNone, Own(s)};
  }
  copper.uroughness.constant = copper.vroughness.constant = 0.3;
  copper.remap_roughness = false;
  b.AddSphere({0.6, 0, 0.4}, 0.4, b.AddMaterial(copper));
  Material tinted;
  tinted.kind = MaterialKind::kConductor;
  tinted.has_reflectance = true;
  tinted.reflectance.constant = {0.2, 0.4, 0.8};
  tinted.uroughness.constant = tinted.vroughness.constant = 0.4;
  tinted.remap_roughness = false;
  b.AddSphere({-0.5, -0.4, 0.3}, 0.3, b.AddMaterial(tinted));
  Material leaf;
  leaf.kind = MaterialKind::kDiffuseTransmission;
  leaf.reflectance.constant = {0.1, 0.4, 0.1};
  leaf.transmittance.constant = {0.2, 0.4, 0.05};
  b.AddDisk({-0.6, 0.3, 0.9}, {0, -1, 1}, 0.4, b.AddMaterial(leaf));
  const Index lamp = b.AddEmission({6, 4, 2});
  b.AddQuad({-0.5, 1, 2}, {1, 0, 0}, {0, -0.6, 0.3}, b.AddDiffuse(Grey(0.5)), lamp);
  b.AddSpot({0, 0, 3}, {0, 0, 0}, {1, 2, 6}, 30, 10);
  b.AddDistant({1, 0, 2}, {0.6, 0.5, 0.2});
  b.scene().lights.back().spectrum = Own(BlackbodySpectrum(2856));
  b.scene().lights.back().emission = RgbFromBlackbody(2856) * 0.5;
  b.AddEnvironment({0.2, 0.25, 0.4});
  return b.Build();
}

// The same in fog that absorbs, scatters and glows by colour.
SceneDescription ColorfulFog() {
  SceneDescription scene = ColorfulRoom();
  Medium fog;
  fog.sigma_a = {0.02, 0.05, 0.1};
  fog.sigma_s = {0.1, 0.08, 0.04};
  fog.emission = {0.5, 0.3, 0.2};
  fog.g = 0.3;
  scene.media.push_back(fog);
  scene.camera.medium = 0;
  return scene;
}

// A patch that fills the image, under light from straight above.
SceneDescription Patch(const ColorValue& reflectance, const ColorValue& light) {
  SceneBuilder b(8, 8);
  b.Depth(1).Orthographic({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 1);
  Material m;
  m.reflectance = reflectance;
  b.AddPlane({0, 0, 0}, {0, 0, 1}, b.AddMaterial(m));
  b.AddDistant({0, 0, 1}, light.constant * 3.14159265358979);
  b.scene().lights.back().spectrum = light.spectrum;
  return b.Build();
}

// Colour of light that a surface has changed, for light of luminance 1.
Rgb ColorUnder(const Spectrum& light, const Spectrum& reflectance) {
  const Spectrum d65 = DaylightD65();
  const Rgb lit =
      FilmRgb([&](double nm) { return light(nm) * reflectance(nm) / d65(nm); });
  return lit / Luminance(FilmRgb([&](double nm) { return light(nm) / d65(nm); }));
}

}  // namespace

TEST_CASE("spectral: grey scenes equal those in RGB", "[spectral]") {
  const SceneDescription room = SmallRoom(16, 4);
  SceneDescription grey = room;
  for (Material& m : grey.materials) {
    for (ColorValue* c : {&m.reflectance, &m.eta, &m.k, &m.transmittance}) {
      c->constant = Grey(c->constant.y);
    }
  }
  for (AreaLight& light : grey.area_lights) light.radiance = Grey(light.radiance.y);
  const auto rgb = RenderWavefront(grey, 16);
  const auto spectral = RenderWavefront(Spectral(grey), 16);
  CHECK(LargestDifference(rgb, spectral) < 1e-5);
  // That a difference would be seen.
  CHECK(LargestDifference(RenderWavefront(room, 16),
                          RenderWavefront(Spectral(room), 16)) > 1e-3);
}

TEST_CASE("spectral: a patch under white light has its colour", "[spectral]") {
  const Rgb colors[] = {
      {0.63, 0.065, 0.05}, {0.14, 0.45, 0.091}, {0.05, 0.1, 0.7}, {1, 1, 1}, {0, 0, 0}};
  for (Rgb color : colors) {
    INFO(color.x << " " << color.y << " " << color.z);
    const auto image =
        RenderWavefront(Spectral(Patch({color}, {Grey(1)})), 2048, "points=sobol");
    Rgb mean;
    for (const Rgb& c : image.mean) mean += c / double(image.mean.size());
    for (int c = 0; c < 3; ++c) CHECK(mean[c] == Approx(color[c]).margin(2e-3));
  }
}

TEST_CASE("spectral: metamers match under one lamp only", "[spectral]") {
  // Grey, and grey plus waves that D65 does not show.
  const Spectrum waves[3] = {[](double nm) { return std::sin(nm / 15); },
                             [](double nm) { return std::sin(nm / 40); },
                             [](double nm) { return std::cos(nm / 40); }};
  const Spectrum bump = [](double nm) { return std::cos(nm / 22); };
  ColorMatrix m;
  for (int c = 0; c < 3; ++c) {
    for (int k = 0; k < 3; ++k) m.row[c][k] = FilmRgb(waves[k])[c];
  }
  const Vec3d fraction = Inverse(m) * FilmRgb(bump);
  const Spectrum hidden = [&](double nm) {
    return bump(nm) - fraction.x * waves[0](nm) - fraction.y * waves[1](nm) -
           fraction.z * waves[2](nm);
  };
  double maximum = 0;
  for (int nm = 380; nm <= 780; ++nm) maximum = std::max(maximum, std::abs(hidden(nm)));
  const Spectrum plain = [](double) { return 0.5; };
  const Spectrum other = [&](double nm) { return 0.5 + 0.45 * hidden(nm) / maximum; };
  CHECK(Length(FilmRgb(plain) - FilmRgb(other)) < 1e-9);
  const Spectrum lamp = *SpectrumOfName("stdillum-A");
  Rgb color;
  REQUIRE(NamedSpectrum("stdillum-A", SpectrumUse::kIlluminant, &color));
  const ColorValue daylight = {Grey(1)}, bulb = {color, kNone, Own(lamp)};
  CHECK(Length(ColorUnder(lamp, plain) - ColorUnder(lamp, other)) > 0.02);
  for (const Spectrum& surface : {plain, other}) {
    CheckColor(Patch(Reflecting(surface), daylight), 8192, Grey(0.5), 2e-3);
    CheckColor(Patch(Reflecting(surface), bulb), 8192, ColorUnder(lamp, surface), 3e-3);
  }
}

TEST_CASE("spectral: textured colours", "[spectral]") {
  const std::string text = R"(
    LookAt 0 0 5  0 0 0  0 1 0
    Camera "orthographic" "float screenwindow" [ -1 1 -1 1 ]
    Film "rgb" "integer xresolution" 8 "integer yresolution" 8
    PixelFilter "box" "float xradius" 0.5 "float yradius" 0.5
    Integrator "path" "integer maxdepth" 1
    WorldBegin
    LightSource "distant" "point3 from" [ 0 0 1 ] "point3 to" [ 0 0 0 ]
      "rgb L" [ 3.14159265 3.14159265 3.14159265 ]
    Texture "t" "spectrum" "checkerboard" "float uscale" 1e-9 "float vscale" 1e-9
      "rgb tex1" [ 0.6 0.3 0.1 ] "rgb tex2" [ 0.6 0.3 0.1 ]
    Material "diffuse" "texture reflectance" "t"
    Shape "disk" "float radius" 9)";
  CheckColor(ParseSceneText(text, "test.pbrt", "."), 4096, {0.6, 0.3, 0.1}, 4e-3);
}

TEST_CASE("spectral: agrees with the scalar tracer, triple by triple", "[spectral]") {
  const SceneDescription room = ColorfulRoom();
  stat::CheckSame(stat::CompareMeans(RenderWavefront(Spectral(room), 4096),
                                     SpectralReference(room, 64), {4, 1e-6, 2e-3}),
                  0.03);
  // Power: RGB is not that near.
  const auto rgb = stat::CompareMeans(RenderWavefront(room, 4096),
                                      SpectralReference(room, 64), {4, 1e-6, 2e-3});
  CHECK_FALSE(rgb.same);
}

TEST_CASE("spectral: media agree with the scalar tracer", "[spectral]") {
  const SceneDescription fog = ColorfulFog();
  stat::CheckSame(stat::CompareMeans(RenderWavefront(Spectral(fog), 4096),
                                     SpectralReference(fog, 400), {4, 1e-6, 2e-3}),
                  0.04);
}

TEST_CASE("spectral: measured materials agree with the scalar tracer", "[spectral]") {
  const TemporaryFolder folder;
  auto model = reference::VarnishModel();
  SceneBuilder b(8, 8);
  b.Depth(2).Perspective({0, -4, 1.5}, {0, 0, 0.4}, {0, 0, 1}, 30);
  b.AddPlane({0, 0, -0.1}, {0, 0, 1}, b.AddDiffuse({0.6, 0.3, 0.2}));
  Material varnish;
  varnish.kind = MaterialKind::kMeasured;
  varnish.measured = ReadMeasuredReflectance(
      folder.Write("varnish.bsdf", reference::MeasuredFile(model)));
  b.AddSphere({0, 0, 0.6}, 0.6, b.AddMaterial(varnish));
  b.AddQuad({-1, -1.5, 2.5}, {0, 2, 0}, {2, 0, 0}, b.AddDiffuse(Grey(0)),
            b.AddEmission({8, 7, 5}));
  b.AddEnvironment({0.3, 0.4, 0.5});
  const SceneDescription scene = b.Build();
  const auto reference = SpectralReference(scene, 200);
  const auto image = RenderWavefront(Spectral(scene), 4096);
  stat::CheckSame(stat::CompareMeans(image, reference, {4, 1e-6, 2e-3}), 0.05);
  // Power: a file without colour is not that near.
  SceneDescription grey = scene;
  for (Material& m : grey.materials) {
    if (m.measured == nullptr) continue;
    m.measured = ReadMeasuredReflectance(
        folder.Write("grey.bsdf", reference::MeasuredFile(reference::ChalkModel(0.3))));
  }
  CHECK_FALSE(stat::CompareMeans(RenderWavefront(Spectral(grey), 4096), reference,
                                 {4, 1e-6, 2e-3})
                  .same);
  stat::CheckSame(
      stat::CompareMeans(RenderWavefront(Spectral(scene), 4096, "reuse=block"), image,
                         {4, 1e-6, 2e-3, 1e-5}),
      "reuse=block");
}

TEST_CASE("spectral: dispersive glass conserves energy", "[spectral]") {
  for (double roughness : {0.0, 0.3}) {
    Material glass;
    glass.kind = MaterialKind::kDielectric;
    glass.interface_eta = 1.78472;
    glass.dispersion = Own(*SpectrumOfName("glass-F11"));
    glass.uroughness.constant = glass.vroughness.constant = roughness;
    glass.remap_roughness = false;
    const auto rgb = RenderWavefront(Furnace(glass, 20), 2048);
    Rgb kept;
    for (const Rgb& c : rgb.mean) kept += c / double(rgb.mean.size());
    const auto image = RenderWavefront(Spectral(Furnace(glass, 20)), 16384);
    Rgb mean;
    for (const Rgb& c : image.mean) mean += c / double(image.mean.size());
    INFO("roughness " << roughness << ": " << mean.x << " " << mean.y << " " << mean.z
                      << ", RGB " << kept.x);
    // One wavelength of three: a standard error of 0.002 here.
    for (int c = 0; c < 3; ++c) CHECK(mean[c] == Approx(kept[c]).margin(0.01));
  }
}

TEST_CASE("spectral: a thin sheet also disperses", "[spectral]") {
  Material sheet;
  sheet.kind = MaterialKind::kThinDielectric;
  sheet.dispersion = Own(*SpectrumOfName("glass-F11"));
  const auto image = RenderWavefront(Spectral(Furnace(sheet, 20)), 8192);
  Rgb mean;
  for (const Rgb& c : image.mean) mean += c / double(image.mean.size());
  for (int c = 0; c < 3; ++c) CHECK(mean[c] == Approx(1).margin(0.015));
}

TEST_CASE("spectral: every strategy that supports wavelengths is unbiased",
          "[spectral]") {
  const SceneDescription room = Spectral(ColorfulRoom());
  const auto reference = RenderWavefront(room, 8192);
  const char* const strategies[] = {"directions=bsdf",
                                    "directions=uniform",
                                    "roulette=adjoint",
                                    "roulette=none",
                                    "roulette=constant",
                                    "light-selection=tree",
                                    "light-candidates=resampled",
                                    "points=sobol",
                                    "pairs=antithetic",
                                    "control=regression,c=1",
                                    "seen-lights=paths"};
  for (const char* strategy : strategies) {
    stat::CheckSame(stat::CompareMeans(RenderWavefront(room, 2048, strategy), reference,
                                       {4, 1e-7, 1e-4, 1e-6}),
                    0.1, strategy);
  }
}

TEST_CASE("spectral: images agree on every SIMD target", "[spectral]") {
  const SceneDescription room = Spectral(ColorfulRoom());
  const auto reference = RenderWavefront(room, 256);
  for (const std::string& target : AvailableTargets()) {
    ForceTarget(target);
    stat::CheckSame(
        stat::CompareMeans(RenderWavefront(room, 256), reference, {4, 1e-6, 1e-3, 1e-6}),
        target);
  }
  ForceTarget("");
}

// A sky whose colour differs by triple has no edges that the camera sees.
TEST_CASE("spectral: edges of lights are found as in RGB", "[spectral]") {
  SceneBuilder b(16, 16);
  b.Depth(1).Perspective({0, -4, 0}, {0, 0, 0}, {0, 0, 1}, 40);
  b.AddSphere({0, 0, 0}, 0.5, b.AddDiffuse(Grey(0)));
  b.AddEnvironment({6, 1, 0.5});
  const SceneDescription scene = b.Build();
  TestRender options;
  const auto rays = [&](const SceneDescription& s) {
    return RenderDescription(s, options).result.rays_closest;
  };
  CHECK(rays(Spectral(scene)) == rays(scene));
}

TEST_CASE("spectral: the albedo output is the visible colour", "[spectral]") {
  TestRender options;
  options.spp = 1024;
  options.auxiliary = Auxiliary::kAov;
  options.sampler = SampleSequence::kSobol;
  const Rgb color = {0.2, 0.4, 0.8};
  const Rendered render = RenderDescription(Spectral(Patch({color}, {Grey(1)})), options);
  for (int c = 0; c < 3; ++c) {
    CHECK(render.film.Aov(3, 3, c) == Approx(color[c]).margin(0.01));
  }
}

}  // namespace lanelight::test
