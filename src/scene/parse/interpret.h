// Parameters to objects of the scene description, one file per concept. Each function
// takes the type name and a ParamSet, checks ranges, and ends with CheckAllUsed(), which
// reports unknown parameters.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "src/base/core/error.h"
#include "src/base/core/vec.h"
#include "src/base/image/spectrum.h"
#include "src/scene/parse/params.h"
#include "src/scene/parse/parse_state.h"

namespace lanelight {

// interpret_color.cc ----------------------------------------------------------------
/// Linear sRGB of an rgb, spectrum or blackbody parameter. Colours outside sRGB's gamut
/// are clamped to non-negative, with a note.
Rgb ColorOf(ParseState& state, const ParamSet& params, const Param& param,
            SpectrumUse use);
/// Spectrum of a parameter that ColorOf has accepted; null for an rgb. Outside of their
/// samples, unbounded spectra keep their end values.
OwnSpectrum SpectrumOf(const ParseState& state, const ParamSet& params,
                       const Param& param, SpectrumUse use);
/// A colour without texture.
Rgb PlainColor(ParseState& state, ParamSet& params, std::string_view name, Rgb absent,
               SpectrumUse use);
/// A colour or the index of a spectrum texture.
ColorValue TexturedColor(ParseState& state, ParamSet& params, std::string_view name,
                         Rgb absent, SpectrumUse use);
/// A number within the limits, or the index of a float texture.
FloatValue TexturedFloat(ParseState& state, ParamSet& params, std::string_view name,
                         double absent, Limits limits = {});

// interpret_spectrum.cc -------------------------------------------------------------
/// (wavelength in nm, value) samples of a spectrum parameter with numbers or of the .spd
/// file that it names. Wavelengths increase, values are not negative.
struct SpectrumSamples {
  std::vector<double> wavelengths, values;
};
SpectrumSamples SamplesOf(const ParseState& state, const ParamSet& params,
                          const Param& param);
/// Index of refraction of a dielectric as one number: float, or any other spectrum at
/// 587.6 nm. `dispersion` becomes that spectrum; null: the material has one
/// index for all wavelengths, which is noted.
double DielectricEta(ParseState& state, ParamSet& params, std::string_view name,
                     double absent, OwnSpectrum* dispersion = nullptr);
/// Index of refraction of a conductor, `<prefix>eta` and `<prefix>k`; copper by default.
void ConductorIor(ParseState& state, ParamSet& params, const std::string& prefix,
                  ColorValue* eta, ColorValue* k);

// parse_files.cc --------------------------------------------------------------------
/// A file named by a string parameter.
struct NamedFile {
  const Param* param = nullptr;  // null: it is not given
  std::string path;

  explicit operator bool() const { return param != nullptr; }
};
/// Returns the file; an empty name is an InputError.
NamedFile FileOf(const ParseState& state, ParamSet& params, std::string_view name);
/// Returns a file that must be given, or throws InputError.
NamedFile RequireFile(const ParseState& state, ParamSet& params, std::string_view name);

// interpret_subsurface.cc -----------------------------------------------------------
/// Appends the medium in a material "subsurface" of index `eta`; returns its index.
Index InterpretInside(ParseState& state, ParamSet& params, double eta);

// One per concept -------------------------------------------------------------------
void InterpretCamera(ParseState& state, const std::string& type, ParamSet& params);
void InterpretFilm(ParseState& state, const std::string& type, ParamSet& params);
void InterpretFilter(ParseState& state, const std::string& type, ParamSet& params);
void InterpretSampler(ParseState& state, const std::string& type, ParamSet& params);
void InterpretIntegrator(ParseState& state, const std::string& type, ParamSet& params);
void InterpretAccelerator(const std::string& type, ParamSet& params);

/// Appends the material and returns its index.
Index InterpretMaterial(ParseState& state, const std::string& name,
                        const std::string& type, ParamSet& params);
/// Appends the texture and defines its name.
void InterpretTexture(ParseState& state, const NameKey& key, const std::string& type,
                      ParamSet& params);
/// Appends the medium `name`.
void InterpretMedium(ParseState& state, const std::string& name, ParamSet& params);
void InterpretLight(ParseState& state, const std::string& type, ParamSet& params);
/// Appends the area light and returns its index.
Index InterpretAreaLight(ParseState& state, const std::string& type, ParamSet& params);
/// Appends the shape to the scene or the open object definition.
void InterpretShape(ParseState& state, const std::string& type, ParamSet& params);

// interpret_curve.cc ----------------------------------------------------------------
/// The parts of a shape "curve"; none if they cannot be seen, which is noted.
std::vector<Curve> InterpretCurve(ParseState& state, ParamSet& params);

// interpret_mesh.cc -----------------------------------------------------------------
std::shared_ptr<const TriangleMesh> InterpretTriangleMesh(ParamSet& params);
std::shared_ptr<const TriangleMesh> InterpretBilinearMesh(ParamSet& params);
std::shared_ptr<const TriangleMesh> InterpretLoopSubdivision(ParamSet& params);

// scattering_presets.cc -------------------------------------------------------------
struct Coefficients {
  Rgb sigma_s, sigma_a;  // per millimetre; sigma_s is the reduced one
};
/// Returns published coefficients of media by their names in pbrt-v4.
const std::map<std::string, Coefficients>& ScatteringPresets();

// medium_grids.cc -------------------------------------------------------------------
void ReadUniformGrid(ParseState& state, ParamSet& params, Medium* medium);
void ReadRgbGrid(ParseState& state, ParamSet& params, Medium* medium);
/// Reads "p0" and "p1"; every coordinate of p1 must be above that of p0.
void ReadBox(ParamSet& params, Medium* medium);
/// Reads "sigma_a" and "sigma_s", 1 by default, and multiplies them by `scale`.
void ReadSigmas(ParseState& state, ParamSet& params, double scale, Medium* medium);
/// Reads "Le", black by default, and multiplies it by `scale`.
void ReadEmission(ParseState& state, ParamSet& params, double scale, Medium* medium);
/// Reads "temperatureoffset", or its older name "temperaturecutoff", and
/// "temperaturescale".
void ReadTemperatureScale(ParamSet& params, Medium* medium);

}  // namespace lanelight
