#include "src/scene/compile/materials.h"

#include <algorithm>
#include <limits>

#include "src/base/core/error.h"
#include "src/base/image/wavelengths.h"

namespace lanelight {
namespace {

std::size_t Numbers(const MeasuredTensor& t) {
  return static_cast<std::size_t>(t.width) * static_cast<std::size_t>(t.height);
}

// Returns the integral of a slice over cells of size 1.
double Integral(const MeasuredTensor& t, std::size_t slice) {
  double sum = 0;
  for (int y = 0; y < t.height; ++y) {
    for (int x = 0; x < t.width; ++x) {
      const double wx = x == 0 || x == t.width - 1 ? 0.5 : 1;
      const double wy = y == 0 || y == t.height - 1 ? 0.5 : 1;
      const auto at = static_cast<std::size_t>(y * t.width + x);
      sum += wx * wy * t.values[slice * Numbers(t) + at];
    }
  }
  return sum;
}

class MeasuredBuilder {
 public:
  explicit MeasuredBuilder(MeasuredTable& table) : table_(table) {}

  void Add(const MeasuredReflectance& m, Transport transport) {
    MeasuredRecord record = {};
    record.phis = m.isotropic() ? 1 : static_cast<std::int32_t>(m.phi.size());
    record.thetas = static_cast<std::int32_t>(m.theta.size());
    record.phi_at = Nodes(m.phi);
    record.theta_at = Nodes(m.theta);
    record.is_anisotropic = m.isotropic() ? 0 : 1;
    record.parts = m.parts();
    record.ndf = Grid(m.ndf, 1);
    record.sigma = Grid(m.sigma, 1);
    const auto slices = static_cast<std::size_t>(record.phis * record.thetas);
    record.vndf = Warp(m.vndf, slices);
    record.luminance = Warp(m.luminance, slices);
    if (transport == Transport::kSpectral) {
      AddSpectra(ReadMeasuredSpectra(m), slices, record);
    } else {
      record.reflectance = Grid(m.reflectance, 3 * slices);
    }
    table_.records.push_back(record);
    table_.any_anisotropic |= !m.isotropic();
  }

 private:
  std::int32_t Here() const { return static_cast<std::int32_t>(table_.values.size()); }
  void Push(double v) { table_.values.push_back(static_cast<float>(v)); }
  std::int32_t Nodes(const std::vector<double>& nodes) {
    const std::int32_t at = Here();
    for (const double node : nodes) Push(node);
    return at;
  }
  MeasuredGrid Grid(const MeasuredTensor& t, std::size_t slices) {
    const MeasuredGrid grid = {Here(), t.width, t.height};
    const auto count = static_cast<std::ptrdiff_t>(slices * Numbers(t));
    table_.values.insert(table_.values.end(), t.values.begin(), t.values.begin() + count);
    return grid;
  }
  MeasuredWarp Warp(const MeasuredTensor& t, std::size_t slices);
  void AddSpectra(const MeasuredSpectra& spectra, std::size_t slices,
                  MeasuredRecord& record);

  MeasuredTable& table_;
};

MeasuredWarp MeasuredBuilder::Warp(const MeasuredTensor& t, std::size_t slices) {
  MeasuredWarp warp = {{Here(), t.width, t.height}, 0, 0};
  std::vector<double> scales;
  for (std::size_t s = 0; s < slices; ++s) {
    scales.push_back(1 / Integral(t, s));
    for (std::size_t i = 0; i < Numbers(t); ++i) {
      Push(t.values[s * Numbers(t) + i] * scales[s]);
    }
  }
  warp.along = Here();
  std::vector<double> totals;  // of rows
  for (std::size_t s = 0; s < slices; ++s) {
    const float* v = t.values.data() + s * Numbers(t);
    for (int y = 0; y < t.height; ++y) {
      double sum = 0;
      for (int x = 0; x < t.width; ++x, ++v) {
        if (x > 0) sum += 0.5 * (double{v[-1]} + v[0]) * scales[s];
        Push(sum);
      }
      totals.push_back(sum);
    }
  }
  warp.before = Here();
  for (std::size_t row = 0; row < totals.size();) {
    double sum = 0;
    for (int y = 0; y < t.height; ++y, ++row) {
      if (y > 0) sum += 0.5 * (totals[row - 1] + totals[row]);
      Push(sum);
    }
  }
  return warp;
}

// Returns the position of a wavelength among increasing ones: 1.5 is halfway between the
// second and the third. Positions are clamped to the ends.
double PositionOf(const std::vector<double>& nodes, double nm) {
  const auto after = std::upper_bound(nodes.begin(), nodes.end(), nm);
  if (after == nodes.begin()) return 0;
  if (after == nodes.end()) return static_cast<double>(nodes.size() - 1);
  const double before = static_cast<double>(after - nodes.begin() - 1);
  return before + (nm - after[-1]) / (after[0] - after[-1]);
}

void MeasuredBuilder::AddSpectra(const MeasuredSpectra& spectra, std::size_t slices,
                                 MeasuredRecord& record) {
  record.wavelengths = static_cast<std::int32_t>(spectra.nm.size());
  record.bins = Here();
  for (const double nm : CarriedWavelengths().centre) Push(PositionOf(spectra.nm, nm));
  record.reflectance = Grid(spectra.reflectance, spectra.nm.size() * slices);
}

}  // namespace

Rgb HeadOnAlbedo(const MeasuredReflectance& measured) {
  const MeasuredTensor& t = measured.reflectance;
  const double cells = (t.width - 1.0) * (t.height - 1.0);
  return Rgb{Integral(t, 0), Integral(t, 1), Integral(t, 2)} / cells;
}

void AddMeasured(const std::vector<MaterialRow>& rows, MeasuredTable& table,
                 Transport transport) {
  std::map<const MeasuredReflectance*, std::int32_t> known;
  MeasuredBuilder builder(table);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].measured == nullptr) continue;
    const auto next = static_cast<std::int32_t>(table.records.size());
    const auto [at, added] = known.try_emplace(rows[i].measured.get(), next);
    if (added) {
      builder.Add(*rows[i].measured, transport);
      if (table.values.size() > std::numeric_limits<std::int32_t>::max()) {
        throw InputError(SourceLocation{},
                         "measured materials of more than 2^31 numbers");
      }
    }
    table.of_material.resize(rows.size(), -1);
    table.of_material[i] = at->second;
  }
}

}  // namespace lanelight
