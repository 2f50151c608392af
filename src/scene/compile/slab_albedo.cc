#include "src/scene/compile/media.h"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/special_functions/legendre.hpp>
#include <cmath>
#include <utility>

#include "src/base/core/parallel.h"

namespace lanelight {
namespace {

constexpr int kNodes = 10;          // of each part of the directions
constexpr int kTerms = 2 * kNodes;  // of the phase function
constexpr int kAlbedos = 33;
constexpr double kThinLayer = 0x1p-26;
constexpr int kMaxDoublings = 60;

using Row = std::vector<double>;
using Matrix = std::vector<Row>;

Matrix Zero(std::size_t n) { return Matrix(n, Row(n)); }

Matrix operator*(const Matrix& a, const Matrix& b) {
  Matrix c = Zero(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < a.size(); ++k) {
      for (std::size_t j = 0; j < a.size(); ++j) c[i][j] += a[i][k] * b[k][j];
    }
  }
  return c;
}

Matrix OneMinus(Matrix a) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (double& v : a[i]) v = -v;
    a[i][i] += 1;
  }
  return a;
}

// a^-1 b, by Gauss's elimination with the largest pivots.
Matrix Solve(Matrix a, Matrix b) {
  const std::size_t n = a.size();
  for (std::size_t k = 0; k < n; ++k) {
    const auto larger = [&](const Row& x, const Row& y) {
      return std::abs(x[k]) < std::abs(y[k]);
    };
    const auto begin = a.begin() + static_cast<std::ptrdiff_t>(k);
    const auto pivot =
        static_cast<std::size_t>(std::max_element(begin, a.end(), larger) - a.begin());
    std::swap(a[k], a[pivot]);
    std::swap(b[k], b[pivot]);
    for (std::size_t i = 0; i < n; ++i) {
      if (i == k) continue;
      const double f = a[i][k] / a[k][k];
      for (std::size_t j = 0; j < n; ++j) a[i][j] -= f * a[k][j], b[i][j] -= f * b[k][j];
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (double& v : b[i]) v /= a[i][i];
  }
  return b;
}

struct Streams {
  Row mu, weight;  // the last one is the normal, without weight
  Row reflected;   // by the boundary, from within
};

void AddGauss(double low, double high, Streams& d) {
  using Rule = boost::math::quadrature::gauss<double, kNodes>;
  for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
    for (const double sign : {-1., 1.}) {
      d.mu.push_back(0.5 * (low + high + sign * Rule::abscissa()[i] * (high - low)));
      d.weight.push_back(0.5 * (high - low) * Rule::weights()[i]);
    }
  }
}

// Returns the Fresnel reflectance of unpolarised light within a material of index eta.
double ReflectedInside(double mu, double eta) {
  const double sine2 = eta * eta * (1 - mu * mu);
  if (sine2 >= 1) return 1;
  const double out = std::sqrt(1 - sine2);
  const double s = (eta * mu - out) / (eta * mu + out);
  const double p = (mu - eta * out) / (mu + eta * out);
  return 0.5 * (s * s + p * p);
}

Streams MakeStreams(double eta) {
  Streams d;
  const double total = eta > 1 ? std::sqrt(1 - 1 / (eta * eta)) : 0;
  if (total > 0) AddGauss(0, total, d);
  AddGauss(total, 1, d);
  d.mu.push_back(1);
  d.weight.push_back(0);
  for (const double mu : d.mu) d.reflected.push_back(ReflectedInside(mu, eta));
  return d;
}

struct Layer {
  Matrix r, t;  // intensities to intensities
};

// A layer so thin that light scatters in it once at most.
Layer ThinLayer(double albedo, double g, const Streams& d) {
  const double peak = std::pow(g, kTerms);
  const double scattered = albedo * (1 - peak) / (1 - albedo * peak);
  const std::size_t n = d.mu.size();
  Layer layer = {Zero(n), Zero(n)};
  for (int l = 0; l < kTerms; ++l) {
    const double moment = (2 * l + 1) * (std::pow(g, l) - peak) / (1 - peak);
    Row p;
    for (const double mu : d.mu) p.push_back(boost::math::legendre_p(l, mu));
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        const double v = moment * p[i] * p[j];
        layer.t[i][j] += v;
        layer.r[i][j] += l % 2 == 0 ? v : -v;
      }
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const double f = scattered * d.weight[j] * kThinLayer / (2 * d.mu[i]);
      layer.t[i][j] *= f;
      layer.r[i][j] *= f;
    }
    layer.t[i][i] += 1 - kThinLayer / d.mu[i];
  }
  return layer;
}

double Largest(const Matrix& a) {
  double largest = 0;
  for (const Row& row : a) {
    for (const double v : row) largest = std::max(largest, std::abs(v));
  }
  return largest;
}

// Returns the reflectance of a half space, by doubling a layer until nothing passes.
Matrix HalfSpaceReflectance(Layer layer) {
  for (int i = 0; i < kMaxDoublings && Largest(layer.t) > 1e-7; ++i) {
    const Matrix many = Solve(OneMinus(layer.r * layer.r), layer.t);
    const Matrix back = layer.t * layer.r * many;
    layer.t = layer.t * many;
    for (std::size_t a = 0; a < back.size(); ++a) {
      for (std::size_t b = 0; b < back.size(); ++b) layer.r[a][b] += back[a][b];
    }
  }
  return layer.r;
}

// The root of 1 - albedo, in which the reflectance is nearly linear, of an entry: close
// together where that falls steeply.
double NodeOf(std::size_t entry) {
  const double t = static_cast<double>(entry) / (kAlbedos - 1);
  return t * t;
}

}  // namespace

double SlabReflectance(double albedo, double g, double eta) {
  if (albedo >= 1) return 1;
  const Streams d = MakeStreams(eta);
  const Matrix deep = HalfSpaceReflectance(ThinLayer(albedo, g, d));
  // By reciprocity, this is the light that leaves along the normal under light from all
  // directions.
  const std::size_t n = d.mu.size();
  Matrix inside = deep, lit = Zero(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      inside[i][j] *= d.reflected[j];
      lit[i][0] += deep[i][j] * (1 - d.reflected[j]);
    }
  }
  return Solve(OneMinus(inside), lit)[n - 1][0];
}

SlabAlbedos::SlabAlbedos(double g, double eta) : reflectances_(kAlbedos) {
  ParallelFor(reflectances_.size(), [&](std::size_t i) {
    const double s = NodeOf(i);
    reflectances_[i] = SlabReflectance(1 - s * s, g, eta);
  });
}

double SlabAlbedos::Of(double reflectance) const {
  const auto below =
      std::ranges::find_if(reflectances_, [&](double r) { return r <= reflectance; });
  if (below == reflectances_.begin()) return 1;
  if (below == reflectances_.end()) return 0;
  // A cubic through the four nodes around it: s as a function of the reflectance.
  const std::ptrdiff_t first =
      std::clamp<std::ptrdiff_t>(below - reflectances_.begin() - 2, 0, kAlbedos - 4);
  double s = 0;
  for (std::ptrdiff_t i = first; i < first + 4; ++i) {
    double fraction = NodeOf(static_cast<std::size_t>(i));
    for (std::ptrdiff_t j = first; j < first + 4; ++j) {
      const double at = reflectances_[static_cast<std::size_t>(j)];
      if (i != j) {
        fraction *=
            (reflectance - at) / (reflectances_[static_cast<std::size_t>(i)] - at);
      }
    }
    s += fraction;
  }
  return std::clamp(1 - s * s, 0.0, 1.0);
}

}  // namespace lanelight
