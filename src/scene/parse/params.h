// Parameter lists: "type name" value. Read once into Params; an interpreter then reads
// its parameters from a ParamSet. A parameter that it does not read is an error that
// lists those that it reads: the code that uses parameters is the only list of legal
// ones.
#pragma once

#include <fmt/core.h>

#include <initializer_list>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "src/scene/description/description.h"
#include "src/scene/parse/lex.h"

namespace lanelight {

enum class ParamType {
  kBool,
  kInteger,
  kFloat,
  kPoint2,
  kVector2,
  kPoint3,
  kVector3,
  kNormal,
  kSpectrum,
  kRgb,
  kBlackbody,
  kString,
  kTexture
};

/// Types of colours that may be textured.
inline constexpr std::initializer_list<ParamType> kColorTypes = {
    ParamType::kRgb, ParamType::kSpectrum, ParamType::kTexture, ParamType::kBlackbody};

/// Returns the name of a type in a scene file, e.g. "point3".
const char* ParamTypeName(ParamType type);

struct Param {
  ParamType type = ParamType::kFloat;
  std::string name;
  SourceLocation where;
  std::string color_space;  // in force where the parameter stands
  // One of these holds the values: complete tuples, integers in the range of int, finite.
  std::vector<double> numbers;
  std::vector<std::string> strings;
  std::vector<bool> bools;
};
using ParamList = std::vector<Param>;

/// Returns the numbers of a parameter in groups of three.
std::vector<Vec3d> Triples(const Param& param);

/// Limit of parameters that have no natural one.
inline constexpr double kHuge = 1e30;

/// The range of a number, ends included.
struct Limits {
  double low = -kHuge, high = kHuge;
};
inline constexpr Limits kNotNegative = {0, kHuge};
inline constexpr Limits kAnyNumber = {-std::numeric_limits<double>::max(),
                                      std::numeric_limits<double>::max()};

/// Reads parameters up to the first token that starts none. Of several with the same type
/// and name the last one counts, with a warning among `notes`. Throws InputError for an
/// unknown type, values that do not fit it, an incomplete tuple, a name with two types.
ParamList ReadParams(Lexer& lexer, const std::string& color_space,
                     std::vector<Note>* notes);

/// The parameters of one object and the defaults that Attribute directives give it.
class ParamSet {
 public:
  /// `object` names it in messages, e.g. `shape "disk"`. `inherited` may be null.
  ParamSet(std::string object, SourceLocation where, ParamList own,
           std::shared_ptr<const ParamList> inherited, std::vector<Note>* notes);

  const std::string& object() const { return object_; }
  const SourceLocation& where() const { return where_; }

  /// Returns the parameter, or null; a type not in `types` is an InputError. `types`
  /// empty: any.
  const Param* Find(std::string_view name, std::initializer_list<ParamType> types);
  bool Has(std::string_view name) { return Find(name, {}) != nullptr; }
  /// Returns a required parameter; InputError `<object> has no "type name"` without it.
  const Param& Need(std::string_view name, ParamType type);

  /// Single values. Out of the limits is an InputError that states them.
  double Float(std::string_view name, double absent, Limits limits = kAnyNumber);
  int Integer(std::string_view name, int absent, Limits limits);
  bool Bool(std::string_view name, bool absent);
  std::string String(std::string_view name, const std::string& absent);
  Vec3d Point3(std::string_view name, Vec3d absent);

  /// Returns the meaning of a string out of `choices`; the first is the default. Others
  /// are an InputError, or a warning if pbrt-v4 accepts them: then `unknown` is returned.
  template <typename T>
  T Choice(std::string_view name,
           std::initializer_list<std::pair<const char*, T>> choices,
           const char* unknown = nullptr) {
    std::vector<std::string> names;
    for (const auto& choice : choices) names.emplace_back(choice.first);
    return choices.begin()[ChoiceOf(name, names, unknown)].second;
  }

  /// Accepts the parameter whatever its type, and notes that it has no effect and why.
  /// `changes_image`: the image is then visibly not what the file asks for; "false" asks
  /// for nothing and is not noted.
  void Ignore(std::string_view name, const std::string& why, bool changes_image = false);

  /// Throws InputError for an own parameter that was not read. Call it last.
  void CheckAllUsed();

  /// Throws InputError at a parameter: `<message>, in "type name" of <object>`. With
  /// further arguments, the message is a format string for them.
  [[noreturn]] void Fail(const Param& param, const std::string& message) const;
  template <class... Args>
    requires(sizeof...(Args) > 0)
  [[noreturn]] void Fail(const Param& param, fmt::format_string<Args...> format,
                         Args&&... args) const {
    Fail(param, fmt::format(format, std::forward<Args>(args)...));
  }
  /// Adds the same as a warning, where pbrt-v4 goes on.
  void Warn(const Param& param, const std::string& message) const;

 private:
  std::string ParameterMessage(const Param& param, const std::string& message) const;
  const Param* FindSingle(std::string_view name, ParamType type);
  void CheckLimits(const Param& param, Limits limits) const;
  // The position of a string in `choices`; 0 if it is not given.
  std::size_t ChoiceOf(std::string_view name, const std::vector<std::string>& choices,
                       const char* unknown);

  std::string object_;
  SourceLocation where_;
  ParamList own_;
  std::vector<bool> used_;
  std::shared_ptr<const ParamList> inherited_;
  std::vector<Note>* notes_;
  std::vector<std::string> legal_;        // names
  std::vector<std::string> legal_typed_;  // "type name"
};

}  // namespace lanelight
