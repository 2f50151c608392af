#include "src/image/measured_reflectance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <istream>
#include <iterator>
#include <map>
#include <numbers>
#include <utility>

#include "src/core/error.h"
#include "src/core/error_text.h"
#include "src/core/input_file.h"
#include "src/image/spectrum_integral.h"

namespace lanelight {
namespace {

constexpr std::string_view kMagic("tensor_file\0", 12);
constexpr std::uint64_t kMostFields = 1000, kMostDimensions = 16;
// Types of numbers in files, by their codes: 1 to 8 are integers.
constexpr int kUint8 = 1, kFloat32 = 10;
constexpr const char* kTypeNames[] = {"none",  "uint8",   "int8",    "uint16",
                                      "int16", "uint32",  "int32",   "uint64",
                                      "int64", "float16", "float32", "float64"};
constexpr std::uint64_t kTypeSizes[] = {0, 1, 1, 2, 2, 4, 4, 8, 8, 2, 4, 8};
constexpr int kTypes = 12;
// No number is larger, so that what is computed of them stays finite.
constexpr float kLargest = 1e12f;
constexpr double kAngleSlack = 1e-3;

[[noreturn]] void FailAt(std::uint64_t place, const std::string& what) {
  throw InputError(fmt::format("byte {}: {}", place, what));
}

struct Field {
  std::uint64_t place;  // of its entry
  std::uint64_t offset;
  int type;
  std::vector<std::uint64_t> shape;
  std::uint64_t count;  // of numbers
};

/// The fields of a file; all of them lie within it.
class TensorFile {
 public:
  explicit TensorFile(std::string bytes) : bytes_(std::move(bytes)) {
    if (bytes_.compare(0, kMagic.size(), kMagic) != 0) {
      FailAt(0, "does not begin as tensor files do, with \"tensor_file\"");
    }
    at_ = kMagic.size();
    const int major = Read<std::uint8_t>("the version");
    const int minor = Read<std::uint8_t>("the version");
    if (major != 1 || minor != 0) {
      FailAt(kMagic.size(), fmt::format("version {}.{}; supported: 1.0", major, minor));
    }
    const auto count = Read<std::uint32_t>("the number of fields");
    if (count > kMostFields) {
      FailAt(at_ - 4, fmt::format("{} fields; at most {}", count, kMostFields));
    }
    for (std::uint32_t i = 0; i < count; ++i) ReadField();
  }

  const Field& Find(const std::string& name) const {
    const auto found = fields_.find(name);
    if (found != fields_.end()) return found->second;
    throw InputError(fmt::format("has no field \"{}\"", name));
  }
  /// The numbers of a field of float32, each within [low, kLargest]; those below `low`
  /// become it, if `raise`, or are an error.
  std::vector<float> Floats(const std::string& name, float low, bool raise) const;
  const std::string& bytes() const { return bytes_; }

 private:
  template <typename T>
  T Read(const char* what) {
    T value;
    if (sizeof value > bytes_.size() - at_) {
      FailAt(at_, fmt::format("the file ends within {}", what));
    }
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }
  void ReadField();

  std::string bytes_;
  std::uint64_t at_ = 0;
  std::map<std::string, Field> fields_;
};

void TensorFile::ReadField() {
  Field field = {at_, 0, 0, {}, 1};
  const auto length = Read<std::uint16_t>("the name of a field");
  if (length > bytes_.size() - at_) FailAt(at_, "the file ends within a name");
  const std::string name = bytes_.substr(at_, length);
  at_ += length;
  const auto dimensions = Read<std::uint16_t>("a number of dimensions");
  if (dimensions > kMostDimensions) {
    FailAt(at_ - 2,
           fmt::format("{} dimensions; at most {}", dimensions, kMostDimensions));
  }
  field.type = Read<std::uint8_t>("a type");
  if (field.type == 0 || field.type >= kTypes) {
    FailAt(at_ - 1,
           fmt::format("type {} of numbers; there are 1 to {}", field.type, kTypes - 1));
  }
  field.offset = Read<std::uint64_t>("an offset");
  const std::uint64_t size = kTypeSizes[field.type], total = bytes_.size();
  for (int d = 0; d < dimensions; ++d) {
    field.shape.push_back(Read<std::uint64_t>("a shape"));
    if (field.count > 0 && field.shape.back() > total / field.count) {
      FailAt(at_ - 8, fmt::format("a shape with {} numbers in a file of {} bytes",
                                  field.shape.back(), total));
    }
    field.count *= field.shape.back();
  }
  if (field.offset > total || field.count > (total - field.offset) / size) {
    FailAt(field.place, fmt::format("{} numbers of {} bytes from byte {} on, but the "
                                    "file ends at byte {}",
                                    field.count, size, field.offset, total));
  }
  if (!fields_.emplace(name, std::move(field)).second) {
    FailAt(at_, fmt::format("a second field \"{}\"", name));
  }
}

std::vector<float> TensorFile::Floats(const std::string& name, float low,
                                      bool raise) const {
  const Field& field = Find(name);
  if (field.type != kFloat32) {
    FailAt(field.place, fmt::format("field \"{}\" of type {}; supported: float32", name,
                                    kTypeNames[field.type]));
  }
  std::vector<float> numbers(field.count);
  if (field.count > 0) {
    std::memcpy(numbers.data(), bytes_.data() + field.offset, field.count * 4);
  }
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (raise && numbers[i] < low && numbers[i] >= -kLargest) numbers[i] = low;
    if (numbers[i] >= low && numbers[i] <= kLargest) continue;
    FailAt(field.offset + 4 * i, fmt::format("number {} of \"{}\" is {}; it lies within "
                                             "{} and {}",
                                             i, name, numbers[i], low, kLargest));
  }
  return numbers;
}

/// What the fields must look like together.
class Reader {
 public:
  explicit Reader(std::string bytes) : file_(std::move(bytes)) {}
  MeasuredReflectance Read();

 private:
  void NeedShape(const std::string& name,
                 const std::vector<std::uint64_t>& leading) const;
  std::vector<double> Nodes(const std::string& name, double low, double high) const;
  MeasuredTensor Tensor(const std::string& name,
                        const std::vector<std::uint64_t>& leading) const;
  void CheckPhi(const MeasuredReflectance& m) const;
  void CheckMass(const std::string& name, const MeasuredTensor& t) const;
  std::vector<float> Colors(const std::vector<float>& spectra, std::size_t slices,
                            std::size_t numbers) const;

  TensorFile file_;
};

// The dimensions before the last two, which are rows and columns: two of each at least.
void Reader::NeedShape(const std::string& name,
                       const std::vector<std::uint64_t>& leading) const {
  const Field& field = file_.Find(name);
  const std::size_t n = leading.size();
  const auto& shape = field.shape;
  const bool fits = shape.size() == n + 2 &&
                    std::equal(leading.begin(), leading.end(), shape.begin()) &&
                    shape[n] >= 2 && shape[n + 1] >= 2 && field.count < 1u << 31;
  if (fits) return;
  FailAt(field.place,
         fmt::format("field \"{}\" has the shape [{}]; expected [{}{}height, "
                     "width], 2 or more each",
                     name, fmt::join(shape, ", "), fmt::join(leading, ", "),
                     n > 0 ? ", " : ""));
}

std::vector<double> Reader::Nodes(const std::string& name, double low,
                                  double high) const {
  const Field& field = file_.Find(name);
  const std::vector<float> floats =
      file_.Floats(name, -static_cast<float>(kLargest), false);
  std::vector<double> nodes(floats.begin(), floats.end());
  if (field.shape.size() != 1 || nodes.empty() || nodes.size() > 1u << 16) {
    FailAt(field.place, fmt::format("field \"{}\" has the shape [{}]; expected [count]",
                                    name, fmt::join(field.shape, ", ")));
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (i > 0 && !(nodes[i] > nodes[i - 1])) {
      FailAt(field.offset + 4 * i, fmt::format("\"{}\" does not increase: {} after {}",
                                               name, nodes[i], nodes[i - 1]));
    }
    if (nodes[i] >= low - kAngleSlack && nodes[i] <= high + kAngleSlack) continue;
    FailAt(field.offset + 4 * i, fmt::format("\"{}\" {}: not within {:.4g} and {:.4g}",
                                             name, nodes[i], low, high));
  }
  return nodes;
}

MeasuredTensor Reader::Tensor(const std::string& name,
                              const std::vector<std::uint64_t>& leading) const {
  NeedShape(name, leading);
  const auto& shape = file_.Find(name).shape;
  MeasuredTensor t;
  t.height = static_cast<int>(shape[leading.size()]);
  t.width = static_cast<int>(shape[leading.size() + 1]);
  t.values = file_.Floats(name, 0, true);
  return t;
}

void Reader::CheckPhi(const MeasuredReflectance& m) const {
  if (m.isotropic()) return;
  constexpr double kPi = std::numbers::pi;
  const double range = m.phi.back() - m.phi.front();
  const int parts = m.parts();
  const bool known = parts == 1 || parts == 2 || parts == 4;
  if (known && std::abs(range * parts - 2 * kPi) < 0.1 &&
      std::abs(m.phi.front() + kPi) < 0.1) {
    return;
  }
  FailAt(file_.Find("phi_i").place,
         fmt::format("\"phi_i\" goes from {:.4g} to {:.4g}; expected from -pi to pi, or "
                     "the first half or quarter of that",
                     m.phi.front(), m.phi.back()));
}

// Of a density: each slice has some.
void Reader::CheckMass(const std::string& name, const MeasuredTensor& t) const {
  const auto size =
      static_cast<std::size_t>(t.width) * static_cast<std::size_t>(t.height);
  for (std::size_t at = 0; at < t.values.size(); at += size) {
    const auto begin = t.values.begin() + static_cast<std::ptrdiff_t>(at);
    const auto end = begin + static_cast<std::ptrdiff_t>(size);
    if (*std::max_element(begin, end) >= 1e-12f) continue;
    FailAt(file_.Find(name).offset + 4 * at,
           fmt::format("slice {} of \"{}\" is 0 everywhere", at / size, name));
  }
}

// Linear sRGB under D65 of values at wavelengths, linear between these: for each of
// `slices`, wavelengths of `numbers` to three of them.
std::vector<float> Reader::Colors(const std::vector<float>& spectra, std::size_t slices,
                                  std::size_t numbers) const {
  const std::vector<double> nm = Nodes("wavelengths", 1, 1e5);
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
    const float* v = spectra.data() + s * nm.size() * numbers;
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

MeasuredReflectance Reader::Read() {
  constexpr double kPi = std::numbers::pi;
  MeasuredReflectance m;
  const Field& jacobian = file_.Find("jacobian");
  if (jacobian.type != kUint8 || jacobian.count != 1 ||
      file_.bytes()[jacobian.offset] == 0) {
    FailAt(jacobian.place,
           "\"jacobian\" is not one uint8 other than 0: spectra that are "
           "not relative to the density of normals are not supported");
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
  const std::uint64_t wavelengths = file_.Find("wavelengths").count;
  m.reflectance = Tensor("spectra", {slices[0], slices[1], wavelengths});
  const auto numbers = static_cast<std::size_t>(m.reflectance.width) *
                       static_cast<std::size_t>(m.reflectance.height);
  m.reflectance.values =
      Colors(m.reflectance.values, m.phi.size() * m.theta.size(), numbers);
  return m;
}

std::shared_ptr<const MeasuredReflectance> FromBytes(std::string bytes,
                                                     const std::string& path) {
  try {
    return std::make_shared<MeasuredReflectance>(Reader(std::move(bytes)).Read());
  } catch (const InputError& error) {
    throw InputError(fmt::format("cannot use the measured reflectance \"{}\": {}", path,
                                 WithoutPrefix(error)));
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
  return FromBytes({std::istreambuf_iterator<char>(file), {}}, path);
}

std::shared_ptr<const MeasuredReflectance> ReadMeasuredReflectance(
    const std::string& path) {
  std::string bytes;
  try {
    bytes = ReadWholeFile(path);
  } catch (const Unreadable& problem) {
    throw InputError(fmt::format("cannot read the measured reflectance \"{}\": {}", path,
                                 problem.reason()));
  }
  return FromBytes(std::move(bytes), path);
}

}  // namespace lanelight
