#include <filesystem>

#include "src/core/gunzip.h"
#include "src/core/input_file.h"
#include "src/parse/interpret.h"
#include "src/core/suggest.h"

namespace lanelight {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kDeepestInclude = 64;
constexpr int kMostFiles = 100000;  // a chain of files that each include the next twice

bool Exists(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

}  // namespace

void ParseState::Unsupported(const SourceLocation& where, const std::string& message) {
  if (!options.skip_unsupported) {
    throw InputError(where, message + " (--skip-unsupported goes on without it)");
  }
  AddNote(where, "skipped: " + message, true);
}

std::string ReadWholeFile(const std::string& path, const SourceLocation& where,
                          std::string_view kind) {
  const auto refusal = [&](const std::string& why) {
    return InputError(where,
                      fmt::format("cannot read {} {}: {}", kind, Quoted(path), why));
  };
  try {
    std::string content = ReadWholeFile(path);
    if (!IsGzip(path, content)) return content;
    return Gunzip(content, MaxUnpackedSize(content.size()));
  } catch (const Unreadable& problem) {
    throw refusal(problem.reason());
  } catch (const InputError& problem) {
    throw refusal(problem.message());
  }
}

std::string ResolvePath(const ParseState& state, const std::string& name) {
  const fs::path main = fs::path(state.open_files.front().directory) / name;
  if (!state.options.allow_files) return main.string();
  const fs::path local = fs::path(state.open_files.back().directory) / name;
  const fs::path& found = !Exists(main) && Exists(local) ? local : main;
  if (state.options.files != nullptr) state.options.files->insert(found.string());
  return found.string();
}

NamedFile FileOf(const ParseState& state, ParamSet& params, std::string_view name) {
  const Param* param = params.Find(name, {ParamType::kString});
  const std::string file = params.String(name, "");
  if (param == nullptr) return {};
  if (file.empty()) params.Fail(*param, "the file name is empty");
  return {param, ResolvePath(state, file)};
}

std::string ReadSceneFile(const ParseState& state, const std::string& path,
                          const SourceLocation& where, std::string_view kind) {
  if (!state.options.allow_files) {
    throw InputError(where, fmt::format("found {} {}, but files may not be read here",
                                        kind, Quoted(path)));
  }
  return ReadWholeFile(path, where, kind);
}

void RunFile(ParseState& state, const std::string& path, const SourceLocation& where) {
  std::error_code ignored;
  const std::string identity = fs::weakly_canonical(path, ignored).string();
  for (const OpenFile& file : state.open_files) {
    if (!identity.empty() && file.identity == identity) {
      throw InputError(where,
                       fmt::format("{} is included from within itself", Quoted(path)));
    }
  }
  if (state.open_files.size() >= kDeepestInclude) {
    throw InputError(
        where, fmt::format("files are included more than {} deep", kDeepestInclude));
  }
  if (++state.files_read > kMostFiles) {
    throw InputError(where, fmt::format("more than {} files are included", kMostFiles));
  }
  const std::string text = ReadSceneFile(state, path, where, "the scene file");
  state.open_files.push_back({identity, fs::path(path).parent_path().string()});
  RunDirectives(state, text, path);
  // ResolvePath needs the main file's directory to the end, so the last entry stays.
  if (state.open_files.size() > 1) state.open_files.pop_back();
}

}  // namespace lanelight
