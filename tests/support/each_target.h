// Tests whose property holds on every SIMD target.
#pragma once

#include <catch2/catch.hpp>
#include <string>

#include "tests/support/test_target.h"

namespace lanelight {

/// Repeats the rest of a test case for each SIMD target that this machine can run.
/// Fixtures run the kernels of that target; messages of failures name it.
class EachTarget {
 public:
  EachTarget()
      : name_(GENERATE(from_range(AvailableTargets()))),
        message_(
            Catch::MessageBuilder("INFO", CATCH_INTERNAL_LINEINFO, Catch::ResultWas::Info)
            << "target " << name_) {
    ForceTarget(name_);
  }
  ~EachTarget() { ForceTarget(""); }
  EachTarget(const EachTarget&) = delete;

  const std::string& name() const { return name_; }

 private:
  std::string name_;
  Catch::ScopedMessage message_;
};

}  // namespace lanelight
