// Checks the result of reading any bytes as a file of measured reflectance.
#pragma once

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "src/base/core/error.h"
#include "src/base/image/measured_reflectance.h"

namespace lanelight {

/// Reads the bytes. InputError that names the file is the only exception that may arise,
/// and is swallowed here; what has been read holds together. True if it was accepted.
inline bool FuzzMeasuredFile(const std::string& bytes) {
  const auto demand = [](bool holds, const char* what) {
    if (!holds) throw std::logic_error(what);
  };
  try {
    std::istringstream file(bytes);
    const auto m = ReadMeasuredReflectance(file, "fuzz.bsdf");
    const std::size_t slices = m->phi.size() * m->theta.size();
    const auto check = [&](const MeasuredTensor& t, std::size_t count) {
      demand(t.width >= 2 && t.height >= 2, "a tensor without cells");
      const auto w = static_cast<std::size_t>(t.width);
      demand(t.values.size() == count * w * static_cast<std::size_t>(t.height),
             "a tensor of another size");
      for (const float v : t.values) demand(v >= 0 && std::isfinite(v), "a number");
    };
    check(m->ndf, 1), check(m->sigma, 1);
    check(m->vndf, slices), check(m->luminance, slices);
    check(m->reflectance, 3 * slices);
    demand(m->parts() == 1 || m->parts() == 2 || m->parts() == 4, "parts");
  } catch (const InputError& error) {
    if (std::string_view(error.what()).find("\"fuzz.bsdf\"") != std::string_view::npos) {
      return false;
    }
    throw std::logic_error(std::string("does not name the file: ") + error.what());
  }
  return true;
}

}  // namespace lanelight
