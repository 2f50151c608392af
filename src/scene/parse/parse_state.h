// State of the parser: the scene so far, pbrt's graphics state, and the names that have
// been defined. Directives (directives.cc) change it; interpreters (interpret.h) turn
// parameters into the objects of a SceneDescription.
#pragma once

#include <array>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "src/scene/parse/forward.h"
#include "src/scene/parse/names.h"
#include "src/scene/parse/params.h"
#include "src/scene/parse/parse.h"

namespace lanelight {

/// Kinds of objects for which an Attribute directive sets defaults.
enum class AttributeTarget { kShape, kLight, kMaterial, kMedium, kTexture };
inline constexpr int kAttributeTargets = 5;

/// The state that AttributeBegin saves and AttributeEnd restores.
struct GraphicsState {
  Transform ctm, ctm_end;  // at the two times of TransformTimes
  bool start_active = true, end_active = true;
  bool reverse_orientation = false;
  Index material = kNone;  // kNone: later_material, or the default diffuse without one
  std::shared_ptr<const NameUse> later_material;  // not yet defined; or null
  Index area_light = kNone;
  MediumInterface media;
  std::string color_space = "srgb";
  std::array<std::shared_ptr<const ParamList>, kAttributeTargets> attributes;

  bool Moves() const { return ctm != ctm_end; }
};

enum class ScopeKind { kAttribute, kObject, kImport };
/// Returns the directive that begins a scope.
inline const char* BeginName(ScopeKind kind) {
  constexpr const char* kNames[] = {"AttributeBegin", "ObjectBegin", "Import"};
  return kNames[static_cast<int>(kind)];
}
struct Scope {
  ScopeKind kind;
  SourceLocation where;
  GraphicsState saved;
};

/// A mesh file to be read after the text, for shapes[shape] of the scene or of an object
/// definition.
struct MeshRequest {
  std::string path;
  SourceLocation where;
  Index object = kNone;
  std::size_t shape = 0;
  Index displacement = kNone;        // a float texture
  double edge_length = 1;            // of displaced triangles at most, in the world
  Transform world_from_object = {};  // to measure them
};

/// A scene file that has been read. Small ones stay in memory for repeated includes.
struct SourceFile {
  std::string identity;  // canonical path, to detect cycles; empty for text
  std::string directory;
  std::shared_ptr<const std::string> name;
  std::string text;
};
using SourceFilePtr = std::shared_ptr<const SourceFile>;

/// A statement that uses a name without definition, and the state it was read in.
struct WaitingStatement {
  std::size_t place;  // in the order of the file
  std::function<void(ParseState&)> run;
  NameUse needs;
  std::optional<NameKey> defines;
  GraphicsState graphics;
  Index open_object;
  SourceFilePtr file;
};

struct ParseState {
  ParseOptions options;
  SceneDescription scene;
  GraphicsState graphics;
  bool in_world = false;
  std::vector<Scope> scopes;
  Index open_object = kNone;  // between ObjectBegin and ObjectEnd
  std::vector<SourceFilePtr> open_files;
  std::map<std::string, SourceFilePtr> kept_files;  // by path
  std::size_t bytes_kept = 0, bytes_run = 0;

  std::map<std::string, std::pair<Transform, Transform>> coordinate_systems;  // ctm, end
  std::map<NameKey, Index> names;  // materials and textures that are defined
  NameSlots media, objects;
  std::set<NameKey> declared;                           // defined, or waiting for others
  std::map<std::size_t, WaitingStatement> waiting;      // by place
  std::map<NameKey, std::vector<std::size_t>> waiters;  // places in `waiting`
  std::deque<std::size_t> ready;                        // the same, to be run
  std::size_t statements_waited = 0;
  std::map<std::string, std::shared_ptr<const MeasuredReflectance>> measured;  // by path
  Index default_material = kNone;  // pbrt's grey diffuse, once a shape needs it
  std::vector<MeshRequest> meshes;
  // Shapes that move in object definitions, by object: objects of their own, in its
  // coordinates.
  std::map<Index, std::vector<Instance>> moving_shapes;
  double start_time = 0, end_time = 1;         // TransformTimes
  double shutter_open = 0, shutter_close = 1;  // of the camera
  double iso = 100;                            // of the film
  double edge_scale = 1;                       // Option "displacementedgescale"
  bool unfiltered_images = false;              // Option "disabletexturefiltering"
  bool force_diffuse = false;                  // Option "forcediffuse"
  bool pixel_centers = false;                  // Option "disablepixeljitter"
  std::set<std::string> noted;

  /// Adds a note; with further arguments, the message is a format string for them.
  void AddNote(const SourceLocation& where, const std::string& message) {
    scene.notes.push_back({where, message});
  }
  template <class... Args>
    requires(sizeof...(Args) > 0)
  void AddNote(const SourceLocation& where, fmt::format_string<Args...> format,
               Args&&... args) {
    AddNote(where, fmt::format(format, std::forward<Args>(args)...));
  }
  /// Adds a warning: the file has a mistake, which pbrt-v4 accepts too.
  template <class... Args>
  void AddWarning(const SourceLocation& where, fmt::format_string<Args...> format,
                  Args&&... args) {
    scene.notes.push_back(
        {where, fmt::format(format, std::forward<Args>(args)...), false, true});
  }
  /// Adds a note after which the image is visibly not what the file asks for.
  void AddImageNote(const SourceLocation& where, const std::string& message) {
    scene.notes.push_back({where, message, true});
  }
  /// Adds the note unless the same message was noted before.
  void AddNoteOnce(const SourceLocation& where, const std::string& message) {
    if (noted.insert(message).second) AddNote(where, message);
  }
  /// Adds a note with skip_unsupported, else throws InputError.
  void Unsupported(const SourceLocation& where, const std::string& message);

  const std::shared_ptr<const ParamList>& Inherited(AttributeTarget target) const {
    return graphics.attributes[static_cast<int>(target)];
  }
  std::vector<Shape>& OpenShapes() {
    return open_object == kNone ? scene.shapes : scene.objects[open_object].shapes;
  }
};

/// Appends a value and returns its index.
template <typename T>
Index Append(std::vector<T>& values, T value) {
  values.push_back(std::move(value));
  return static_cast<Index>(values.size()) - 1;
}

/// Returns the path of a file named in the scene: relative to the main file's directory
/// (as pbrt), or if there is none there, relative to the directory of the file that names
/// it. Adds it to ParseOptions::files.
std::string ResolvePath(const ParseState& state, const std::string& name);

/// Returns the whole content of a regular file, unpacked if it is compressed (gzip).
/// InputError at `where` if it cannot be read or the options forbid access to files.
std::string ReadSceneFile(const ParseState& state, const std::string& path,
                          const SourceLocation& where, std::string_view kind);

/// Returns the numbers of such a file (ReadNumbers).
std::vector<double> ReadNumberFile(const ParseState& state, const std::string& path,
                                   const SourceLocation& where, std::string_view kind);

/// The same without options, for callers outside the parser.
std::string ReadWholeFile(const std::string& path, const SourceLocation& where,
                          std::string_view kind);

/// Runs all directives of the open file on top of `state.open_files`.
void RunDirectives(ParseState& state);

/// Include: the same for a file; checks cycles, depth and the bytes of all files.
void RunFile(ParseState& state, const std::string& path, const SourceLocation& where);

}  // namespace lanelight
