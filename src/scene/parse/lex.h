// Characters of a pbrt scene file to tokens with places.
#pragma once

#include <cstdint>
#include <cstring>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "src/base/core/error.h"
#include "src/base/core/source_location.h"

namespace lanelight {

/// The first character from `at` on that is no space, or `end`. Eight at a time: some
/// exporters pad their columns with most of the file.
inline const char* SkipSpaces(const char* at, const char* end) {
  constexpr std::uint64_t kEight = 0x2020202020202020u;
  for (std::uint64_t word; end - at >= 8; at += 8) {
    std::memcpy(&word, at, 8);
    if (word != kEight) break;
  }
  while (at < end && *at == ' ') ++at;
  return at;
}

/// True if a line ends with the character at `at`: LF, CR LF, or CR alone (old Macs).
inline bool EndsLine(const char* at, const char* end) {
  return *at == '\n' || (*at == '\r' && (at + 1 == end || at[1] != '\n'));
}

enum class TokenKind { kEnd, kWord, kNumber, kString, kOpen, kClose };

/// `text` is what stands in the file; for a string, what is between the quotes with its
/// escapes resolved. Lives as long as the Lexer and the text given to it.
struct Token {
  TokenKind kind = TokenKind::kEnd;
  std::string_view text;
  double number = 0;  // kNumber; always finite
  int line = 1, column = 1;

  /// For messages: `"text"` of a string, the text of a word, "the end of the file", ...
  std::string Describe() const;
};

/// Splits on white space, quotes and brackets; `#` starts a comment up to the end of the
/// line. Columns count bytes from 1. Throws InputError for a malformed or non-finite
/// number, an open string, an unknown escape, a control character in a string.
class Lexer {
 public:
  Lexer(std::string_view text, std::shared_ptr<const std::string> file);
  Lexer(const Lexer&) = delete;
  Lexer& operator=(const Lexer&) = delete;

  Token Next();
  const Token& Peek();
  SourceLocation Where(const Token& token) const;
  SourceLocation Where(int line, int column) const { return {file_, line, column}; }

 private:
  void SkipBlank();
  Token Scan();
  void ScanString(Token* token);
  void ScanNumber(Token* token);
  std::string_view Unescape(const Token& token, std::string_view raw);

  const char* cursor_;
  const char* end_;
  const char* line_start_;
  int line_ = 1;
  std::shared_ptr<const std::string> file_;
  Token peeked_;
  bool has_peeked_ = false;
  std::deque<std::string> unescaped_;  // keeps what Token::text points to
};

/// Returns the numbers of a text as pbrt-v4 reads them: blanks and line ends part them,
/// and so does one other character right after a number, as the comma of "400, 0.5". `#`
/// starts a comment. Throws InputError with `file`, line and column for anything else, as
/// a line of column names.
std::vector<double> ReadNumbers(std::string_view text,
                                std::shared_ptr<const std::string> file);

}  // namespace lanelight
