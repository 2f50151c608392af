#include "tests/reference/measured.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "src/base/core/check.h"

namespace lanelight::reference {
namespace {

constexpr double kPi = std::numbers::pi;

double Theta(Vec3d w) { return std::atan2(std::hypot(w.x, w.y), w.z); }
double Azimuth(Vec3d w) { return w.x == 0 && w.y == 0 ? 0 : std::atan2(w.y, w.x); }
Vec3d Direction(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
          std::cos(theta)};
}
double XOfTheta(double theta) { return std::sqrt(theta * 2 / kPi); }
double YOfPhi(double phi) {
  const double y = phi / (2 * kPi) + 0.5;
  return y - std::floor(y);
}

struct Cell {
  int i;
  double fraction;
};
Cell CellOf(double u, int size) {
  const double scaled = u * (size - 1);
  const int i = std::clamp(static_cast<int>(scaled), 0, size - 2);
  return {i, scaled - i};
}

double Bilinear(const double* v, int width, int height, double x, double y) {
  const Cell cx = CellOf(x, width), cy = CellOf(y, height);
  const double* at = v + cy.i * width + cx.i;
  const double low = at[0] + cx.fraction * (at[1] - at[0]);
  const double high = at[width] + cx.fraction * (at[width + 1] - at[width]);
  return low + cy.fraction * (high - low);
}

// Trapezoids over values at 0, 1, ..., up to `end`.
double AreaUpTo(const std::vector<double>& v, double end) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < v.size() && end > static_cast<double>(i); ++i) {
    const double t = std::min(1.0, end - static_cast<double>(i));
    sum += t * v[i] + 0.5 * t * t * (v[i + 1] - v[i]);
  }
  return sum;
}

// The nodes around x, with weights.
std::vector<std::pair<std::size_t, double>> Around(const std::vector<double>& nodes,
                                                   double x) {
  if (nodes.size() == 1 || x <= nodes.front()) return {{0, 1}};
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    if (x > nodes[i]) continue;
    const double t = (x - nodes[i - 1]) / (nodes[i] - nodes[i - 1]);
    return {{i - 1, 1 - t}, {i, t}};
  }
  return {{nodes.size() - 1, 1}};
}

std::vector<double> Slice(const MeasuredTensor& t, std::size_t slice) {
  const auto size = static_cast<std::size_t>(t.width * t.height);
  const auto begin = t.values.begin() + static_cast<std::ptrdiff_t>(slice * size);
  return {begin, begin + static_cast<std::ptrdiff_t>(size)};
}

Density Normalised(int width, int height, std::vector<double> values) {
  Density d = {width, height, std::move(values)};
  double mass = 0;
  for (int y = 0; y + 1 < height; ++y) {
    for (int x = 0; x + 1 < width; ++x) {
      const double* v = d.values.data() + y * width + x;
      mass += (v[0] + v[1] + v[width] + v[width + 1]) / 4;
    }
  }
  for (double& v : d.values) v *= (width - 1) * (height - 1) / mass;
  return d;
}

// Integrals of the rows themselves, over cells of size 1.
std::vector<double> RowAreas(const Density& d) {
  std::vector<double> areas;
  for (int y = 0; y < d.height; ++y) {
    const double* v = d.values.data() + y * d.width;
    double sum = -(v[0] + v[d.width - 1]) / 2;
    for (int x = 0; x < d.width; ++x) sum += v[x];
    areas.push_back(sum);
  }
  return areas;
}

std::vector<double> Row(const Density& d, double y) {
  std::vector<double> row(static_cast<std::size_t>(d.width));
  for (int x = 0; x < d.width; ++x) {
    row[static_cast<std::size_t>(x)] = d.At(x / (d.width - 1.0), y);
  }
  return row;
}

}  // namespace

double Density::At(double x, double y) const {
  return Bilinear(values.data(), width, height, x, y);
}

Density::Point Density::Shares(double x, double y) const {
  const std::vector<double> rows = RowAreas(*this);
  const std::vector<double> here = Row(*this, y);
  return {AreaUpTo(here, x * (width - 1)) / AreaUpTo(here, width - 1.0),
          AreaUpTo(rows, y * (height - 1)) / AreaUpTo(rows, height - 1.0)};
}

Density::Point Density::Find(double x_share, double y_share) const {
  const auto bisect = [](auto&& below) {
    double low = 0, high = 1;
    for (int i = 0; i < 45; ++i) {
      const double middle = (low + high) / 2;
      (below(middle) ? low : high) = middle;
    }
    return (low + high) / 2;
  };
  const std::vector<double> rows = RowAreas(*this);
  const double total = AreaUpTo(rows, height - 1.0);
  const double y = bisect(
      [&](double v) { return AreaUpTo(rows, v * (height - 1)) < y_share * total; });
  const std::vector<double> row = Row(*this, y);
  const double all = AreaUpTo(row, width - 1.0);
  const double x =
      bisect([&](double u) { return AreaUpTo(row, u * (width - 1)) < x_share * all; });
  return {x, y};
}

Rgb EvaluateMeasuredCos(const MeasuredReflectance& m, Vec3d known, Vec3d other) {
  if (known.z * other.z <= 0) return {};
  if (known.z < 0) return EvaluateMeasuredCos(m, -known, -other);
  // To the part of the circle that was measured.
  if (m.parts() == 2 && known.y > 0) {
    known = {-known.x, -known.y, known.z}, other = {-other.x, -other.y, other.z};
  }
  if (m.parts() == 4 && known.x > 0) known.x = -known.x, other.x = -other.x;
  if (m.parts() == 4 && known.y > 0) known.y = -known.y, other.y = -other.y;
  const double theta = Theta(known), phi = Azimuth(known);
  const Vec3d h = Normalize(known + other);
  const double x = XOfTheta(Theta(h));
  const double y = YOfPhi(Azimuth(h) - (m.isotropic() ? phi : 0));

  std::vector<std::pair<std::size_t, double>> slices;
  const auto phis = m.isotropic() ? Around({0}, 0) : Around(m.phi, phi);
  for (const auto& [p, p_share] : phis) {
    for (const auto& [t, t_share] : Around(m.theta, theta)) {
      slices.emplace_back(p * m.theta.size() + t, p_share * t_share);
    }
  }
  Density visible = {m.vndf.width, m.vndf.height, {}};
  for (const auto& [slice, fraction] : slices) {
    const Density one = Normalised(m.vndf.width, m.vndf.height, Slice(m.vndf, slice));
    visible.values.resize(one.values.size());
    for (std::size_t i = 0; i < one.values.size(); ++i) {
      visible.values[i] += fraction * one.values[i];
    }
  }
  const Density::Point s = visible.Shares(x, y);
  Rgb sum;
  for (const auto& [slice, fraction] : slices) {
    for (int c = 0; c < 3; ++c) {
      const auto values = Slice(m.reflectance, 3 * slice + static_cast<std::size_t>(c));
      sum[c] += fraction * Bilinear(values.data(), m.reflectance.width,
                                    m.reflectance.height, s.x, s.y);
    }
  }
  const double d = Bilinear(Slice(m.ndf, 0).data(), m.ndf.width, m.ndf.height, x, y);
  const double sigma = Bilinear(Slice(m.sigma, 0).data(), m.sigma.width, m.sigma.height,
                                XOfTheta(theta), phi / (2 * kPi) + 0.5);
  return sigma > 0 ? sum * (d / (4 * sigma)) : Rgb{};
}

namespace {

double ProjectedArea(const Ggx& ggx, Vec3d w) { return w.z * (1 + ggx.Lambda(w)); }

// Numbers at the nodes of a square: of(x, y).
template <typename F>
void Fill(int width, int height, std::vector<float>& out, const F& of) {
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      out.push_back(static_cast<float>(of(x / (width - 1.0), y / (height - 1.0))));
    }
  }
}

}  // namespace

std::vector<TensorField> MeasuredFields(const MeasuredModel& m) {
  const auto count = [](auto n) { return static_cast<std::uint64_t>(n); };
  const std::uint64_t n = count(m.normals_size), size = count(m.size);
  TensorField phi = {"phi_i", {count(m.phis)}, {}, ""};
  for (int i = 0; i < m.phis; ++i) {
    const double along = m.phis == 1 ? 0 : i / (m.phis - 1.0);
    phi.numbers.push_back(
        static_cast<float>(m.phis == 1 ? 0 : -kPi + along * 2 * kPi / m.parts));
  }
  TensorField theta = {"theta_i", {count(m.thetas)}, {}, ""};
  for (int i = 0; i < m.thetas; ++i) {
    theta.numbers.push_back(static_cast<float>(i * 88.0 / (m.thetas - 1) * kPi / 180));
  }
  TensorField ndf = {"ndf", {n, n}, {}, ""}, sigma = {"sigma", {n, n}, {}, ""};
  const auto normal = [](double x, double y, double turn) {
    return Direction(x * x * kPi / 2, (2 * y - 1) * kPi + turn);
  };
  Fill(m.normals_size, m.normals_size, ndf.numbers, [&](double x, double y) {
    return m.normals.D(normal(std::min(x, 1 - 1e-9), y, 0));
  });
  Fill(m.normals_size, m.normals_size, sigma.numbers, [&](double x, double y) {
    const Vec3d w = normal(std::min(x, 1 - 1e-6), y, 0);
    return ProjectedArea(m.normals, w);
  });
  const std::vector<std::uint64_t> slices = {count(m.phis), count(m.thetas)};
  TensorField vndf = {"vndf", {slices[0], slices[1], n, n}, {}, ""};
  TensorField luminance = {"luminance", {slices[0], slices[1], size, size}, {}, ""};
  TensorField spectra = {
      "spectra", {slices[0], slices[1], count(m.nm.size()), size, size}, {}, ""};
  for (const float p : phi.numbers) {
    for (const float t : theta.numbers) {
      const Vec3d known = Direction(t, p);
      const double turn = m.phis == 1 ? p : 0;
      std::vector<float> visible;
      Fill(m.normals_size, m.normals_size, visible, [&](double x, double y) {
        const Vec3d h = normal(std::min(x, 1 - 1e-9), y, turn);
        const double jacobian = 2 * kPi * kPi * x * std::sin(x * x * kPi / 2);
        return m.normals.D(h) * std::max(0.0, Dot(known, h)) * jacobian;
      });
      vndf.numbers.insert(vndf.numbers.end(), visible.begin(), visible.end());
      const Density density =
          Normalised(m.normals_size, m.normals_size, {visible.begin(), visible.end()});
      std::vector<Vec3d> normals;
      std::vector<float> unused;
      Fill(m.size, m.size, unused, [&](double x, double y) {
        const Density::Point at = density.Find(x, y);
        normals.push_back(normal(at.x, at.y, turn));
        return 0;
      });
      std::vector<double> mean(normals.size());
      for (const float nm : m.nm) {
        for (std::size_t i = 0; i < normals.size(); ++i) {
          const Vec3d h = normals[i], other = Reflect(known, h);
          const double scale = 4 * ProjectedArea(m.normals, known) / m.normals.D(h);
          const double value = other.z > 0 ? scale * m.f_cos(nm, known, other) : 0;
          spectra.numbers.push_back(static_cast<float>(value));
          mean[i] += value / static_cast<double>(m.nm.size());
        }
      }
      for (const double v : mean) {
        luminance.numbers.push_back(static_cast<float>(v + 0.02));
      }
    }
  }
  TensorField nm = {"wavelengths", {count(m.nm.size())}, m.nm, ""};
  return {{"description", {4}, {}, "test"},
          phi,
          theta,
          ndf,
          sigma,
          vndf,
          luminance,
          spectra,
          nm,
          {"jacobian", {1}, {}, "\1"}};
}

std::string TensorFileOf(const std::vector<TensorField>& fields) {
  std::ostringstream head;
  const auto put = [&](auto value) {
    head.write(reinterpret_cast<const char*>(&value), sizeof value);
  };
  std::uint64_t offset = 18;
  for (const TensorField& f : fields) offset += 13 + f.name.size() + 8 * f.shape.size();
  head.write("tensor_file\0\1\0", 14);
  put(static_cast<std::uint32_t>(fields.size()));
  std::string data;
  for (const TensorField& f : fields) {
    put(static_cast<std::uint16_t>(f.name.size()));
    head << f.name;
    put(static_cast<std::uint16_t>(f.shape.size()));
    put(static_cast<std::uint8_t>(f.bytes.empty() ? 10 : 1));
    put(offset + data.size());
    for (const std::uint64_t s : f.shape) put(s);
    data += f.bytes;
    data.append(reinterpret_cast<const char*>(f.numbers.data()), 4 * f.numbers.size());
  }
  return head.str() + data;
}

std::string MeasuredFile(const MeasuredModel& model) {
  return TensorFileOf(MeasuredFields(model));
}

MeasuredModel MetalModel(double ax, double ay, double blue, double red) {
  MeasuredModel model;
  model.normals = {ax, ay};
  model.f_cos = [=](double nm, Vec3d known, Vec3d other) {
    const Ggx ggx = {ax, ay};
    const Vec3d h = Normalize(known + other);
    const double f0 = blue + (red - blue) * std::clamp((nm - 450) / 200, 0.0, 1.0);
    const double fresnel = f0 + (1 - f0) * std::pow(1 - Dot(known, h), 5);
    return fresnel * ggx.D(h) * ggx.G(known, other) / (4 * known.z);
  };
  return model;
}

MeasuredModel VarnishModel() {
  MeasuredModel model;
  const Ggx ggx = model.normals = {0.28, 0.28};
  model.thetas = 8, model.size = 12, model.normals_size = 32;
  model.nm.clear();
  for (int nm = 380; nm <= 780; nm += 40) model.nm.push_back(static_cast<float>(nm));
  model.f_cos = [=](double nm, Vec3d known, Vec3d other) {
    const Vec3d h = Normalize(known + other);
    const double c = Dot(known, h);
    // A film of 300 nm and index 1.5: light that it reflects twice has gone further.
    const double way = 2 * 1.5 * 300 * std::sqrt(1 - (1 - c * c) / 2.25);
    const double film = 0.35 * (1 - std::cos(2 * kPi * way / nm));
    const double fresnel = film + (1 - film) * std::pow(1 - c, 5);
    const double paint = 0.45 * std::exp(-std::pow((nm - 460) / 60, 2)) + 0.03;
    return fresnel * ggx.D(h) * ggx.G(known, other) / (4 * known.z) +
           (1 - fresnel) * paint * other.z / kPi;
  };
  return model;
}

MeasuredModel BrassModel() {
  MeasuredModel model = MetalModel(0.45, 0.15, 0.35, 0.9);
  model.phis = 4, model.parts = 4;
  model.thetas = 6, model.size = 8, model.normals_size = 24;
  return model;
}

MeasuredModel ChalkModel(double reflectance) {
  MeasuredModel model;
  model.normals = {1, 1};
  model.f_cos = [=](double, Vec3d, Vec3d other) { return reflectance * other.z / kPi; };
  return model;
}

}  // namespace lanelight::reference
