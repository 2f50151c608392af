// Constants of spectra shared by kernels and the code that makes their tables.
#pragma once

namespace lanelight {

inline constexpr int kFirstNm = 360, kLastNm = 830;  // as pbrt; steps of 1 nm

/// Bins of wavelengths (src/base/image/wavelengths.h).
inline constexpr int kTriples = 128, kWavelengthBins = 3 * kTriples;
inline constexpr int kWavelengthEdges = kWavelengthBins + 1;
/// The range that paths carry, nm. Beyond it lie 3e-4 of what the eye sees of D65.
inline constexpr int kFirstCarriedNm = 380, kLastCarriedNm = 780;

/// Nodes per axis of UpsamplingTable, and how far its colours keep from 0 and 1
/// (src/base/image/upsampling.h).
inline constexpr int kUpsamplingNodes = 17;
inline constexpr double kMinUpsampled = 2e-4;

/// Nodes per axis of the tables of CoatFits (src/scene/compile/coat.h).
inline constexpr int kCoatFitNodes = 9;

/// Of a black body, in nm kelvin: h c / k; and that over the product of the temperature
/// and the wavelength of its maximum, by Wien's law.
inline constexpr double kSecondRadiation = 1.438776877e7;
inline constexpr double kPlanckPeak = 4.965114231744276;
inline constexpr double kPlanckAtPeak = 142.32492159405578;  // exp(kPlanckPeak) - 1

}  // namespace lanelight
