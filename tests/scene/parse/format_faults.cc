#include "tests/scene/parse/format_faults.h"

#include <algorithm>
#include <cctype>
#include <regex>
#include <set>

#include "tests/scene/parse/format_values.h"

namespace lanelight {
namespace {

bool Mentions(const std::string& text, const std::string& words) {
  return !words.empty() && text.find(words) != text.npos;
}

// As a word of its own; "" is none.
bool MentionsWord(const std::string& text, const std::string& word) {
  const auto part = [](char c) { return std::isalnum(c) || c == '_'; };
  for (std::size_t at = text.find(word); !word.empty() && at != text.npos;
       at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    const bool starts = at == 0 || !part(text[at - 1]);
    if (starts && (end == text.size() || !part(text[end]))) return true;
  }
  return false;
}

// The message of an error, without its place.
std::string Message(const std::string& error) {
  return error.substr(error.find("error: ") + 7);
}

// Of "interface.uroughness": "roughness", as errors about the compiled material call it.
std::string Stem(const std::string& name) {
  const std::string last = name.substr(name.find_last_of('.') + 1);
  return last.ends_with("roughness") ? "roughness" : last;
}

// A note about a parameter says its name or its value; one about an object its type.
bool Names(const std::string& text, const FormatObject& object, const std::string& name,
           const std::string& value) {
  const std::string& type = object.type;
  if (MentionsWord(text, name) || MentionsWord(text, Stem(name))) return true;
  if (value.starts_with('"') && Mentions(text, value)) return true;
  const bool has_parameter = !name.empty() && object.directive != "Option";
  if (!type.empty() && has_parameter) return false;
  return Mentions(text, type.empty() ? object.directive : "\"" + type + "\"");
}

// An error may name the object instead: without the parameter there is none.
bool ErrorNames(const std::string& error, const FormatObject& object,
                const std::string& name, const std::string& value) {
  return Names(Message(error), object, name, value) ||
         Names(Message(error), object, "", "") ||
         Mentions(Message(error), object.directive);
}

std::string Shown(const FormatOutcome& outcome) {
  std::string text = outcome.error;
  for (const std::string& note : outcome.notes) text += "\nnote: " + note;
  return text.empty() ? "accepted without a word" : text;
}

struct Line {
  const FormatObject& object;
  std::string name, value;
};

// What the outcome is, as a line would say it; notes that are there anyway do not count.
// kRendered stands for an outcome that fits nothing too: an error about something else.
FormatStatus StatusOf(const FormatOutcome& outcome, const FormatOutcome& plain,
                      const Line& line, bool* fits) {
  *fits = true;
  if (!outcome.error.empty()) {
    *fits = ErrorNames(outcome.error, line.object, line.name, line.value);
    return FormatStatus::kRefused;
  }
  std::vector<std::string> added;
  std::set_difference(outcome.notes.begin(), outcome.notes.end(), plain.notes.begin(),
                      plain.notes.end(), std::back_inserter(added));
  if (added.empty()) return FormatStatus::kRendered;
  *fits = std::any_of(added.begin(), added.end(), [&](const std::string& note) {
    return Names(note, line.object, line.name, line.value);
  });
  return FormatStatus::kNoted;
}

// The best of what becomes of it as a texture of either value type; else there is one.
std::vector<std::string> ValueTypes(const FormatObject& object) {
  if (object.directive == "Texture") return {"spectrum", "float"};
  return {""};
}

FormatOutcome RunPlain(const FormatObject& object, const std::string& value_type,
                       const std::string& folder) {
  return RunFormatScene(FormatScene(object, {}, "", value_type), folder);
}

// One that the object has: some textures have numbers only, or colours only.
std::string ValueTypeOf(const FormatObject& object, const std::string& folder) {
  for (const std::string& type : ValueTypes(object)) {
    if (RunPlain(object, type, folder).error.empty()) return type;
  }
  return ValueTypes(object).back();
}

std::string UnknownParameter() { return fmt::format(" \"float {}\" 1", kUnknown); }

}  // namespace

std::vector<std::string> Supported(const std::string& error) {
  const std::size_t at = error.find("supported: ");
  std::vector<std::string> names;
  if (at == error.npos) return names;
  const std::regex quoted("\"([^\"]*)\"");
  for (std::sregex_iterator it(error.begin() + static_cast<std::ptrdiff_t>(at),
                               error.end(), quoted);
       it != std::sregex_iterator(); ++it) {
    names.push_back((*it)[1]);
  }
  return names;
}

void FormatFaults::CheckObject(const FormatObject& object) {
  std::string said;
  bool found = false;
  for (const std::string& value_type : ValueTypes(object)) {
    const FormatOutcome outcome = RunPlain(object, value_type, folder_);
    bool fits = false;
    const FormatStatus status = StatusOf(outcome, {}, {object, "", ""}, &fits);
    const bool refused = object.status == FormatStatus::kRefused;
    if (refused && !object.why.empty() && !Mentions(outcome.error, object.why)) {
      Add(object, "", "is refused for another reason: " + outcome.error);
    }
    found = found || (fits && status == object.status);
    said += fmt::format(" is {}: {};", FormatWord(status), Shown(outcome));
  }
  if (!found) Add(object, "", said);
}

void FormatFaults::CheckParameter(const FormatObject& object, const FormatLine& line,
                                  const FormatParameter& parameter) {
  std::string said;
  for (const std::string& value_type : ValueTypes(object)) {
    const FormatOutcome plain = RunPlain(object, value_type, folder_);
    const FormatOutcome outcome =
        RunFormatScene(FormatScene(object, parameter, "", value_type), folder_);
    bool fits = false;
    const FormatStatus status = StatusOf(
        outcome, plain, {object, ParameterName(parameter.typed), parameter.value}, &fits);
    if (fits && status == line.status) return;
    said += fmt::format(" is {}{}: {};", fits ? "" : "no clear ", FormatWord(status),
                        Shown(outcome));
  }
  Add(object, parameter.typed + " " + parameter.value, said);
}

void FormatFaults::CheckOperand(const FormatObject& object, const FormatLine& line) {
  const FormatOutcome outcome = RunFormatScene(OperandScene(object, line), folder_);
  bool fits = false;
  const FormatStatus status =
      StatusOf(outcome, {}, {object, ParameterName(line.parameter), ""}, &fits);
  if (fits && status == line.status) return;
  Add(object, line.parameter,
      fmt::format("is {}: {}", FormatWord(status), Shown(outcome)));
}

void FormatFaults::FindFalse(const FormatTable& table) {
  for (const FormatObject& object : table) {
    if (HasObject(object)) CheckObject(object);
    for (const FormatLine& line : object.lines) {
      if (!HasObject(object)) {
        CheckOperand(object, line);
        continue;
      }
      for (const std::string& typed : TypedParameters(line)) {
        for (const std::string& value : FormatValues(object, line, typed)) {
          CheckParameter(object, line, {typed, value});
        }
      }
    }
  }
}

void FormatFaults::CheckAsked(const FormatObject& object,
                              const FormatParameter& parameter) {
  std::set<std::string> known = {"type"};  // of materials: MakeNamedMaterial has it
  for (const FormatLine& l : object.lines) known.insert(ParameterName(l.parameter));
  for (const std::string& value_type : ValueTypes(object)) {
    const FormatOutcome outcome = RunFormatScene(
        FormatScene(object, parameter, UnknownParameter(), value_type), folder_);
    if (!Mentions(outcome.error, "unknown parameter")) continue;
    for (const std::string& name : Supported(outcome.error)) {
      if (!known.contains(ParameterName(name))) Add(object, name, "is taken");
    }
  }
}

// Called with each of the parameters, because some are asked for only where others are
// given.
void FormatFaults::FindMissing(const FormatTable& table) {
  for (const FormatObject& object : table) {
    if (!HasObject(object) || object.status == FormatStatus::kRefused) continue;
    const FormatOutcome outcome = RunFormatScene(
        FormatScene(object, {}, UnknownParameter(), ValueTypeOf(object, folder_)),
        folder_);
    if (!Mentions(outcome.error, kUnknown)) {
      Add(object, kUnknown, "is no error: " + Shown(outcome));
    }
    CheckAsked(object, {});
    for (const FormatLine& line : object.lines) {
      const std::string typed = TypedParameters(line).front();
      CheckAsked(object, {typed, FormatValues(object, line, typed).front()});
    }
  }
}

void FormatFaults::FindMissingTypes(const FormatTable& table) {
  std::set<std::string> directives, with_types;
  std::set<std::pair<std::string, std::string>> types;
  for (const FormatObject& object : table) {
    directives.insert(object.directive);
    if (HasObject(object)) with_types.insert(object.directive);
    types.emplace(object.directive, object.type);
  }
  for (const std::string& directive : with_types) {
    const FormatObject unknown = {directive, kUnknown, FormatStatus::kRefused, "", {}};
    const FormatOutcome outcome = RunPlain(unknown, "spectrum", folder_);
    for (const std::string& type : Supported(outcome.error)) {
      if (!types.contains({directive, type}) && directive != "MakeNamedMedium") {
        Add({directive, type, {}, "", {}}, "", "is taken");
      }
    }
  }
  const FormatOutcome outcome = RunFormatScene(kUnknown, folder_);
  for (const std::string& directive : Supported(outcome.error)) {
    if (!directives.contains(directive)) Add({directive, "", {}, "", {}}, "", "is taken");
  }
}

}  // namespace lanelight
