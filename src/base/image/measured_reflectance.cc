#include "src/base/image/measured_reflectance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <istream>
#include <iterator>
#include <numbers>
#include <utility>

#include "src/base/core/error.h"
#include "src/base/core/input_file.h"
#include "src/base/image/spectrum_integral.h"
#include "src/base/image/tensor_file.h"

namespace lanelight {
namespace {

constexpr double kAngleSlack = 1e-3;
// Conversion takes time quadratic in the number of wavelengths; the database has 195.
constexpr std::size_t kMaxNodes = 4096;

// Linear sRGB under D65 of values at wavelengths, linear between these: turns the
// wavelengths of each slice into three channels.
std::vector<float> ColorsOf(const MeasuredSpectra& spectra, std::size_t slices) {
  const std::vector<double>& nm = spectra.nm;
  const auto numbers = static_cast<std::size_t>(spectra.reflectance.width) *
                       static_cast<std::size_t>(spectra.reflectance.height);
  std::vector<Rgb> weights(nm.size());
  for (std::size_t w = 0; w < nm.size(); ++w) {
    std::vector<double> one(nm.size());
    one[w] = 1;
    weights[w] = ColorUnderD65(Interpolated(nm, one, true));
  }
  std::vector<float> colors(slices * 3 * numbers);
  std::vector<Rgb> sums(numbers);
  for (std::size_t s = 0; s < slices; ++s) {
    std::fill(sums.begin(), sums.end(), Rgb{});
    const float* v = spectra.reflectance.values.data() + s * nm.size() * numbers;
    for (std::size_t w = 0; w < nm.size(); ++w) {
      for (std::size_t i = 0; i < numbers; ++i) sums[i] += weights[w] * double{*v++};
    }
    float* out = colors.data() + s * 3 * numbers;
    for (std::size_t i = 0; i < numbers; ++i) {
      const Rgb c = Max(sums[i], Rgb{});  // outside of sRGB: cut
      out[i] = static_cast<float>(c.x);
      out[numbers + i] = static_cast<float>(c.y);
      out[2 * numbers + i] = static_cast<float>(c.z);
    }
  }
  return colors;
}

class Reader {
 public:
  explicit Reader(std::string bytes) : file_(std::move(bytes)) {}

  MeasuredReflectance Read() {
    constexpr double kPi = std::numbers::pi;
    MeasuredReflectance m;
    const TensorField& jacobian = file_.Find("jacobian");
    if (jacobian.type != kTensorUint8 || jacobian.count != 1 ||
        file_.bytes()[jacobian.offset] == 0) {
      FailAtByte(jacobian.place,
                 "\"jacobian\" is not one uint8 other than 0: spectra that are not "
                 "relative to the density of normals are not supported");
    }
    m.phi = Nodes("phi_i", -2 * kPi, 2 * kPi);
    m.theta = Nodes("theta_i", 0, kPi / 2);
    CheckPhi(m);
    const std::vector<std::uint64_t> slices = {m.phi.size(), m.theta.size()};
    m.ndf = Tensor("ndf", {});
    m.sigma = Tensor("sigma", {});
    m.vndf = Tensor("vndf", slices);
    m.luminance = Tensor("luminance", slices);
    CheckMass("vndf", m.vndf);
    CheckMass("luminance", m.luminance);
    const MeasuredSpectra spectra = Spectra(m.phi.size(), m.theta.size());
    m.reflectance = {spectra.reflectance.width, spectra.reflectance.height,
                     ColorsOf(spectra, m.phi.size() * m.theta.size())};
    return m;
  }

  /// Reads the spectra of this many known directions.
  MeasuredSpectra Spectra(std::size_t phis, std::size_t thetas) const {
    const std::uint64_t wavelengths = file_.Find("wavelengths").count;
    MeasuredSpectra spectra;
    spectra.reflectance = Tensor("spectra", {phis, thetas, wavelengths});
    spectra.nm = Nodes("wavelengths", 1, 1e5);
    return spectra;
  }

 private:
  // The dimensions before the last two, which are rows and columns: two of each at least.
  void RequireShape(const std::string& name,
                    const std::vector<std::uint64_t>& leading) const {
    const TensorField& field = file_.Find(name);
    const std::size_t n = leading.size();
    const auto& shape = field.shape;
    const bool fits = shape.size() == n + 2 &&
                      std::equal(leading.begin(), leading.end(), shape.begin()) &&
                      shape[n] >= 2 && shape[n + 1] >= 2 && field.count < 1u << 31;
    if (fits) return;
    FailAtByte(
        field.place,
        "field \"{}\" has the shape [{}]; expected [{}{}height, width], 2 or more each",
        name, fmt::join(shape, ", "), fmt::join(leading, ", "), n > 0 ? ", " : "");
  }

  std::vector<double> Nodes(const std::string& name, double low, double high) const {
    const TensorField& field = file_.Find(name);
    const std::vector<float> floats =
        file_.Floats(name, -static_cast<float>(kLargestInTensor), false);
    std::vector<double> nodes(floats.begin(), floats.end());
    if (field.shape.size() != 1 || nodes.empty() || nodes.size() > kMaxNodes) {
      FailAtByte(field.place,
                 "field \"{}\" has the shape [{}]; expected [count], at most {}", name,
                 fmt::join(field.shape, ", "), kMaxNodes);
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (i > 0 && !(nodes[i] > nodes[i - 1])) {
        FailAtByte(field.offset + 4 * i, "\"{}\" does not increase: {} after {}", name,
                   nodes[i], nodes[i - 1]);
      }
      if (nodes[i] >= low - kAngleSlack && nodes[i] <= high + kAngleSlack) continue;
      FailAtByte(field.offset + 4 * i, "\"{}\" {}: not within {:.4g} and {:.4g}", name,
                 nodes[i], low, high);
    }
    return nodes;
  }

  MeasuredTensor Tensor(const std::string& name,
                        const std::vector<std::uint64_t>& leading) const {
    RequireShape(name, leading);
    const auto& shape = file_.Find(name).shape;
    MeasuredTensor t;
    t.height = static_cast<int>(shape[leading.size()]);
    t.width = static_cast<int>(shape[leading.size() + 1]);
    t.values = file_.Floats(name, 0, true);
    return t;
  }

  void CheckPhi(const MeasuredReflectance& m) const {
    if (m.isotropic()) return;
    constexpr double kPi = std::numbers::pi;
    const double range = m.phi.back() - m.phi.front();
    const int parts = m.parts();
    const bool known = parts == 1 || parts == 2 || parts == 4;
    if (known && std::abs(range * parts - 2 * kPi) < 0.1 &&
        std::abs(m.phi.front() + kPi) < 0.1) {
      return;
    }
    FailAtByte(file_.Find("phi_i").place,
               "\"phi_i\" goes from {:.4g} to {:.4g}; expected from -pi to pi, or the "
               "first half or quarter of that",
               m.phi.front(), m.phi.back());
  }

  // Requires a density above 0 in each slice.
  void CheckMass(const std::string& name, const MeasuredTensor& t) const {
    const auto size =
        static_cast<std::size_t>(t.width) * static_cast<std::size_t>(t.height);
    for (std::size_t at = 0; at < t.values.size(); at += size) {
      const auto begin = t.values.begin() + static_cast<std::ptrdiff_t>(at);
      const auto end = begin + static_cast<std::ptrdiff_t>(size);
      if (*std::max_element(begin, end) >= 1e-12f) continue;
      FailAtByte(file_.Find(name).offset + 4 * at, "slice {} of \"{}\" is 0 everywhere",
                 at / size, name);
    }
  }

  TensorFile file_;
};

// Returns read(reader of the bytes); its errors name the file.
template <class Read>
auto FromBytes(std::string bytes, const std::string& path, const Read& read) {
  try {
    return read(Reader(std::move(bytes)));
  } catch (const InputError& error) {
    throw InputError("cannot use the measured reflectance \"{}\": {}", path,
                     WithoutPrefix(error));
  }
}

std::shared_ptr<const MeasuredReflectance> Known(std::string bytes,
                                                 const std::string& path) {
  return FromBytes(std::move(bytes), path, [&](Reader reader) {
    auto m = std::make_shared<MeasuredReflectance>(reader.Read());
    m->path = path;
    return m;
  });
}

std::string BytesOf(const std::string& path) {
  try {
    return ReadWholeFile(path);
  } catch (const Unreadable& problem) {
    throw InputError("cannot read the measured reflectance \"{}\": {}", path,
                     problem.reason());
  }
}

}  // namespace

int MeasuredReflectance::parts() const {
  if (isotropic()) return 1;
  const double range = phi.back() - phi.front();
  return static_cast<int>(std::lround(std::min(2 * std::numbers::pi / range, 1e3)));
}

std::shared_ptr<const MeasuredReflectance> ReadMeasuredReflectance(
    std::istream& file, const std::string& path) {
  return Known({std::istreambuf_iterator<char>(file), {}}, path);
}

std::shared_ptr<const MeasuredReflectance> ReadMeasuredReflectance(
    const std::string& path) {
  return Known(BytesOf(path), path);
}

MeasuredSpectra ReadMeasuredSpectra(const MeasuredReflectance& measured) {
  return FromBytes(BytesOf(measured.path), measured.path, [&](const Reader& reader) {
    return reader.Spectra(measured.phi.size(), measured.theta.size());
  });
}

}  // namespace lanelight
