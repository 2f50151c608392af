#include "src/base/core/column.h"

namespace lanelight {

std::size_t SizeOf(StateType type) {
  return type == StateType::kFloat64 || type == StateType::kUint64 ? 8 : 4;
}

const char* Name(StateType type) {
  switch (type) {
    case StateType::kFloat32:
      return "float32";
    case StateType::kFloat64:
      return "float64";
    case StateType::kUint32:
      return "uint32";
    case StateType::kUint64:
      return "uint64";
    case StateType::kInt32:
      return "int32";
  }
  LL_CHECK(false);
  return "";
}

}  // namespace lanelight
