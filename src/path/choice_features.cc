#include "src/path/choice_features.h"

namespace lanelight {

using enum Feature;

namespace {

FeatureSet Union(FeatureSet a, FeatureSet b) {
  a.Add(b);
  return a;
}

}  // namespace

#define LANELIGHT_OWN_STAGE(feature) FeatureSet({feature})
#define LANELIGHT_OWN_PLAIN(feature) FeatureSet()

FeatureSet TurnsOn(Directions choice) {
  switch (choice) {
#define X(name, own, also, ...) \
  case Directions::k##name:     \
    return Union(LANELIGHT_OWN_##own(k##name##Directions), FeatureSet also);
    LANELIGHT_DIRECTIONS(X)
#undef X
  }
  return {};
}

FeatureSet TurnsOn(Points choice) {
  switch (choice) {
#define X(name, own, also, ...) \
  case Points::k##name:         \
    return Union(LANELIGHT_OWN_##own(k##name##Points), FeatureSet also);
    LANELIGHT_POINTS(X)
#undef X
  }
  return {};
}

FeatureSet TurnsOn(Pairs choice) {
  switch (choice) {
#define X(name, own, also, ...) \
  case Pairs::k##name:          \
    return Union(LANELIGHT_OWN_##own(k##name##Pairs), FeatureSet also);
    LANELIGHT_PAIRS(X)
#undef X
  }
  return {};
}

FeatureSet TurnsOn(Control choice) {
  switch (choice) {
#define X(name, own, also, ...) \
  case Control::k##name:        \
    return Union(LANELIGHT_OWN_##own(k##name##Control), FeatureSet also);
    LANELIGHT_CONTROLS(X)
#undef X
  }
  return {};
}

FeatureSet TurnsOn(Roulette choice) {
  switch (choice) {
#define X(name, own, also, ...) \
  case Roulette::k##name:       \
    return Union(LANELIGHT_OWN_##own(k##name##Roulette), FeatureSet also);
    LANELIGHT_ROULETTES(X)
#undef X
  }
  return {};
}

FeatureSet TurnsOn(LightSelection choice) {
  switch (choice) {
#define X(name, own, also, ...) \
  case LightSelection::k##name: \
    return Union(LANELIGHT_OWN_##own(k##name##LightSelection), FeatureSet also);
    LANELIGHT_LIGHT_SELECTIONS(X)
#undef X
  }
  return {};
}

FeatureSet TurnsOn(LightPoints choice) {
  switch (choice) {
#define X(name, own, also, ...) \
  case LightPoints::k##name:    \
    return Union(LANELIGHT_OWN_##own(k##name##LightPoints), FeatureSet also);
    LANELIGHT_LIGHT_POINTS(X)
#undef X
  }
  return {};
}

FeatureSet TurnsOn(LightCandidates choice) {
  switch (choice) {
#define X(name, own, also, ...)  \
  case LightCandidates::k##name: \
    return Union(LANELIGHT_OWN_##own(k##name##LightCandidates), FeatureSet also);
    LANELIGHT_LIGHT_CANDIDATE_CHOICES(X)
#undef X
  }
  return {};
}

FeatureSet TurnsOn(ShadowRoulette choice) {
  switch (choice) {
#define X(name, own, also, ...) \
  case ShadowRoulette::k##name: \
    return Union(LANELIGHT_OWN_##own(k##name##ShadowRoulette), FeatureSet also);
    LANELIGHT_SHADOW_ROULETTES(X)
#undef X
  }
  return {};
}

FeatureSet TurnsOn(Distances choice) {
  switch (choice) {
#define X(name, own, also, ...) \
  case Distances::k##name:      \
    return Union(LANELIGHT_OWN_##own(k##name##Distances), FeatureSet also);
    LANELIGHT_DISTANCES(X)
#undef X
  }
  return {};
}

FeatureSet TurnsOn(Guiding choice) {
  switch (choice) {
#define X(name, own, also, ...) \
  case Guiding::k##name:        \
    return Union(LANELIGHT_OWN_##own(k##name##Guiding), FeatureSet also);
    LANELIGHT_GUIDINGS(X)
#undef X
  }
  return {};
}

FeatureSet TurnsOn(Reuse choice) {
  switch (choice) {
#define X(name, own, also, ...) \
  case Reuse::k##name:          \
    return Union(LANELIGHT_OWN_##own(k##name##Reuse), FeatureSet also);
    LANELIGHT_REUSES(X)
#undef X
  }
  return {};
}

FeatureSet TurnsOn(Decide choice) {
  switch (choice) {
#define X(name, own, also, ...) \
  case Decide::k##name:         \
    return Union(LANELIGHT_OWN_##own(k##name##Decide), FeatureSet also);
    LANELIGHT_DECISIONS(X)
#undef X
  }
  return {};
}

#undef LANELIGHT_OWN_STAGE
#undef LANELIGHT_OWN_PLAIN

}  // namespace lanelight
