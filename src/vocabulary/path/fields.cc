#include "src/vocabulary/path/fields.h"

namespace lanelight {

const char* FieldName(Field field) {
  static constexpr const char* kNames[] = {
#define X(type, name, ...) #name,
      LANELIGHT_PATH_FIELDS(X)
#undef X
  };
  return kNames[static_cast<std::size_t>(field)];
}

const char* FieldMeaning(Field field) {
  static constexpr const char* kMeanings[] = {
#define X(type, name, features, lifetime, first, meaning) meaning,
      LANELIGHT_PATH_FIELDS(X)
#undef X
  };
  return kMeanings[static_cast<std::size_t>(field)];
}

const char* FieldType(Field field) {
  static constexpr const char* kTypes[] = {
#define X(type, ...) #type,
      LANELIGHT_PATH_FIELDS(X)
#undef X
  };
  return kTypes[static_cast<std::size_t>(field)];
}

FeatureSet FieldFeatures(Field field) {
  using enum Feature;
#define X(type, name, features, ...) FeatureSet features,
  static const FeatureSet kFeatures[] = {LANELIGHT_PATH_FIELDS(X)};
#undef X
  return kFeatures[static_cast<std::size_t>(field)];
}

bool IsLive(Field field, const FeatureSet& features) {
  const FeatureSet needed_by = FieldFeatures(field);
  return needed_by.empty() || features.HasAny(needed_by);
}

Lifetime FieldLifetime(Field field, const FeatureSet& f) {
  using enum Lifetime;
  switch (field) {
#define X(type, name, features, lifetime, ...) \
  case Field::name:                            \
    return lifetime;
    LANELIGHT_PATH_FIELDS(X)
#undef X
    case Field::kCount:
      break;
  }
  return kPath;
}

FirstValue FieldFirstValue(Field field) {
#define X(type, name, features, lifetime, first, meaning) FirstValue first,
  static constexpr FirstValue kValues[] = {LANELIGHT_PATH_FIELDS(X)};
#undef X
  return kValues[static_cast<std::size_t>(field)];
}

namespace fields {
namespace {

template <class Predicate>
FieldSet Where(const Predicate& predicate) {
  FieldSet set;
  for (std::size_t i = 0; i < kNumFields; ++i) {
    const Field field = static_cast<Field>(i);
    if (predicate(field)) set = set | FieldSet{field};
  }
  return set;
}

}  // namespace

FieldSet EverCarried() {
  return Where([](Field field) {
    return IsCarried(FieldLifetime(field, {})) ||
           IsCarried(FieldLifetime(field, FeatureSet::All()));
  });
}

FieldSet WithFirstValue() {
  return Where([](Field field) { return FieldFirstValue(field).any; });
}

}  // namespace fields

}  // namespace lanelight
