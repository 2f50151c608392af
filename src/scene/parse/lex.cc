#include "src/scene/parse/lex.h"

#include <fmt/format.h>

#include <fast_float/fast_float.h>

#include <cmath>
#include <utility>

#include "src/base/core/source_location.h"
#include "src/base/core/suggest.h"

namespace lanelight {
namespace {

bool IsBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

bool EndsWord(char c) {
  return IsBlank(c) || c == '"' || c == '[' || c == ']' || c == '#';
}

bool StartsNumber(char c) {
  return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.';
}

// Returns the character of the escape `c`, or -1.
int Escape(char c) {
  constexpr std::string_view kEscapeNames = "bfnrt\\'\"",
                             kEscapeValues = "\b\f\n\r\t\\'\"";
  const std::size_t at = kEscapeNames.find(c);
  return at == kEscapeNames.npos ? -1 : kEscapeValues[at];
}

}  // namespace

std::string Token::Describe() const {
  switch (kind) {
    case TokenKind::kEnd:
      return "the end of the file";
    case TokenKind::kString:
      return "the string " + Quoted(text);
    case TokenKind::kNumber:
      return fmt::format("the number {}", text.substr(0, 60));
    default:
      return Quoted(text);
  }
}

Lexer::Lexer(std::string_view text, std::shared_ptr<const std::string> file)
    : cursor_(text.data()),
      end_(text.data() + text.size()),
      line_start_(cursor_),
      file_(std::move(file)) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (text.substr(0, 3) == kByteOrderMark) line_start_ = cursor_ += 3;
}

SourceLocation Lexer::Where(const Token& token) const {
  return {file_, token.line, token.column};
}

Token Lexer::Next() {
  if (!has_peeked_) return Scan();
  has_peeked_ = false;
  return peeked_;
}

const Token& Lexer::Peek() {
  if (!has_peeked_) peeked_ = Scan();
  has_peeked_ = true;
  return peeked_;
}

void Lexer::SkipBlank() {
  for (; (cursor_ = SkipSpaces(cursor_, end_)) < end_; ++cursor_) {
    if (*cursor_ == '#') {
      while (cursor_ < end_ && !EndsLine(cursor_, end_)) ++cursor_;
      if (cursor_ == end_) return;
    }
    if (!IsBlank(*cursor_)) return;
    if (EndsLine(cursor_, end_)) {
      ++line_;
      line_start_ = cursor_ + 1;
    }
  }
}

Token Lexer::Scan() {
  SkipBlank();
  Token token;
  token.line = line_;
  token.column = static_cast<int>(cursor_ - line_start_) + 1;
  if (cursor_ == end_) return token;
  const char* begin = cursor_;
  if (*begin == '"') {
    ScanString(&token);
    return token;
  }
  if (*begin == '[' || *begin == ']') {
    ++cursor_;
    token.kind = *begin == '[' ? TokenKind::kOpen : TokenKind::kClose;
  } else {
    while (cursor_ < end_ && !EndsWord(*cursor_)) ++cursor_;
    token.kind = TokenKind::kWord;
  }
  token.text = {begin, static_cast<std::size_t>(cursor_ - begin)};
  if (token.kind == TokenKind::kWord && StartsNumber(*begin)) ScanNumber(&token);
  return token;
}

void Lexer::ScanNumber(Token* token) {
  const char* first = token->text.data();
  const char* last = first + token->text.size();
  const bool plus = *first == '+' && last - first > 1 && first[1] != '-';
  if (plus) ++first;
  const auto result = fast_float::from_chars(first, last, token->number);
  if (result.ec == std::errc::invalid_argument || result.ptr != last) {
    throw InputError(Where(*token), "{} is not a number", Quoted(token->text));
  }
  if (!std::isfinite(token->number)) {
    throw InputError(
        Where(*token),
        "the number {} is not finite or beyond the range of a double (about 1.8e308)",
        Quoted(token->text));
  }
  token->kind = TokenKind::kNumber;
}

void Lexer::ScanString(Token* token) {
  token->kind = TokenKind::kString;
  const char* begin = ++cursor_;
  bool escaped = false;
  for (; cursor_ < end_ && *cursor_ != '"'; ++cursor_) {
    if (*cursor_ == '\n' || *cursor_ == '\r') break;
    if (static_cast<unsigned char>(*cursor_) < 0x20 && *cursor_ != '\t') {
      throw InputError(Where(line_, static_cast<int>(cursor_ - line_start_) + 1),
                       "control character {} in a string", static_cast<int>(*cursor_));
    }
    if (*cursor_ == '\\') {
      escaped = true;
      if (++cursor_ == end_ || *cursor_ == '\n' || *cursor_ == '\r') break;
    }
  }
  if (cursor_ >= end_ || *cursor_ != '"') {
    throw InputError(Where(*token), "this string has no closing quote on its line");
  }
  token->text = {begin, static_cast<std::size_t>(cursor_ - begin)};
  if (escaped) token->text = Unescape(*token, token->text);
  ++cursor_;
}

std::string_view Lexer::Unescape(const Token& token, std::string_view raw) {
  std::string out;
  for (std::size_t i = 0; i < raw.size(); ++i) {
    if (raw[i] != '\\') {
      out += raw[i];
      continue;
    }
    const int meant = Escape(raw[++i]);
    if (meant < 0) {
      throw InputError(Where(token.line, token.column + static_cast<int>(i)),
                       "unknown escape {} in a string; supported: \\b \\f \\n \\r \\t "
                       "\\\\ \\' \\\"; write / in file names",
                       Quoted(raw.substr(i - 1, 2)));
    }
    out += static_cast<char>(meant);
  }
  unescaped_.push_back(std::move(out));
  return unescaped_.back();
}

}  // namespace lanelight
