// Names and properties from the lists of features, fields, planes and roles of stages.
#include <algorithm>
#include <array>
#include <cctype>

#include "src/vocabulary/path/fields.h"
#include "src/vocabulary/path/run_parameters.h"
#include "src/vocabulary/path/stage.h"

namespace lanelight {
namespace {

struct FieldRow {
  const char *type, *name;
  FeatureSet features;
  Lifetime (*lifetime)(const FeatureSet& f);
  FirstValue first;
  const char* meaning;
};

const FieldRow& RowOf(Field field) {
  using enum Feature;
  using enum Lifetime;
  static constexpr FieldRow kRows[] = {
#define X(type, name, features, lifetime, first, meaning)         \
  {#type,                                                         \
   #name,                                                         \
   FeatureSet features,                                           \
   []([[maybe_unused]] const FeatureSet& f) { return lifetime; }, \
   FirstValue first,                                              \
   meaning},
      LANELIGHT_PATH_FIELDS(X)
#undef X
  };
  return kRows[static_cast<std::size_t>(field)];
}

template <class Predicate>
FieldSet Where(const Predicate& predicate) {
  FieldSet set;
  for (std::size_t i = 0; i < kNumFields; ++i) {
    const Field field = static_cast<Field>(i);
    if (predicate(field)) set.Add(field);
  }
  return set;
}

}  // namespace

const char* FieldName(Field field) { return RowOf(field).name; }

const char* FieldMeaning(Field field) { return RowOf(field).meaning; }

const char* FieldType(Field field) { return RowOf(field).type; }

FeatureSet FieldFeatures(Field field) { return RowOf(field).features; }

Lifetime FieldLifetime(Field field, const FeatureSet& f) {
  return RowOf(field).lifetime(f);
}

FirstValue FieldFirstValue(Field field) { return RowOf(field).first; }

bool IsLive(Field field, const FeatureSet& features) {
  const FeatureSet needed_by = FieldFeatures(field);
  return needed_by.empty() || features.HasAny(needed_by);
}

FieldSet fields::EverCarried() {
  return Where([](Field field) {
    return IsCarried(FieldLifetime(field, {})) ||
           IsCarried(FieldLifetime(field, FeatureSet::All()));
  });
}

FieldSet fields::WithFirstValue() {
  return Where([](Field field) { return FieldFirstValue(field).any; });
}

const char* FeatureName(Feature f) {
  static constexpr const char* kNames[] = {
#define X(name, meaning) #name,
      LANELIGHT_FEATURES(X)
#undef X
  };
  return kNames[static_cast<int>(f)] + 1;
}

const char* FeatureMeaning(Feature f) {
  static constexpr const char* kMeanings[] = {
#define X(name, meaning) meaning,
      LANELIGHT_FEATURES(X)
#undef X
  };
  return kMeanings[static_cast<int>(f)];
}

std::string WithoutFeature(Feature f) {
  std::string meaning = FeatureMeaning(f);
  // Choices of a strategy are named as on the command line.
  if (meaning.substr(0, meaning.find(' ')).find('=') != meaning.npos) {
    return "not " + meaning;
  }
  for (const std::string article : {"a ", "an "}) {
    if (meaning.starts_with(article)) meaning.erase(0, article.size());
  }
  return "no " + meaning;
}

#define LANELIGHT_OWN_STAGE(feature) \
  FeatureSet { feature }
#define LANELIGHT_OWN_PLAIN(feature) FeatureSet()
#define X(Type, key, name, own, also, ...) \
  LANELIGHT_OWN_##own(Feature::k##name##Type) | FeatureSet also,
#define LANELIGHT_AXIS(Type, member, key, CHOICES)                      \
  FeatureSet TurnsOn(Type choice) {                                     \
    using enum Feature;                                                 \
    static constexpr FeatureSet kOfChoices[] = {CHOICES(X, Type, key)}; \
    return kOfChoices[static_cast<int>(choice)];                        \
  }
LANELIGHT_AXES(LANELIGHT_AXIS)
#undef LANELIGHT_AXIS
#undef X
#undef LANELIGHT_OWN_STAGE
#undef LANELIGHT_OWN_PLAIN

SamplePlanes::SamplePlanes(const FeatureSet& features) : count_(0) {
  using enum Feature;
#define X(name, planes, needs, ...) FeatureSet needs,
  static constexpr FeatureSet kNeeds[] = {LANELIGHT_SAMPLE_PLANES(X)};
#undef X
  for (int i = 0; i < kNumPlaneGroups; ++i) {
    const bool here = features.HasAll(kNeeds[i]);
    first_[i] = here ? count_ : -1;
    if (here) count_ += NumPlanes(static_cast<PlaneGroup>(i));
  }
}

FeatureSet AuxiliaryFeatures(Auxiliary auxiliary) {
  FeatureSet features;
  if (auxiliary >= Auxiliary::kAov) features.Add(Feature::kAov);
  if (auxiliary >= Auxiliary::kGbuffer) features.Add(Feature::kGbuffer);
  return features;
}

bool SamplePlanes::Sums(PlaneGroup group) {
  constexpr bool kSums[] = {
#define X(name, planes, needs, sums, meaning) sums,
      LANELIGHT_SAMPLE_PLANES(X)
#undef X
  };
  return kSums[static_cast<int>(group)];
}

const char* Name(StageRole role) {
  static const auto kNames = [] {
    std::array names = {
#define X(name, meaning) std::string(#name),
        LANELIGHT_STAGE_ROLES(X)
#undef X
    };
    for (std::string& name : names) {
      name[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(name[0])));
    }
    return names;
  }();
  return kNames[static_cast<std::size_t>(role)].c_str();
}

}  // namespace lanelight
