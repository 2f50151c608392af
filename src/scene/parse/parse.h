// pbrt-v4 text scenes (with Include, Import and PLY meshes) to SceneDescription.
//
// Follows pbrt-v4 in meaning and defaults. Differences: what would change the image and
// is not supported is an InputError (or, with skip_unsupported, a note); what cannot
// change the image, or only by design, is a note in SceneDescription::notes. Extensions:
// Shape "plane", "string scattering" of Material "diffuse".
#pragma once

#include <functional>
#include <set>
#include <string>
#include <string_view>

#include "src/scene/description/description.h"

namespace lanelight {

struct ParseOptions {
  bool skip_unsupported = false;  // media and the like become notes instead of errors
  bool allow_files = true;  // false: Include, Import, meshes and spectra files are errors
  /// If set, gets the path of every file that the scene names to be read: included
  /// scenes, meshes, images, spectra.
  std::set<std::string>* files = nullptr;
};

/// Parses the file and everything it includes; meshes are read in parallel.
/// Throws InputError: place, what was found, what is supported, the nearest known name.
/// Image files are not opened here; their paths are resolved.
SceneDescription ParseScene(const std::string& path, const ParseOptions& options = {});

/// Parses text as if it stood in a file called `name` inside `directory`.
SceneDescription ParseSceneText(std::string_view text, const std::string& name,
                                const std::string& directory,
                                const ParseOptions& options = {});

/// The document, put in when the library is built (CMakeLists.txt).
std::string_view FormatDocument();

}  // namespace lanelight
