#include <fmt/format.h>

#include <filesystem>

#include "src/base/core/input_file.h"
#include "src/base/core/suggest.h"
#include "src/scene/parse/interpret.h"

namespace lanelight {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kDeepestInclude = 64;
// Limit for all files together; repeated includes count again, because a chain of files
// that each include the next twice would not end. Each file adds kBytesPerFile.
constexpr std::size_t kGiB = std::size_t{1} << 30;
constexpr std::size_t kMaxBytes = 4 * kGiB, kBytesPerFile = 256;
// Files up to kMaxKeptFile bytes stay in memory, up to kMaxKept bytes in all.
constexpr std::size_t kMaxKeptFile = 1 << 16, kMaxKept = kGiB / 4;

bool Exists(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

SourceFilePtr OpenSource(ParseState& state, const std::string& path,
                         const SourceLocation& where) {
  const auto kept = state.kept_files.find(path);
  if (kept != state.kept_files.end()) return kept->second;
  std::error_code ignored;
  auto file = std::make_shared<const SourceFile>(SourceFile{
      fs::weakly_canonical(path, ignored).string(), fs::path(path).parent_path().string(),
      std::make_shared<const std::string>(path),
      ReadSceneFile(state, path, where, "the scene file")});
  const std::size_t size = file->text.size();
  if (size <= kMaxKeptFile && state.bytes_kept + size <= kMaxKept) {
    state.bytes_kept += size;
    state.kept_files.emplace(path, file);
  }
  return file;
}

}  // namespace

void ParseState::Unsupported(const SourceLocation& where, const std::string& message) {
  if (!options.skip_unsupported) {
    throw InputError(where, message + " (--skip-unsupported renders without it)");
  }
  AddImageNote(where, "skipped: " + message);
}

std::string ReadWholeFile(const std::string& path, const SourceLocation& where,
                          std::string_view kind) {
  const auto refusal = [&](const std::string& why) {
    return InputError(where, "cannot read {} {}: {}", kind, Quoted(path), why);
  };
  std::string content;
  try {
    content = ReadWholeFile(path);
    if (IsGzip(path, content)) {
      content = Gunzip(content, MaxUnpackedSize(content.size()));
    }
  } catch (const Unreadable& problem) {
    throw refusal(problem.reason());
  } catch (const InputError& problem) {
    throw refusal(problem.message());
  }
  if (content.starts_with("\xff\xfe") || content.starts_with("\xfe\xff")) {
    throw refusal("it is UTF-16; save it as UTF-8");
  }
  return content;
}

std::string ResolvePath(const ParseState& state, const std::string& name) {
  const fs::path main = fs::path(state.open_files.front()->directory) / name;
  if (!state.options.allow_files) return main.string();
  const fs::path local = fs::path(state.open_files.back()->directory) / name;
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

NamedFile RequireFile(const ParseState& state, ParamSet& params, std::string_view name) {
  params.Need(name, ParamType::kString);
  return FileOf(state, params, name);
}

std::string ReadSceneFile(const ParseState& state, const std::string& path,
                          const SourceLocation& where, std::string_view kind) {
  if (!state.options.allow_files) {
    throw InputError(where, "found {} {}, but reading files is disabled here", kind,
                     Quoted(path));
  }
  return ReadWholeFile(path, where, kind);
}

std::vector<double> ReadNumberFile(const ParseState& state, const std::string& path,
                                   const SourceLocation& where, std::string_view kind) {
  return ReadNumbers(ReadSceneFile(state, path, where, kind),
                     std::make_shared<const std::string>(path));
}

void RunFile(ParseState& state, const std::string& path, const SourceLocation& where) {
  const SourceFilePtr source = OpenSource(state, path, where);
  for (const SourceFilePtr& file : state.open_files) {
    if (!source->identity.empty() && file->identity == source->identity) {
      throw InputError(where, "{} is included from within itself", Quoted(path));
    }
  }
  if (state.open_files.size() >= kDeepestInclude) {
    throw InputError(where, "files are included more than {} deep", kDeepestInclude);
  }
  state.bytes_run += source->text.size() + kBytesPerFile;
  if (state.bytes_run > kMaxBytes) {
    throw InputError(where,
                     "all included files together have more than {} GiB; a file that is "
                     "included again counts again",
                     kMaxBytes / kGiB);
  }
  state.open_files.push_back(source);
  RunDirectives(state);
  // The last entry stays, because ResolvePath needs the main file's directory.
  if (state.open_files.size() > 1) state.open_files.pop_back();
}

}  // namespace lanelight
