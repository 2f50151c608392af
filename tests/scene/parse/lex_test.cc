#include "src/scene/parse/lex.h"

#include <catch2/catch.hpp>

#include <vector>

namespace lanelight {
namespace {

std::vector<Token> Tokens(Lexer& lexer) {
  std::vector<Token> tokens;
  do {
    tokens.push_back(lexer.Next());
  } while (tokens.back().kind != TokenKind::kEnd);
  return tokens;
}

std::shared_ptr<const std::string> Name() {
  return std::make_shared<const std::string>("a.pbrt");
}

TEST_CASE("tokens have kinds and places", "[parse]") {
  Lexer lexer("Shape \"disk\" # comment [ \"\n\t[1 -2.5e1]+.5\r\nEnd", Name());
  const std::vector<Token> t = Tokens(lexer);
  REQUIRE(t.size() == 9);
  CHECK(t[0].kind == TokenKind::kWord);
  CHECK(t[0].text == "Shape");
  CHECK(t[1].kind == TokenKind::kString);
  CHECK(t[1].text == "disk");
  CHECK(t[1].column == 7);
  CHECK(t[2].kind == TokenKind::kOpen);
  CHECK(t[2].line == 2);
  CHECK(t[2].column == 2);
  CHECK(t[3].number == 1);
  CHECK(t[4].number == -25);
  CHECK(t[5].kind == TokenKind::kClose);
  CHECK(t[6].number == 0.5);
  CHECK(t[7].text == "End");
  CHECK(t[7].line == 3);
  CHECK(t[7].column == 1);
  CHECK(lexer.Where(t[7]).ToString() == "a.pbrt:3:1");
}

TEST_CASE("lines, including comments, end with LF, CR LF or CR", "[parse]") {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    const std::string text = "Shape # comment" + end + end + " 1 # another" + end +
                             "End" + end + "\"open" + end;
    Lexer lexer(text, Name());
    CHECK(lexer.Next().text == "Shape");
    CHECK(lexer.Where(lexer.Next()).ToString() == "a.pbrt:3:2");
    CHECK(lexer.Where(lexer.Next()).ToString() == "a.pbrt:4:1");
    CHECK_THROWS_WITH(lexer.Next(), Catch::Contains("a.pbrt:5:1"));
  }
}

TEST_CASE("strings resolve escapes", "[parse]") {
  Lexer lexer(R"("a\"b\\c\td" "plain" "")", Name());
  CHECK(lexer.Peek().text == "a\"b\\c\td");
  CHECK(lexer.Next().text == "a\"b\\c\td");
  CHECK(lexer.Next().text == "plain");
  CHECK(lexer.Next().text == "");
  CHECK(lexer.Next().kind == TokenKind::kEnd);
  CHECK(lexer.Next().kind == TokenKind::kEnd);
}

TEST_CASE("numbers keep every digit", "[parse]") {
  Lexer lexer("0.1 1.7976931348623157e308 5e-324 1e-400 -0 007", Name());
  CHECK(lexer.Next().number == 0.1);
  CHECK(lexer.Next().number == 1.7976931348623157e308);
  CHECK(lexer.Next().number == 5e-324);
  CHECK(lexer.Next().number == 0);
  CHECK(std::signbit(lexer.Next().number));
  CHECK(lexer.Next().number == 7);
}

TEST_CASE("a byte order mark is ignored", "[parse]") {
  Lexer lexer("\xef\xbb\xbfWorldBegin", Name());
  const Token token = lexer.Next();
  CHECK(token.text == "WorldBegin");
  CHECK(token.column == 1);
}

TEST_CASE("malformed input throws", "[parse]") {
  for (const char* text : {"1e", "--1", "+-1", "1.2.3", ".", "-", "1e999", "-inf", "0x10",
                           "\"abc", "\"abc\n\"", "\"a\\", "\"\\x\""}) {
    CAPTURE(text);
    Lexer lexer(text, Name());
    CHECK_THROWS_AS(lexer.Next(), InputError);
  }
}

}  // namespace
}  // namespace lanelight
