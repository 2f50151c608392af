// A setting: what a flag, a key of a sweep's file, a line of a report and a part of a
// render's identity have in common. Each is declared once (setting_list.cc).
#pragma once

#include <fmt/ranges.h>

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "src/base/core/value_types.h"
#include "src/render/job/settings.h"

namespace lanelight {

struct Job;

/// Form of a value in TOML or JSON. A size is a text in TOML, and two integers in JSON; a
/// window is four integers.
enum class ValueForm { kFlag, kInteger, kNumber, kText, kSize, kWindow };

/// The uses of a setting.
enum SettingUse : unsigned {
  kSceneFlag = 1u << 0,      // commands that read one scene have a flag for it
  kAmountFlag = 1u << 1,     // `render` has: how much
  kImageFlag = 1u << 2,      // commands that write images have
  kStudyFlag = 1u << 3,      // `study` has
  kSweepKey = 1u << 4,       // a sweep's file may have it among its settings
  kIdentity = 1u << 5,       // other pixels come of it (src/render/job/identity.h)
  kStudyIdentity = 1u << 6,  // what a study has measured depends on it
  kReported = 1u << 7,       // reports have it
};

/// Name and explanation of a setting.
struct SettingText {
  const char* name;  // of the flag without its dashes, and of the key in TOML
  /// Type of the value in help texts; empty: that of a flag, or the names to choose from.
  std::string type = "";
  std::string meaning = "";  // what it does
  /// The default in help texts, if RenderSettings do not have it.
  std::string otherwise = "";
  const char* key = "";  // in JSON, unless it is the name with other dashes
  /// Another setting that this one sets in another form: only one of the two may be
  /// given, and only the other one is reported.
  const char* writes = "";
};

struct Setting : SettingText {
  ValueForm form = ValueForm::kText;
  unsigned uses = 0;
  /// Reads a text. Throws InputError, without a place, for an invalid one.
  std::function<void(RenderSettings&, const std::string&)> read;
  /// Returns the text of the value; none if it is not set.
  std::function<std::optional<std::string>(const RenderSettings&)> text;

  bool Is(unsigned use) const { return (uses & use) != 0; }
  /// Returns whether it differs from the default.
  bool IsSet(const RenderSettings& s) const { return text(s) != text({}); }
};

template <class T>
ValueForm FormOf(const NumberType<T>&) {
  return std::is_integral_v<T> ? ValueForm::kInteger : ValueForm::kNumber;
}
inline ValueForm FormOf(const FlagType&) { return ValueForm::kFlag; }
inline ValueForm FormOf(const SizeType&) { return ValueForm::kSize; }
inline ValueForm FormOf(const WindowType&) { return ValueForm::kWindow; }
inline ValueForm FormOf(const CountType&) { return ValueForm::kInteger; }
inline ValueForm FormOf(const SecondsType&) { return ValueForm::kNumber; }
template <class Type>
ValueForm FormOf(const Type&) {
  return ValueForm::kText;
}

/// A setting kept in `member` of the others: a pointer to a member, or a function that
/// returns a reference to one.
template <class Type, class Member>
Setting Declare(SettingText about, const Type& type, Member member, unsigned uses) {
  Setting setting = {std::move(about), FormOf(type), uses, {}, {}};
  if constexpr (requires { type.names; }) {
    if (setting.type.empty())
      setting.type = fmt::format("{}", fmt::join(type.Names(), "|"));
  }
  setting.read = [=](RenderSettings& settings, const std::string& text) {
    std::invoke(member, settings) = ReadValue(type, text);
  };
  setting.text = [=](const RenderSettings& settings) -> std::optional<std::string> {
    const auto& value = std::invoke(member, settings);
    if constexpr (requires { value.has_value(); }) {
      if (!value) return std::nullopt;
      return type.Write(*value);
    } else {
      return type.Write(value);
    }
  };
  return setting;
}

/// Calls read(), and adds place and name of the text to its InputErrors.
template <class Read>
auto ReadAt(const SourceLocation& where, const std::string& name, Read&& read) {
  try {
    return read();
  } catch (const InputError& error) {
    throw InputError(where, name + " " + error.message());
  }
}

/// Returns all settings: a new one is a line of setting_list.cc and the place that uses
/// it.
const std::vector<Setting>& SettingList();
/// Returns the setting of that name, which must exist.
const Setting& SettingNamed(const std::string& name);

/// Returns the name of the setting that sets this one in another form; empty: none.
std::string WrittenBy(const Setting& setting);

/// Returns the settings asked for, completed by what scene and program have decided.
RenderSettings SettingsInForce(const Job& job);
/// Returns the settings of that use with their values, by key; null: none.
nlohmann::json SettingsJson(const RenderSettings& settings, SettingUse use);

NamesType<Scattering> ScatteringNames();
/// One of these SIMD targets, in letters of either case.
struct TargetType : NamesType<std::string> {
  explicit TargetType(const std::vector<std::string>& targets);
  std::optional<std::string> Read(const std::string& text) const;
  std::string Right(const std::string& text) const;
};

}  // namespace lanelight
