// What is wrong with a document of pbrt-v4's format: lines that are not true, and what
// has none.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "src/base/core/error.h"
#include "tests/scene/parse/format_document.h"
#include "tests/scene/parse/format_scenes.h"

namespace lanelight {

/// A name that nothing has.
inline constexpr const char* kUnknown = "lanelightunknown";

/// Returns whether the directive names an object.
inline bool HasObject(const FormatObject& object) { return !object.type.empty(); }

/// The names that an error lists after "supported: ".
std::vector<std::string> Supported(const std::string& error);

/// Collects faults, line by line.
class FormatFaults {
 public:
  explicit FormatFaults(std::string folder) : folder_(std::move(folder)) {}

  const std::vector<std::string>& all() const { return faults_; }

  /// Lines that are not true.
  void FindFalse(const FormatTable& table);
  /// Parameters that the parser takes, and no line has.
  void FindMissing(const FormatTable& table);
  /// Types and directives that it takes.
  void FindMissingTypes(const FormatTable& table);

 private:
  void CheckObject(const FormatObject& object);
  void CheckParameter(const FormatObject& object, const FormatLine& line,
                      const FormatParameter& parameter);
  void CheckOperand(const FormatObject& object, const FormatLine& line);
  void CheckAsked(const FormatObject& object, const FormatParameter& parameter);
  void Add(const FormatObject& object, const std::string& parameter,
           const std::string& what) {
    faults_.push_back(
        fmt::format("{} \"{}\": {}: {}", object.directive, object.type, parameter, what));
  }

  std::string folder_;
  std::vector<std::string> faults_;
};

}  // namespace lanelight
