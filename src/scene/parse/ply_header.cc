#include "src/scene/parse/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <memory>

#include "src/base/core/error.h"
#include "src/base/core/source_location.h"
#include "src/base/core/suggest.h"

namespace lanelight {
namespace {

constexpr std::size_t kLongestLine = 4096;
constexpr std::size_t kMaxElements = 64;
constexpr std::size_t kMaxProperties = 256;

class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, const std::string& name)
      : bytes_(bytes),
        line_end_(LineEndOf(bytes)),
        file_(std::make_shared<const std::string>(name)) {}

  template <class... Args>
  [[noreturn]] void Fail(fmt::format_string<Args...> format, Args&&... args) const {
    throw InputError({file_, line_, 1}, fmt::format(format, std::forward<Args>(args)...));
  }

  // The words of the next line that is not a comment.
  std::vector<std::string_view> NextLine() {
    while (true) {
      const std::string_view rest = bytes_.substr(offset_);
      const std::size_t length = rest.substr(0, kLongestLine).find(line_end_);
      ++line_;
      if (length == rest.npos) {
        Fail("{}", rest.size() > kLongestLine ? "a line of the PLY header is too long"
                                              : "the PLY header ends without end_header");
      }
      offset_ += length + 1;
      std::vector<std::string_view> words = Words(rest.substr(0, length));
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      return words;
    }
  }

  std::size_t offset() const { return offset_; }
  int line() const { return line_; }
  SourceLocation where() const { return {file_, line_, 1}; }

 private:
  // Taken from the first line, because binary data may begin with any byte.
  static char LineEndOf(std::string_view bytes) {
    const std::size_t first = std::min(bytes.find_first_of("\r\n"), bytes.size());
    const bool old_mac =
        bytes.substr(first, 1) == "\r" && bytes.substr(first, 2) != "\r\n";
    return old_mac ? '\r' : '\n';
  }
  static std::vector<std::string_view> Words(std::string_view line) {
    constexpr std::string_view kBlank = " \t\r";
    std::vector<std::string_view> words;
    while (true) {
      const std::size_t begin = line.find_first_not_of(kBlank);
      if (begin == line.npos) return words;
      line.remove_prefix(begin);
      words.push_back(line.substr(0, line.find_first_of(kBlank)));
      line.remove_prefix(words.back().size());
    }
  }

  std::string_view bytes_;
  char line_end_;
  std::shared_ptr<const std::string> file_;
  std::size_t offset_ = 0;
  int line_ = 0;
};

PlyType ParseType(const HeaderReader& reader, std::string_view name) {
  struct Name {
    const char* name;
    PlyType type;
  };
  static constexpr Name kNames[] = {
      {"char", PlyType::kInt8},      {"int8", PlyType::kInt8},
      {"uchar", PlyType::kUint8},    {"uint8", PlyType::kUint8},
      {"short", PlyType::kInt16},    {"int16", PlyType::kInt16},
      {"ushort", PlyType::kUint16},  {"uint16", PlyType::kUint16},
      {"int", PlyType::kInt32},      {"int32", PlyType::kInt32},
      {"uint", PlyType::kUint32},    {"uint32", PlyType::kUint32},
      {"float", PlyType::kFloat32},  {"float32", PlyType::kFloat32},
      {"double", PlyType::kFloat64}, {"float64", PlyType::kFloat64}};
  std::vector<std::string> known;
  for (const Name& candidate : kNames) {
    if (name == candidate.name) return candidate.type;
    known.emplace_back(candidate.name);
  }
  ThrowUnknown(reader.where(), "PLY type", name, known);
}

PlyFormat ParseFormat(const HeaderReader& reader,
                      const std::vector<std::string_view>& words) {
  if (words.size() != 3 || words[0] != "format") {
    reader.Fail("found {}, expected the PLY format line", Quoted(words[0]));
  }
  if (words[2] != "1.0") {
    reader.Fail("PLY version {} is not supported; 1.0 is", Quoted(words[2]));
  }
  const std::vector<std::string> names = {"ascii", "binary_little_endian",
                                          "binary_big_endian"};
  for (int i = 0; i < 3; ++i) {
    if (words[1] == names[i]) return static_cast<PlyFormat>(i);
  }
  ThrowUnknown(reader.where(), "PLY format", words[1], names);
}

PlyElement ParseElement(const HeaderReader& reader,
                        const std::vector<std::string_view>& words) {
  PlyElement element;
  if (words.size() != 3) reader.Fail("a PLY element line needs a name and a count");
  element.name = words[1];
  const char* end = words[2].data() + words[2].size();
  const auto result = std::from_chars(words[2].data(), end, element.count);
  if (result.ec != std::errc() || result.ptr != end) {
    reader.Fail("{} is not a count of PLY elements", Quoted(words[2]));
  }
  return element;
}

PlyProperty ParseProperty(const HeaderReader& reader,
                          const std::vector<std::string_view>& words) {
  PlyProperty property;
  property.is_list = words.size() == 5 && words[1] == "list";
  if (!property.is_list && words.size() != 3) {
    reader.Fail(
        "a PLY property line is \"property TYPE NAME\" or \"property list COUNT_TYPE "
        "TYPE NAME\"");
  }
  property.name = words.back();
  property.type = ParseType(reader, words[words.size() - 2]);
  if (!property.is_list) return property;
  property.count_type = ParseType(reader, words[2]);
  if (property.count_type >= PlyType::kFloat32) {
    reader.Fail("the count of a PLY list must be an integer type");
  }
  return property;
}

}  // namespace

std::size_t PlyElement::min_bytes() const {
  std::size_t bytes = 0;
  for (const PlyProperty& property : properties) {
    bytes += PlySize(property.is_list ? property.count_type : property.type);
  }
  return bytes;
}

PlyHeader ParsePlyHeader(std::string_view bytes, const std::string& name) {
  HeaderReader reader(bytes, name);
  if (!bytes.starts_with("ply\n") && !bytes.starts_with("ply\r")) {
    throw InputError({std::make_shared<const std::string>(name), 1, 1},
                     "this is not a PLY file: it does not start with the line \"ply\"");
  }
  reader.NextLine();
  PlyHeader header;
  header.format = ParseFormat(reader, reader.NextLine());
  for (auto words = reader.NextLine(); words[0] != "end_header";
       words = reader.NextLine()) {
    if (words[0] == "element") {
      header.elements.push_back(ParseElement(reader, words));
      if (header.elements.size() > kMaxElements) reader.Fail("too many PLY elements");
    } else if (words[0] == "property") {
      if (header.elements.empty()) reader.Fail("a PLY property before any element");
      std::vector<PlyProperty>& properties = header.elements.back().properties;
      properties.push_back(ParseProperty(reader, words));
      if (properties.size() > kMaxProperties) reader.Fail("too many PLY properties");
    } else {
      ThrowUnknown(reader.where(), "line of the PLY header:", words[0],
                   {"comment", "element", "property", "end_header"});
    }
  }
  header.body = reader.offset();
  header.body_line = reader.line() + 1;
  return header;
}

}  // namespace lanelight
