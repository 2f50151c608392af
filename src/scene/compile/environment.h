// Environment images as the kernels look them up and sample them.
#pragma once

#include "src/base/image/image.h"
#include "src/scene/compiled/lights.h"
#include "src/scene/compiled/scene.h"
#include "src/scene/description/description.h"

namespace lanelight {

/// Reads the image of an infinite light and compiles it. Throws InputError at the light's
/// place: a missing or unreadable file, an image that is not square, values that are not
/// finite, a transform that is not a rotation (or mirroring) and uniform scale. Negative
/// values count as zero, and go to `notes` unless that is null.
Environment CompileEnvironment(const Light& light, std::vector<Note>* notes);

/// The same for an image in memory. Its table is empty if the image is black.
Environment CompileEnvironment(const Light& light, const Image& image,
                               std::vector<Note>* notes = nullptr);

Rgb MeanRadiance(const Environment& environment);

/// Makes the table by which texels of `environment` are sampled: in proportion to their
/// luminance, or with `compensated` to its excess over the mean. BSDF samples then find
/// the rest (Karlik, Sik, Vevoda, Skrivan and Krivanek 2019, "MIS Compensation:
/// Optimizing Sampling Techniques in Multiple Importance Sampling"). A constant image has
/// no excess and keeps the plain table. The table of a black image is empty.
std::shared_ptr<const EnvironmentTable> MakeEnvironmentTable(
    bool compensated, const Environment& environment);

}  // namespace lanelight
