// Film "spectral": its buckets against closed forms and against the colours of the same
// samples, what it goes together with, and the file that it makes.
#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>

#include "src/base/core/json_text.h"
#include "src/base/image/exr.h"
#include "src/base/image/spectrum.h"
#include "src/render/job/identity.h"
#include "src/render/job/loaded_scene.h"
#include "src/render/job/memory.h"
#include "src/render/job/output.h"
#include "src/scene/compiled/scene.h"
#include "src/scene/parse/parse.h"
#include "tests/base/image/temporary_folder.h"
#include "tests/support/input_error.h"

namespace lanelight {
namespace {

// Film of 4 x 4 pixels with further parameters, what is before the world, and the world.
std::string SpectralText(const std::string& film, const std::string& world,
                         const std::string& options = "") {
  return "LookAt 0 0 -5 0 0 0 0 1 0\nCamera \"perspective\" \"float fov\" 20\n"
         "Film \"spectral\" \"integer xresolution\" 4 \"integer yresolution\" 4 " +
         film + "\n" + options + "\nWorldBegin\n" + world;
}

Job SpectralJob(const std::string& text, std::uint64_t spp = 16,
                const std::string& strategy = "",
                std::optional<TransportSetting> requested = std::nullopt) {
  RenderSettings settings;
  settings.spp = spp;
  settings.seed = 3;
  settings.transport = requested;
  settings.strategy = ParseStrategy(strategy, {});
  return PrepareJob(ParseSceneText(text, "test.pbrt", "."), settings);
}

FilmAccumulator SpectralRender(const std::string& text, std::uint64_t spp,
                               const std::string& strategy = "") {
  return RunJob(SpectralJob(text, spp, strategy)).film;
}

double BucketMean(const FilmAccumulator& film, int bucket) {
  double sum = 0;
  for (int y = 0; y < film.height(); ++y) {
    for (int x = 0; x < film.width(); ++x) sum += film.Bucket(x, y, bucket);
  }
  return sum / (film.width() * film.height());
}

double MeanOver(const Spectrum& spectrum, double low, double high) {
  constexpr int kSteps = 2000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i)
    sum += spectrum(low + (high - low) * (i + 0.5) / kSteps);
  return sum / kSteps;
}

// What the observer makes of a pixel's buckets: linear sRGB.
Rgb ColorOfBuckets(const FilmAccumulator& film, int x, int y) {
  const SpectralBuckets& buckets = *film.buckets();
  const Spectrum white = WhiteRadiance();
  Rgb sum;
  for (int k = 0; k < buckets.count; ++k) {
    const double low = buckets.Edge(k), high = buckets.Edge(k + 1);
    for (int c = 0; c < 3; ++c) {
      const Spectrum seen = [&](double nm) { return WhiteFraction(nm)[c] / white(nm); };
      sum[c] += film.Bucket(x, y, k) * MeanOver(seen, low, high) * (high - low);
    }
  }
  return sum;
}

// Samples go through all triples in even steps, in each replicate.
constexpr std::uint64_t kAllTriples = std::uint64_t{kTriples} * kReplicates;
const std::string kEnvironment = "LightSource \"infinite\" ";
const std::string kOneEnvironment = kEnvironment + "\"spectrum L\" [ 300 1 900 1 ]\n";
const std::string kGreyBall =
    "Material \"diffuse\" \"rgb reflectance\" [ 0.5 0.5 0.5 ]\nShape \"sphere\" \"float "
    "radius\" 3\n";

}  // namespace

TEST_CASE("spectral film: buckets of an even sky", "[render][spectral][buckets]") {
  // Light of one value at all wavelengths has luminance 1, and is 1 in pbrt's units.
  // Where the eye sees little, bins are too wide to tell it from D65 (docs/spectral.md).
  const auto flat = SpectralRender(
      SpectralText(
          "\"integer nbuckets\" 10 \"float lambdamin\" 410 \"float lambdamax\" 680",
          kOneEnvironment),
      kAllTriples);
  for (int k = 0; k < 10; ++k) {
    INFO(k);
    CHECK(flat.Bucket(1, 2, k) == Approx(1).epsilon(2e-3));
  }
  // White is D65 however wide bins are; iso is of colours alone.
  const auto white = SpectralRender(
      SpectralText("\"float iso\" 200", kEnvironment + "\"rgb L\" [ 1 1 1 ]\n"),
      kAllTriples);
  CHECK(white.Mean(1, 2).y == Approx(2).epsilon(1e-3));
  for (int k = 0; k < 14; ++k) {
    INFO(k);
    const double low = std::max(380.0, white.buckets()->Edge(k));
    const double mean = MeanOver(WhiteRadiance(), low, white.buckets()->Edge(k + 1));
    CHECK(white.Bucket(1, 2, k) == Approx(mean).epsilon(1e-3));
  }
  CHECK(white.Bucket(1, 2, 15) == 0);  // 800 to 830 nm
}

TEST_CASE("spectral film: a grey furnace has equal buckets on average",
          "[render][spectral][buckets]") {
  // A ball in front of the whole film, in an even sky: half of the sky's radiance.
  const auto film = SpectralRender(
      SpectralText(
          "\"integer nbuckets\" 6 \"float lambdamin\" 400 \"float lambdamax\" 700",
          kOneEnvironment + kGreyBall),
      4 * kAllTriples);
  for (int k = 0; k < 6; ++k) {
    INFO(k);
    CHECK(BucketMean(film, k) == Approx(0.5).epsilon(0.01));
  }
}

TEST_CASE("spectral film: a line is in its bucket, and in no other",
          "[render][spectral][buckets]") {
  // 545.5 nm, of buckets of 10 nm from 380 on the seventeenth.
  const auto film = SpectralRender(
      SpectralText(
          "\"integer nbuckets\" 40 \"float lambdamin\" 380 \"float lambdamax\" 780",
          kEnvironment + "\"spectrum L\" [ 544 0 545 1 546 1 547 0 ]\n"),
      kAllTriples);
  for (int k = 0; k < 40; ++k) {
    INFO(k);
    if (k == 16) {
      // Of luminance 1: the eye's mean sensitivity there is y(545.5) = 0.9803 (CIE 1931).
      CHECK(film.Bucket(2, 1, k) * 10 == Approx(106.857 / 0.9803).epsilon(0.01));
    } else {
      CHECK(film.Bucket(2, 1, k) == 0);
    }
  }
}

TEST_CASE("spectral film: buckets seen by the observer are the colours of the image",
          "[render][spectral][buckets]") {
  const std::string buckets =
      "\"integer nbuckets\" 200 \"float lambdamin\" 380 \"float lambdamax\" 780";
  const std::string world = kEnvironment + "\"blackbody L\" 3000\n" +
                            "Material \"diffuse\" \"rgb reflectance\" [ 0.7 0.3 0.2 ]\n"
                            "Shape \"sphere\" \"float radius\" 0.6\n";
  const std::string glass =
      world +
      "Translate 0 0 -2\nMaterial \"dielectric\" \"spectrum eta\" \"glass-F11\"\n"
      "Shape \"sphere\" \"float radius\" 0.5\n";
  struct Case {
    const char *strategy, *options;
    const std::string& world;
  };
  for (const Case& c :
       {Case{"seen-lights=paths", "", world},
        Case{"points=independent,seen-lights=paths", "", glass},
        Case{"roulette=adjoint,seen-lights=paths", "", glass},
        Case{"pairs=antithetic,seen-lights=paths", "PixelFilter \"mitchell\"", world}}) {
    INFO(c.strategy << c.options);
    const auto film =
        SpectralRender(SpectralText(buckets, c.world, c.options), 256, c.strategy);
    for (int i = 0; i < 16; ++i) {
      const Rgb color = film.Mean(i % 4, i / 4);
      const Rgb seen = ColorOfBuckets(film, i % 4, i / 4);
      for (int channel = 0; channel < 3; ++channel) {
        CHECK(seen[channel] == Approx(color[channel]).margin(0.015 * Luminance(color)));
      }
    }
  }
}

TEST_CASE("spectral film: color transforms do not change buckets",
          "[render][spectral][buckets]") {
  // The plain samples: control variates and directly visible lights change colours only.
  const std::string text = SpectralText(
      "", kOneEnvironment +
              "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [ 20 20 20 ]\n"
              "Translate 0.2 0 -3.5\nShape \"sphere\" \"float radius\" 0.2\n"
              "AttributeEnd\n" +
              kGreyBall);
  const auto plain = SpectralRender(text, 64, "points=independent,seen-lights=paths");
  for (const char* strategy :
       {"points=independent,seen-lights=apart",
        "points=independent,seen-lights=paths,control=regression"}) {
    INFO(strategy);
    auto film = SpectralRender(text, 64, strategy);
    film.FitControl();
    bool colors = false;
    for (int i = 0; i < 16; ++i) {
      colors = colors || !(film.Mean(i % 4, i / 4) == plain.Mean(i % 4, i / 4));
      for (int k = 0; k < 16; ++k) {
        CHECK(film.Bucket(i % 4, i / 4, k) == plain.Bucket(i % 4, i / 4, k));
      }
    }
    CHECK(colors);
  }
}

TEST_CASE("spectral film: other films have no stages for it", "[render][plan][buckets]") {
  const std::string text = SpectralText("", kOneEnvironment + kGreyBall);
  std::string plain = text;
  plain.replace(plain.find("\"spectral\""), 10, "\"rgb\"");
  const Job with = SpectralJob(text);
  const Job without = SpectralJob(plain, 16, "", TransportSetting::kSpectral);
  CHECK(with.plan.features.Has(Feature::kSpectralFilm));
  CHECK_FALSE(without.plan.features.Has(Feature::kSpectralFilm));
  CHECK(SamplePlanes(with.plan.features).count() == 7);
  CHECK(SamplePlanes(without.plan.features).count() == 3);
  CHECK(with.plan.bytes_per_path == without.plan.bytes_per_path);
  CHECK(with.plan.paths().stages.size() == without.plan.paths().stages.size());
  CHECK(MakeFilm(without).buckets() == nullptr);
  CHECK_FALSE(IdentityOf(without).contains("buckets"));
  // Colours are the same bits.
  const auto a = RunJob(with).film, b = RunJob(without).film;
  for (int i = 0; i < 16; ++i) CHECK(a.Mean(i % 4, i / 4) == b.Mean(i % 4, i / 4));
}

TEST_CASE("spectral film: it selects spectral transport", "[render][spectral][buckets]") {
  const std::string text = SpectralText("", kOneEnvironment);
  for (const auto requested : {TransportSetting::kSpectral, TransportSetting::kByScene}) {
    const Job job = SpectralJob(text, 1, "", requested);
    CHECK(job.scene.compiled->features.Has(Feature::kSpectral));
    CHECK(job.loaded->transport_why == "the film keeps spectra");
  }
  CHECK_THAT(InputErrorOf([&] { SpectralJob(text, 1, "", TransportSetting::kRgb); }),
             Catch::Contains("Film \"spectral\" needs wavelengths") &&
                 Catch::Contains("--transport rgb"));
  const std::string says = SpectralText(
      "", kOneEnvironment, "Integrator \"path\" \"string transport\" \"rgb\"");
  CHECK_THAT(InputErrorOf([&] { SpectralJob(says); }),
             Catch::Contains("\"transport\" \"rgb\" of its Integrator"));
  CHECK_NOTHROW(SpectralJob(says, 1, "", TransportSetting::kSpectral));
}

TEST_CASE("spectral film: RGB-only settings are refused", "[render][buckets]") {
  const std::string text = SpectralText("", kOneEnvironment + kGreyBall);
  CHECK_THAT(InputErrorOf([&] { SpectralJob(text, 1, "reuse=block"); }),
             Catch::Contains("reuse=block does not work with Film \"spectral\""));
  const std::string unseen = "LightSource \"point\" \"spectrum I\" [ 790 1 820 1 ]\n";
  CHECK_THAT(InputErrorOf([&] { SpectralJob(SpectralText("", unseen + kGreyBall)); }),
             Catch::Contains("a light emits nothing from 380 to 780 nm") &&
                 Catch::Contains("with Film \"rgb\""));
  CHECK_THAT(
      InputErrorOf([&] { SpectralJob(SpectralText("\"integer nbuckets\" 0", "")); }),
      Catch::Contains("nbuckets"));
  CHECK_THAT(
      InputErrorOf([&] {
        SpectralJob(SpectralText("\"float lambdamin\" 500 \"float lambdamax\" 500", ""));
      }),
      Catch::Contains("narrower than"));
  CHECK_THAT(
      InputErrorOf([&] { SpectralJob(SpectralText("\"float lambdamin\" 300", "")); }),
      Catch::Contains("lambdamin"));
}

TEST_CASE("spectral film: a note says which wavelengths paths carry",
          "[render][buckets]") {
  const auto notes = [](const std::string& film) {
    const auto all = SpectralJob(SpectralText(film, kOneEnvironment)).loaded->description;
    return std::count_if(all.notes.begin(), all.notes.end(), [](const Note& note) {
      return note.message.find("paths carry 380 to 780 nm") != std::string::npos;
    });
  };
  CHECK(notes("") == 1);
  CHECK(notes("\"float lambdamin\" 405 \"float lambdamax\" 680") == 0);
}

TEST_CASE("spectral film: memory is included in the estimate", "[render][buckets]") {
  const PixelRect window = {0, 0, 100, 100};
  // Sums in double, and planes of the file twice.
  CHECK(FilmBytes(window, {Auxiliary::kNone, 32}) ==
        FilmBytes(window, Auxiliary::kNone) + window.pixels() * 32 * (8 + 2 * 4));
  CHECK_THAT(
      InputErrorOf([&] { CheckFilmFits(window, {Auxiliary::kNone, 32}, {}, 1000); }),
      Catch::Contains("with 32 buckets of wavelengths") &&
          Catch::Contains("\"nbuckets\""));
  const Job job = SpectralJob(SpectralText("\"integer nbuckets\" 9", kOneEnvironment));
  CHECK(LayersOf({}, job.loaded->description.film).buckets == 9);
}

TEST_CASE("spectral film: the file has a channel per bucket and metadata",
          "[render][exr][buckets]") {
  const Job job = SpectralJob(SpectralText(
      "\"integer nbuckets\" 3 \"float lambdamin\" 400 \"float lambdamax\" 700",
      kOneEnvironment));
  const JobRun run = RunJob(job);
  const TemporaryFolder folder;
  const std::string path = folder.File("spectra.exr");
  const nlohmann::json identity = IdentityOf(job);
  CHECK(BucketsOf(identity) == SpectralBuckets{3, 400, 700});
  WriteExr(path, 4, 4, FilmPlanes(run.film, 1),
           OutputOptions(identity, nlohmann::json::object(),
                         {run.result, "", EstimateError(run.film)}, run.film, false));
  const Image colors = ReadExr(path);
  CHECK(std::get<std::string>(colors.attributes.at("spectralLayoutVersion")) == "1.0");
  CHECK(std::get<std::string>(colors.attributes.at("emissiveUnits")) == "W.m^-2.sr^-1");
  std::vector<std::string> spectral;
  for (const std::string& name : colors.names) {
    if (name.starts_with("S0.")) spectral.push_back(name);
  }
  const std::vector<std::string> expected = {"S0.450,000nm", "S0.550,000nm",
                                             "S0.650,000nm"};
  CHECK(spectral == expected);
  const Image image = ReadExr(path, expected);
  for (int i = 0; i < 16; ++i) {
    for (int k = 0; k < 3; ++k) {
      CHECK(image.pixels[static_cast<std::size_t>(3 * i + k)] ==
            static_cast<float>(run.film.Bucket(i % 4, i / 4, k)));
    }
  }
}

}  // namespace lanelight
