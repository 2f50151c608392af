#include "src/path/fields.h"

namespace lanelight {

const char* FieldName(Field f) {
  static constexpr const char* kNames[] = {
#define X(type, name, features, meaning) #name,
      LANELIGHT_PATH_FIELDS(X)
#undef X
  };
  return kNames[static_cast<std::size_t>(f)];
}

const char* FieldMeaning(Field f) {
  static constexpr const char* kMeanings[] = {
#define X(type, name, features, meaning) meaning,
      LANELIGHT_PATH_FIELDS(X)
#undef X
  };
  return kMeanings[static_cast<std::size_t>(f)];
}

const char* FieldType(Field f) {
  static constexpr const char* kTypes[] = {
#define X(type, name, features, meaning) #type,
      LANELIGHT_PATH_FIELDS(X)
#undef X
  };
  return kTypes[static_cast<std::size_t>(f)];
}

FeatureSet FieldFeatures(Field f) {
#define X(type, name, features, meaning) FeatureSet features,
  static const FeatureSet kFeatures[] = {LANELIGHT_PATH_FIELDS(X)};
#undef X
  return kFeatures[static_cast<std::size_t>(f)];
}

}  // namespace lanelight
