// Every line of the table of pbrt-v4's format is what the program does, the program knows
// nothing that the table does not have, and the document is the table.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cctype>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "src/core/error.h"
#include "src/parse/format.h"
#include "tests/image/temporary_folder.h"
#include "tests/parse/format_scenes.h"

namespace lanelight {
namespace {

constexpr const char* kUnknown = "lanelightunknown";

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
  const std::string type = object.type;
  if (MentionsWord(text, name) || MentionsWord(text, Stem(name))) return true;
  if (value.starts_with('"') && Mentions(text, value)) return true;
  const bool has_parameter = !name.empty() && object.directive != std::string("Option");
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

const char* Word(FormatStatus status) {
  constexpr const char* kWords[] = {"kRendered", "kNoted", "kRefused"};
  return kWords[static_cast<int>(status)];
}

// The best of what becomes of it as a texture of either value type; else there is one.
std::vector<std::string> ValueTypes(const FormatObject& object) {
  if (object.directive == std::string("Texture")) return {"spectrum", "float"};
  return {""};
}

// One that the object has: some textures have numbers only, or colours only.
std::string ValueTypeOf(const FormatObject& object, const std::string& folder) {
  for (const std::string& type : ValueTypes(object)) {
    if (RunFormatScene(FormatScene(object, nullptr, "", "", type), folder)
            .error.empty()) {
      return type;
    }
  }
  return ValueTypes(object).back();
}

std::string Title(const FormatObject& object, const std::string& parameter,
                  const std::string& value) {
  return fmt::format("{} \"{}\": {} {}", object.directive, object.type, parameter, value);
}

void CheckParameter(const FormatObject& object, const FormatLine& line,
                    const std::string& parameter, const std::string& folder) {
  std::string said;
  bool found = false;
  for (const std::string& value_type : ValueTypes(object)) {
    const FormatOutcome plain =
        RunFormatScene(FormatScene(object, nullptr, "", "", value_type), folder);
    const FormatOutcome outcome =
        RunFormatScene(FormatScene(object, &line, parameter, "", value_type), folder);
    bool fits = false;
    const FormatStatus status =
        StatusOf(outcome, plain, {object, ParameterName(parameter), line.value}, &fits);
    found = found || (fits && status == line.status);
    said += fmt::format("\n  is {}{}: {}", fits ? "" : "no clear ", Word(status),
                        Shown(outcome));
  }
  INFO("the line of src/parse/format_*.cc on " << Title(object, parameter, line.value)
                                               << "\n  says " << Word(line.status)
                                               << said);
  CHECK(found);
}

void CheckObject(const FormatObject& object, const std::string& folder) {
  bool found = false;
  std::string said;
  for (const std::string& value_type : ValueTypes(object)) {
    const FormatOutcome outcome =
        RunFormatScene(FormatScene(object, nullptr, "", "", value_type), folder);
    bool fits = false;
    const FormatStatus status = StatusOf(outcome, {}, {object, "", ""}, &fits);
    found = found || (fits && status == object.status);
    said += fmt::format("\n  is {}: {}", Word(status), Shown(outcome));
    const std::string why = object.why;
    if (object.status == FormatStatus::kRefused && !why.empty()) {
      CHECK_THAT(outcome.error, Catch::Contains(why));
    }
  }
  INFO("the line of src/parse/format_*.cc on " << Title(object, "", "") << "\n  says "
                                               << Word(object.status) << said);
  CHECK(found);
}

bool HasObject(const FormatObject& object) { return *object.type != '\0'; }

// The names that an error lists after "supported: ".
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

// What the object takes must have a line; called with each of its parameters, because
// some are asked for only where others are given.
void CheckAsked(const FormatObject& object, const FormatLine* line,
                const std::string& folder) {
  const std::string parameter = line == nullptr ? "" : TypedParameters(*line).front();
  const std::string extra = fmt::format(" \"float {}\" 1", kUnknown);
  std::set<std::string> known = {"type"};  // of materials: MakeNamedMaterial has it
  for (const FormatLine& l : object.lines) known.insert(ParameterName(l.parameter));
  for (const std::string& value_type : ValueTypes(object)) {
    const FormatOutcome outcome =
        RunFormatScene(FormatScene(object, line, parameter, extra, value_type), folder);
    if (!Mentions(outcome.error, "unknown parameter")) continue;
    const std::vector<std::string> asked = Supported(outcome.error);
    for (const std::string& name : asked) {
      INFO("src/parse/format_*.cc has no line for a parameter that the parser takes: "
           << Title(object, name, ""));
      CHECK(known.contains(ParameterName(name)));
    }
  }
}

std::string ReadText(const std::string& path) {
  std::ifstream file(std::string(LANELIGHT_SOURCE_DIR) + "/" + path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("every line of the table of pbrt's format is true", "[parse][format]") {
  const TemporaryFolder folder;
  WriteFormatFiles(folder.File(""));
  for (const FormatObject& object : PbrtFormat()) {
    if (HasObject(object)) CheckObject(object, folder.File(""));
    for (const FormatLine& line : object.lines) {
      if (HasObject(object)) {
        for (const std::string& parameter : TypedParameters(line)) {
          CheckParameter(object, line, parameter, folder.File(""));
        }
        continue;
      }
      const FormatOutcome outcome =
          RunFormatScene(OperandScene(object, line), folder.File(""));
      bool fits = false;
      const FormatStatus status =
          StatusOf(outcome, {}, {object, ParameterName(line.parameter), ""}, &fits);
      INFO("the line of src/parse/format_*.cc on "
           << Title(object, line.parameter, line.value) << "\n  says "
           << Word(line.status) << "\n  is " << Word(status) << ": " << Shown(outcome));
      CHECK((status == line.status && fits));
    }
  }
}

TEST_CASE("the table has every parameter that the parser takes", "[parse][format]") {
  const TemporaryFolder folder;
  WriteFormatFiles(folder.File(""));
  int listed = 0;
  for (const FormatObject& object : PbrtFormat()) {
    if (!HasObject(object) || object.status == FormatStatus::kRefused) continue;
    const FormatOutcome outcome = RunFormatScene(
        FormatScene(object, nullptr, "", fmt::format(" \"float {}\" 1", kUnknown),
                    ValueTypeOf(object, folder.File(""))),
        folder.File(""));
    INFO(Title(object, "", "") << Shown(outcome));
    listed += Mentions(outcome.error, kUnknown);
    CHECK(Mentions(outcome.error, kUnknown));  // an unknown parameter is an error
    CheckAsked(object, nullptr, folder.File(""));
    for (const FormatLine& line : object.lines) {
      CheckAsked(object, &line, folder.File(""));
    }
  }
  CHECK(listed > 40);
}

TEST_CASE("the table has every type and directive that the parser takes",
          "[parse][format]") {
  const TemporaryFolder folder;
  std::set<std::string> directives;
  std::set<std::pair<std::string, std::string>> types;
  for (const FormatObject& object : PbrtFormat()) {
    directives.insert(object.directive);
    types.emplace(object.directive, object.type);
  }
  for (const std::string& directive : directives) {
    if (!std::any_of(types.begin(), types.end(), [&](const auto& t) {
          return t.first == directive && !t.second.empty();
        })) {
      continue;
    }
    const FormatObject unknown = {
        directive.c_str(), kUnknown, FormatStatus::kRefused, "", {}};
    const FormatOutcome outcome = RunFormatScene(
        FormatScene(unknown, nullptr, "", "", "spectrum"), folder.File(""));
    for (const std::string& type : Supported(outcome.error)) {
      INFO("src/parse/format_*.cc has no line for " << directive << " " << type);
      CHECK((types.contains({directive, type}) || directive == "MakeNamedMedium"));
    }
  }
  const FormatOutcome outcome = RunFormatScene(std::string(kUnknown), folder.File(""));
  const std::vector<std::string> known = Supported(outcome.error);
  CHECK(known.size() >= 40);
  for (const std::string& directive : known) {
    INFO("src/parse/format_*.cc has no line for the directive " << directive);
    CHECK(directives.contains(directive));
  }
}

TEST_CASE("the document is the table of pbrt's format", "[parse][format]") {
  INFO("write it anew: lanelight info --format > docs/pbrt-format.md");
  CHECK((ReadText("docs/pbrt-format.md") == FormatDocument()));
}

}  // namespace lanelight
