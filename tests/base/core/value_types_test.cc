// Values as text: what is read, what is written, and what is said of all else.
#include "src/base/core/source_location.h"
#include "src/base/core/value_types.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

namespace lanelight {
namespace {

using Catch::Contains;

template <class Type>
std::string RefusalOf(const Type& type, const std::string& text) {
  try {
    ReadValue(type, text);
  } catch (const InputError& error) {
    return error.message();
  }
  return "no error";
}

// The one text of what a text means.
template <class Type>
std::string Rewritten(const Type& type, const std::string& text) {
  return type.Write(ReadValue(type, text));
}

}  // namespace

TEST_CASE("numbers are decimal and within their range", "[core]") {
  const NumberType<std::uint64_t> count{1, 1000};
  CHECK(Rewritten(count, "010") == "10");
  CHECK(Rewritten(count, "+7") == "7");
  CHECK(ReadValue(count, "1000") == 1000);
  for (const char* text : {"0", "1001", "-1", "+-1", "++1", "0x10", "1e2", "4.0", "4 ",
                           "", "18446744073709551617"}) {
    INFO(text);
    CHECK_THAT(RefusalOf(count, text), Contains("is not an integer from 1 to 1000"));
  }
  const NumberType<double> stops{-100, 100};
  CHECK(Rewritten(stops, "-1.50") == "-1.5");
  CHECK(Rewritten(stops, "1e-3") == "0.001");
  for (const char* text : {"nan", "inf", "-101", "1,5", "two"}) {
    INFO(text);
    CHECK_THAT(RefusalOf(stops, text), Contains("is not a number from -100 to 100"));
  }
  CHECK(RefusalOf(count, "0").starts_with("0 is not"));
  CHECK(RefusalOf(count, "no").starts_with("\"no\" is not"));
  constexpr std::uint64_t kMaxValue = std::numeric_limits<std::uint64_t>::max();
  CHECK(ReadValue(NumberType<std::uint64_t>{0, kMaxValue}, "18446744073709551615") ==
        kMaxValue);
}

TEST_CASE("sizes and crop windows are parsed strictly", "[core]") {
  const SizeType size{65536};
  CHECK(Rewritten(size, "064x48") == "64x48");
  for (const char* text : {"64", "64*48", "0x48", "64x48x3", "64x", "65537x1", "x", ""}) {
    INFO(text);
    CHECK_THAT(RefusalOf(size, text), Contains("WIDTHxHEIGHT with sides of 1 to 65536"));
  }
  const WindowType window;
  CHECK(Rewritten(window, "0,1,20,3") == "0,1,20,3");
  for (const char* text : {"0,0,1", "0,0,1,1,1", "-1,0,1,1", "4,0,4,2", "0,3,1,2", ""}) {
    INFO(text);
    CHECK_THAT(RefusalOf(window, text), Contains("0 <= x0 < x1"));
  }
  CHECK(ParseNumbers<int>("3/16", '/') == std::vector<int>{3, 16});
  CHECK(ParseNumbers<int>("3//16", '/').empty());
}

TEST_CASE("counts accept unit prefixes", "[core]") {
  const CountType count{1, 20'000'000'000};
  CHECK(ReadValue(count, "256") == 256);
  CHECK(ReadValue(count, "10k") == 10'000);
  CHECK(ReadValue(count, "1.5M") == 1'500'000);
  CHECK(ReadValue(count, "2G") == 2'000'000'000);
  CHECK(Rewritten(count, "4K") == "4000");
  for (const char* text : {"10q", "k", "0", "0k", "-1k", "1.0001k", "1e3", "1e1k", "10 k",
                           "21G", "1m", "1.5", ""}) {
    INFO(text);
    CHECK_THAT(RefusalOf(count, text), Contains("e.g. 256, 10k or 2M"));
  }
}

TEST_CASE("times have units, in descending order", "[core]") {
  const SecondsType seconds{1e-3, 1e9};
  CHECK(ReadValue(seconds, "90") == 90);
  CHECK(ReadValue(seconds, "0.5") == 0.5);
  CHECK(ReadValue(seconds, "1e3") == 1000);
  CHECK(ReadValue(seconds, "5m") == 300);
  CHECK(ReadValue(seconds, "1h30m") == 5400);
  CHECK(ReadValue(seconds, "1.5h") == 5400);
  CHECK(ReadValue(seconds, "500ms") == 0.5);
  CHECK(ReadValue(seconds, "1d2h3m4s5ms") == 93784.005);
  CHECK(Rewritten(seconds, "5m") == "300");
  for (const char* text : {"5 m", "m", "30m1h", "1h1h", "5x", "-5m", "1e3m", "0", "nan",
                           "inf", "1h30", "0.1ms", ""}) {
    INFO(text);
    CHECK_THAT(RefusalOf(seconds, text), Contains("e.g. 90, 5m, 1h30m or 500ms"));
  }
}

TEST_CASE("errors in percent are square roots of relative MSE", "[core]") {
  const PercentErrorType error{1e-4, 1e8};
  CHECK(ReadValue(error, "1%") == Approx(1e-4));
  CHECK(ReadValue(error, "0.5%") == Approx(2.5e-5));
  CHECK(Rewritten(error, "7%") == "7%");
  CHECK(Rewritten(error, "0.3%") == "0.3%");
  for (const char* text : {"1", "%", "0%", "-1%", "nan%", "1 %", "1%%", "AVX2", ""}) {
    INFO(text);
    CHECK_THAT(RefusalOf(error, text), Contains("e.g. 1% or 0.5%"));
  }
}

TEST_CASE("unknown names are reported with the nearest name", "[core]") {
  enum class Fruit { kApple, kPear };
  const NamesType<Fruit> fruits = {{{"apple", Fruit::kApple}, {"pear", Fruit::kPear}}};
  CHECK(ReadValue(fruits, "pear") == Fruit::kPear);
  CHECK(fruits.Write(Fruit::kApple) == "apple");
  CHECK(RefusalOf(fruits, "aple") ==
        "\"aple\" is not one of \"apple\", \"pear\"; did you mean \"apple\"?");
  CHECK(RefusalOf(fruits, "Apple").starts_with("\"Apple\" is not one of"));
  CHECK(ReadValue(FlagType{}, "false") == false);
  CHECK_THAT(RefusalOf(FlagType{}, "yes"), Contains("true or false"));
  CHECK_THAT(RefusalOf(TextType{"the name of a directory"}, ""),
             Contains("is not the name of a directory"));
}

TEST_CASE("errors keep location and message separate", "[core]") {
  const SourceLocation where = {std::make_shared<const std::string>("a: error: b"), 3, 7};
  const InputError placed(where, "x is not y");
  CHECK(std::string(placed.what()) == "a: error: b:3:7: error: x is not y");
  CHECK(std::string(placed.message()) == "x is not y");
  CHECK(std::string(InputError("no file").message()) == "no file");
  CHECK(std::string(InputError({}, "").message()).empty());
}

}  // namespace lanelight
