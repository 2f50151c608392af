// The types of MakeNamedMedium that vary; without "g", which all have.
#pragma once

#include "src/scene/parse/interpret.h"

namespace lanelight {

/// Samples at voxels of a box: medium_grids.cc.
void ReadUniformGrid(ParseState& state, ParamSet& params, Medium* medium);
void ReadRgbGrid(ParseState& state, ParamSet& params, Medium* medium);

/// Made up, or of another file: medium_volumes.cc.
void ReadCloud(ParseState& state, ParamSet& params, Medium* medium);
void ReadNanoVdb(ParseState& state, ParamSet& params, Medium* medium);

/// "p0" and "p1", of which every coordinate must be above that of the other.
void ReadBox(ParamSet& params, Medium* medium);
/// "sigma_a" and "sigma_s", 1 if not given, times `scale`.
void ReadSigmas(ParseState& state, ParamSet& params, double scale, Medium* medium);
/// "Le", black if not given, times `scale`.
void ReadEmission(ParseState& state, ParamSet& params, double scale, Medium* medium);
/// "temperatureoffset", or by its older name "temperaturecutoff", and "temperaturescale".
void ReadTemperatureScale(ParamSet& params, Medium* medium);

}  // namespace lanelight
