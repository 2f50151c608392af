// The end of a path: what is written of its sample, and which samples are counted as
// invalid. Samples of every kind are planted; counts are exact.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "kernels/stages.h"
#include "src/base/image/wavelengths.h"
#include "src/scene/compile/spectrum_rows.h"
#include "tests/support/each_target.h"
#include "tests/support/wave_fixture.h"

namespace lanelight {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kExposure = 2;
// Not a multiple of any vector: the last batch repeats the last slot, and that sample is
// an invalid one (112 % kKinds == kNotANumber), which must count once.
constexpr std::uint32_t kPaths = 113, kCapacity = 160, kStride = 200;
constexpr int kPlanes = 3 + 7 + 14 + 4;
constexpr float kUntouched = -77;

enum Kind {
  kGood,
  kNegativeZero,  // not below zero: good
  kNotANumber,
  kInfinite,
  kMinusInfinite,
  kNegative,
  kOverflow,        // becomes infinite by the exposure
  kNanAndInfinite,  // in different channels: counts as NaN alone
  kInfAndNegative,  // counts as infinite alone
  kTiny,            // the least positive normal number: good
  kAlmostTooLarge,  // finite after the exposure: good
  kKinds
};

struct Variant {
  bool sign, aov, numbers;
  bool gbuffer = false;
  FeatureSet features() const {
    FeatureSet f;
    if (sign) f.Add(Feature::kSignedFilter);
    if (aov) f.Add(Feature::kAov);
    if (gbuffer) f.Add(Feature::kGbuffer);
    if (numbers) f.Add(Feature::kRegressionControl);
    return f;
  }
};

struct Sample {
  float color[3];
};

// The planted value stands in channel `c`.
Sample Plant(Kind kind, int c) {
  Sample s = {{1, 2, 3}};
  const int d = (c + 1) % 3;
  switch (kind) {
    case kNegativeZero:
      s.color[c] = -0.0f;
      break;
    case kNotANumber:
      s.color[c] = kNan;
      break;
    case kInfinite:
      s.color[c] = kInf;
      break;
    case kMinusInfinite:
      s.color[c] = -kInf;
      break;
    case kNegative:
      s.color[c] = -1e-30f;
      break;
    case kOverflow:
      s.color[c] = 3e38f;
      break;
    case kNanAndInfinite:
      s.color[c] = kNan, s.color[d] = kInf;
      break;
    case kInfAndNegative:
      s.color[c] = kInf, s.color[d] = -1;
      break;
    case kTiny:
      s.color[c] = std::numeric_limits<float>::min();
      break;
    case kAlmostTooLarge:
      s.color[c] = 1.7e38f;
      break;
    default:
      break;
  }
  return s;
}

enum class Verdict { kGood, kNan, kInfinite, kNegative };

// What is to become of a sample, said independently of how the kernel finds out.
Verdict VerdictOf(Kind kind, const Variant& v) {
  switch (kind) {
    case kNotANumber:
    case kNanAndInfinite:
      return Verdict::kNan;
    case kInfinite:
    case kMinusInfinite:
    case kOverflow:
    case kInfAndNegative:
      return Verdict::kInfinite;
    case kNegative:
      return v.sign ? Verdict::kGood : Verdict::kNegative;
    default:
      return Verdict::kGood;
  }
}

class Finished {
 public:
  explicit Finished(const Variant& v) : variant_(v), fixture_(scene_, kCapacity) {
    PathColumns& p = fixture_.wave.path;
    samples_.assign(std::size_t{kStride} * kPlanes, kUntouched);
    fixture_.wave.buffer = {samples_.data(), kStride};
    fixture_.run.exposure = kExposure;
    fixture_.run.planes = SamplePlanes(v.features());
    std::mt19937 engine(5);
    slots_ = Shuffled(kCapacity, engine);
    outputs_ = Shuffled(kStride, engine);
    Queue& done = fixture_.wave.queue(QueueId::kDone);
    for (std::uint32_t i = 0; i < kPaths; ++i) Fill(p, i);
    std::copy_n(slots_.begin(), kPaths, done.items);
    done.size = kPaths;
    if (!v.sign) p.weight = nullptr;
    if (!v.numbers) p.first_bsdf = nullptr;
    if (!v.gbuffer) p.gb_hit = nullptr;
  }
  void Run() { fixture_.Run(AccumulateStage, variant_.features()); }

  Kind kind(std::uint32_t i) const { return static_cast<Kind>(i % kKinds); }
  Sample planted(std::uint32_t i) const {
    return Plant(kind(i), static_cast<int>(i / kKinds % 3));
  }
  // With a filter of both signs, every other sample's weight is negative.
  float Factor(std::uint32_t i) const {
    return kExposure * (variant_.sign ? Weight(i) : 1);
  }
  float Stored(int plane, std::uint32_t i) const {
    return samples_[static_cast<std::size_t>(plane) * kStride + outputs_[i]];
  }
  static float Aov(int k, std::uint32_t i) { return 10.0f * k + i; }
  static float Gbuffer(int k, std::uint32_t i) { return 0.5f * k - i; }
  static float Number(int k, std::uint32_t i) { return -1.0f - k - 8.0f * i; }

  int PlanesWritten() const {
    return 3 + 7 * variant_.aov + 14 * variant_.gbuffer + 4 * variant_.numbers;
  }
  bool OthersUntouched() const {
    for (int plane = 0; plane < kPlanes; ++plane) {
      const std::uint32_t first = plane < PlanesWritten() ? kPaths : 0;
      for (std::uint32_t i = first; i < kStride; ++i) {
        if (Stored(plane, i) != kUntouched) return false;
      }
    }
    return true;
  }
  bool AllSlotsFree() {
    const Queue& free = fixture_.wave.queue(QueueId::kFree);
    return free.size == kPaths &&
           std::equal(slots_.begin(), slots_.begin() + kPaths, free.items);
  }
  const Health& bad() const { return fixture_.wave.health; }

 private:
  static std::vector<std::uint32_t> Shuffled(std::uint32_t n, std::mt19937& engine) {
    std::vector<std::uint32_t> v(n);
    std::iota(v.begin(), v.end(), 0u);
    std::shuffle(v.begin(), v.end(), engine);
    return v;
  }
  static float Weight(std::uint32_t i) { return i % 2 ? -1.0f : 1.0f; }

  void Fill(PathColumns& p, std::uint32_t i) {
    const std::uint32_t slot = slots_[i];
    const Sample s = planted(i);
    p.output[slot] = outputs_[i];
    p.l_r[slot] = s.color[0], p.l_g[slot] = s.color[1], p.l_b[slot] = s.color[2];
    p.weight[slot] = Weight(i);
    float* aov[] = {p.aov_albedo_r, p.aov_albedo_g, p.aov_albedo_b, p.aov_n_x,
                    p.aov_n_y,      p.aov_n_z,      p.aov_depth};
    for (int k = 0; k < 7; ++k) aov[k][slot] = Aov(k, i);
    float* gbuffer[] = {p.gb_hit,  p.gb_p_x,  p.gb_p_y,  p.gb_p_z,  p.gb_ng_x,
                        p.gb_ng_y, p.gb_ng_z, p.gb_ns_x, p.gb_ns_y, p.gb_ns_z,
                        p.gb_uv_0, p.gb_uv_1, p.gb_dz_0, p.gb_dz_1};
    for (int k = 0; k < 14; ++k) gbuffer[k][slot] = Gbuffer(k, i);
    std::uint32_t* numbers[] = {p.first_film, p.first_bsdf, p.first_light, p.choices};
    for (int k = 0; k < 4; ++k) {
      numbers[k][slot] = std::bit_cast<std::uint32_t>(Number(k, i));
    }
  }

  const Variant variant_;
  CompiledScene scene_;
  WaveFixture fixture_;
  std::vector<float> samples_;
  std::vector<std::uint32_t> slots_, outputs_;
};

constexpr Variant kVariants[] = {{false, false, false},      {false, true, false},
                                 {true, false, false},       {true, true, false},
                                 {true, false, true},        {true, true, true},
                                 {false, true, false, true}, {true, true, false, true}};

void CheckSample(const Finished& f, const Variant& v, std::uint32_t i) {
  const Sample s = f.planted(i);
  const bool good = VerdictOf(f.kind(i), v) == Verdict::kGood;
  INFO("sample " << i << " of kind " << f.kind(i));
  for (int c = 0; c < 3; ++c) {
    CHECK(f.Stored(c, i) == (good ? f.Factor(i) * s.color[c] : 0));
  }
  int plane = 3;
  for (int k = 0; v.aov && k < 7; ++k) {
    CHECK(f.Stored(plane++, i) == Finished::Aov(k, i));
  }
  for (int k = 0; v.gbuffer && k < 14; ++k) {
    CHECK(f.Stored(plane++, i) == Finished::Gbuffer(k, i));
  }
  for (int k = 0; v.numbers && k < 4; ++k) {
    CHECK(f.Stored(plane++, i) == Finished::Number(k, i));
  }
}

}  // namespace

TEST_CASE("invalid samples are counted by kind and written as zero", "[accumulate]") {
  const EachTarget target;
  for (const Variant& v : kVariants) {
    CAPTURE(v.sign, v.aov, v.numbers);
    Finished f(v);
    f.Run();
    std::uint64_t counts[4] = {};
    for (std::uint32_t i = 0; i < kPaths; ++i) {
      ++counts[static_cast<int>(VerdictOf(f.kind(i), v))];
      CheckSample(f, v, i);
    }
    CHECK(f.bad().nan == counts[1]);
    CHECK(f.bad().infinite == counts[2]);
    CHECK(f.bad().negative == counts[3]);
    CHECK((counts[1] > 10 && counts[2] > 20 && (counts[3] > 5) == !v.sign));
    CHECK(VerdictOf(f.kind(kPaths - 1), v) == Verdict::kNan);
    CHECK(f.AllSlotsFree());
    CHECK(f.OthersUntouched());
  }
}

TEST_CASE("a spectral film receives radiance before exposure and the wavelength triple",
          "[accumulate][buckets]") {
  const FeatureSet features = {Feature::kSpectral, Feature::kSpectralFilm,
                               Feature::kFiltered};
  constexpr std::uint32_t kCount = 100;
  const EachTarget target;
  CompiledScene scene;
  scene.spectra = SpectrumRows().Finish();
  WaveFixture fixture(scene, kCapacity);
  std::vector<float> samples(std::size_t{kStride} * 7, kUntouched);
  AlignedVector<float> wavelength(kCapacity);
  fixture.wave.buffer = {samples.data(), kStride};
  fixture.run.exposure = kExposure;
  fixture.run.planes = SamplePlanes(features);
  PathColumns& p = fixture.wave.path;
  p.wavelength = wavelength.data();
  p.first_bsdf = nullptr;
  Queue& done = fixture.wave.queue(QueueId::kDone);
  for (std::uint32_t i = 0; i < kCount; ++i) {
    done.items[i] = p.output[i] = i;
    p.l_r[i] = i == 7 ? kNan : 1.0f;
    p.l_g[i] = 2, p.l_b[i] = 4;
    p.weight[i] = i % 2 ? -0.5f : 1.0f;
    // A third of the numbers for each wavelength that glass may leave.
    const float number = (i % 3 + (i + 0.5f) / kTriples) / 3;
    wavelength[i] = i % 5 == 0 ? -number : number;
  }
  done.size = kCount;
  fixture.Run(AccumulateStage, features);
  for (std::uint32_t i = 0; i < kCount; ++i) {
    CAPTURE(i);
    for (std::uint32_t k = 0; k < 3; ++k) {
      const float radiance = float(1u << k) * (i % 2 ? -0.5f : 1.0f);
      CHECK(samples[(3 + k) * kStride + i] == (i == 7 ? 0 : radiance));
    }
    CHECK(samples[6 * kStride + i] == float(i));
  }
  CHECK(fixture.wave.health.nan == 1);
}

}  // namespace lanelight
