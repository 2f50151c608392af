// Checks of programming mistakes; mistakes in the input are errors
// (src/base/core/error.h). A failed check throws CheckFailure with the expression, the
// operands and the place.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace lanelight {

class CheckFailure : public std::logic_error {
  using std::logic_error::logic_error;
};

[[noreturn]] inline void FailCheck(const char* file, int line, const char* expression,
                                   const std::string& operands = "") {
  throw CheckFailure(fmt::format("{}:{}: check failed: {}{}", file, line, expression,
                                 operands.empty() ? "" : " (" + operands + ")"));
}

}  // namespace lanelight

#define LL_CHECK(condition)                                                   \
  do {                                                                        \
    if (!(condition)) ::lanelight::FailCheck(__FILE__, __LINE__, #condition); \
  } while (false)

#define LL_CHECK_OP(a, op, b)                                       \
  do {                                                              \
    const auto& ll_a = (a);                                         \
    const auto& ll_b = (b);                                         \
    if (!(ll_a op ll_b)) {                                          \
      ::lanelight::FailCheck(__FILE__, __LINE__, #a " " #op " " #b, \
                             fmt::format("{} vs. {}", ll_a, ll_b)); \
    }                                                               \
  } while (false)
#define LL_CHECK_EQ(a, b) LL_CHECK_OP(a, ==, b)
#define LL_CHECK_LT(a, b) LL_CHECK_OP(a, <, b)
#define LL_CHECK_LE(a, b) LL_CHECK_OP(a, <=, b)
#define LL_CHECK_GT(a, b) LL_CHECK_OP(a, >, b)
#define LL_CHECK_GE(a, b) LL_CHECK_OP(a, >=, b)

#ifdef NDEBUG
#define LL_DCHECK(condition) \
  do {                       \
  } while (false && (condition))
#else
#define LL_DCHECK(condition) LL_CHECK(condition)
#endif
