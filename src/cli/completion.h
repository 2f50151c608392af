// Shell completion, written from what the command line says of itself: nothing here knows
// a flag by name.
#pragma once

#include <string>
#include <vector>

namespace lanelight {

/// What a word of the command line stands for.
struct CompletionValue {
  enum class Kind { kNone, kFile, kFolder, kChoices, kOther };
  Kind kind = Kind::kNone;           // kNone: a flag without a value
  std::string name;                  // "FILE", "N"
  std::string extension;             // of a file: ".pbrt"; empty: any
  std::vector<std::string> choices;  // kChoices
  bool optional = false;             // the flag may stand alone
};

struct CompletionFlag {
  std::vector<std::string> names;  // "-o", "--output"
  std::string meaning;
  CompletionValue value;
  bool repeats = false;
};

struct CompletionCommand {
  std::string name, meaning;
  std::vector<CompletionFlag> flags;
  std::vector<CompletionValue> words;  // what stands on its own, in order
  bool last_repeats = false;           // any number of the last one
};

/// The program: its name, its own flags, and its commands.
struct CompletionProgram {
  std::string name;
  std::vector<CompletionFlag> flags;
  std::vector<CompletionCommand> commands;
};

/// The text in single quotes, for any of the shells.
std::string ShellQuoted(const std::string& text);

/// Scripts for the shells; to be sourced, or to be installed where the shell looks.
std::string BashCompletion(const CompletionProgram& program);
std::string ZshCompletion(const CompletionProgram& program);
std::string FishCompletion(const CompletionProgram& program);

}  // namespace lanelight
