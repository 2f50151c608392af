#include "src/base/image/spectrum_integral.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "src/base/image/color_spaces.h"
#include "src/base/image/spectrum_data.h"

namespace lanelight {
namespace {

constexpr int kSteps = kLastNm - kFirstNm + 1;

// A lobe with different widths on either side of its centre.
double Lobe(double nm, double center, double left, double right) {
  const double t = (nm - center) / (nm < center ? left : right);
  return std::exp(-0.5 * t * t);
}

// Colour matching functions of the CIE 1931 observer (Wyman et al. 2013, equation 4).
Vec3d Observer(double nm) {
  return {1.056 * Lobe(nm, 599.8, 37.9, 31.0) + 0.362 * Lobe(nm, 442.0, 16.0, 26.7) -
              0.065 * Lobe(nm, 501.1, 20.4, 26.2),
          0.821 * Lobe(nm, 568.8, 46.9, 40.5) + 0.286 * Lobe(nm, 530.9, 16.3, 31.1),
          1.217 * Lobe(nm, 437.0, 11.8, 36.0) + 0.681 * Lobe(nm, 459.0, 26.0, 13.8)};
}

// Sensitivities of the three sRGB channels at every nm, scaled so that D65 gives 1 each.
struct Sensor {
  std::array<Rgb, kSteps> response;
  std::array<double, kSteps> d65;
  Sensor() {
    const ColorMatrix srgb_from_xyz = Inverse(XyzFromSrgb());
    const Spectrum daylight = DaylightD65();
    Rgb white;
    for (int i = 0; i < kSteps; ++i) {
      response[i] = srgb_from_xyz * Observer(kFirstNm + i);
      d65[i] = daylight(kFirstNm + i);
      white += response[i] * d65[i];
    }
    for (Rgb& r : response) r = {r.x / white.x, r.y / white.y, r.z / white.z};
  }
};

// The observer's table, by cubic interpolation (Lagrange) of four samples.
Vec3d TabulatedObserver(double nm) {
  const double x = (nm - kObserverStart) / kObserverStep;
  const int first =
      std::clamp(static_cast<int>(std::floor(x)) - 1, 0, kObserverSamples - 4);
  Vec3d sum;
  for (int i = first; i < first + 4; ++i) {
    double weight = 1;
    for (int k = first; k < first + 4; ++k) {
      if (k != i) weight *= (x - k) / (i - k);
    }
    sum += Vec3d{kObserver[i][0], kObserver[i][1], kObserver[i][2]} * weight;
  }
  return sum;
}

// D65 through the observer, scaled so that its integral is (1, 1, 1).
class WhiteTable {
 public:
  WhiteTable() {
    Rgb sum;
    for (int nm = kObserverStart; nm <= kEnd; ++nm) {
      const bool at_end = nm == kObserverStart || nm == kEnd;
      sum += Raw(nm) * (at_end ? 0.5 : 1.0);
    }
    white_ = sum;
  }
  Rgb At(double nm) const {
    if (!(nm >= kObserverStart && nm <= kEnd)) return {};
    const Rgb raw = Raw(nm);
    return {raw.x / white_.x, raw.y / white_.y, raw.z / white_.z};
  }

 private:
  static constexpr int kEnd = kObserverStart + kObserverStep * (kObserverSamples - 1);
  Rgb Raw(double nm) const {
    return srgb_from_xyz_ * TabulatedObserver(nm) * daylight_(nm);
  }

  const ColorMatrix srgb_from_xyz_ = Inverse(XyzFromSrgb());
  const Spectrum daylight_ = DaylightD65();
  Rgb white_;
};

const Sensor& GetSensor() {
  static const Sensor sensor;
  return sensor;
}

}  // namespace

Spectrum EvenlySpaced(std::vector<double> samples, double first_nm, double step_nm,
                      bool extend) {
  std::vector<double> nm(samples.size());
  for (std::size_t i = 0; i < nm.size(); ++i) nm[i] = first_nm + step_nm * i;
  return Interpolated(std::move(nm), std::move(samples), extend);
}

Spectrum Interpolated(std::vector<double> nm, std::vector<double> values, bool extend) {
  return [nm = std::move(nm), values = std::move(values), extend](double at) {
    if (at < nm.front()) return extend ? values.front() : 0.0;
    if (at > nm.back()) return extend ? values.back() : 0.0;
    const std::size_t above = std::upper_bound(nm.begin(), nm.end(), at) - nm.begin();
    if (above == nm.size()) return values.back();
    const double t = (at - nm[above - 1]) / (nm[above] - nm[above - 1]);
    return values[above - 1] * (1 - t) + values[above] * t;
  };
}

Spectrum Daylight(double x, double y) {
  const double m = 0.0241 + 0.2562 * x - 0.7341 * y;
  // The standard rounds both weights to three decimals.
  const auto rounded = [](double w) { return std::round(w * 1000) / 1000; };
  const double m1 = rounded((-1.3515 - 1.7703 * x + 5.9114 * y) / m);
  const double m2 = rounded((0.0300 - 31.4424 * x + 30.0717 * y) / m);
  std::vector<double> power(kDaylightSamples);
  for (int i = 0; i < kDaylightSamples; ++i) {
    power[i] = kDaylightS0[i] + m1 * kDaylightS1[i] + m2 * kDaylightS2[i];
  }
  return EvenlySpaced(std::move(power), kDaylightStart, kDaylightStep, false);
}

Spectrum DaylightD65() { return Daylight(0.31271, 0.32912); }

Rgb WhiteFraction(double nm) {
  static const WhiteTable table;
  return table.At(nm);
}

Rgb ColorUnderD65(const Spectrum& reflectance) {
  const Sensor& sensor = GetSensor();
  Rgb sum;
  for (int i = 0; i < kSteps; ++i) {
    sum += sensor.response[i] * (sensor.d65[i] * reflectance(kFirstNm + i));
  }
  return sum;
}

Rgb ColorOfLight(const Spectrum& light) {
  const Sensor& sensor = GetSensor();
  Rgb sum;
  for (int i = 0; i < kSteps; ++i) sum += sensor.response[i] * light(kFirstNm + i);
  return sum;
}

Rgb SensitivityMean(const Spectrum& spectrum) {
  const Sensor& sensor = GetSensor();
  Rgb sum, weights;
  for (int i = 0; i < kSteps; ++i) {
    const Rgb weight = Max(sensor.response[i] * sensor.d65[i], Rgb{});
    sum += weight * spectrum(kFirstNm + i);
    weights += weight;
  }
  return {sum.x / weights.x, sum.y / weights.y, sum.z / weights.z};
}

}  // namespace lanelight
