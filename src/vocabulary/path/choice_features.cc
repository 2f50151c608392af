#include "src/vocabulary/path/choice_features.h"

namespace lanelight {

using enum Feature;

namespace {

constexpr FeatureSet Union(FeatureSet a, FeatureSet b) {
  a.Add(b);
  return a;
}

}  // namespace

#define LANELIGHT_OWN_STAGE(feature) FeatureSet({feature})
#define LANELIGHT_OWN_PLAIN(feature) FeatureSet()
#define LANELIGHT_TURNS_ON(Type, CHOICES)                                   \
  FeatureSet TurnsOn(Type choice) {                                         \
    constexpr FeatureSet kOfChoices[] = {CHOICES(LANELIGHT_ROW_OF_##Type)}; \
    return kOfChoices[static_cast<int>(choice)];                            \
  }

#define LANELIGHT_ROW_OF_Directions(name, own, also, ...) \
  Union(LANELIGHT_OWN_##own(k##name##Directions), FeatureSet also),
#define LANELIGHT_ROW_OF_Points(name, own, also, ...) \
  Union(LANELIGHT_OWN_##own(k##name##Points), FeatureSet also),
#define LANELIGHT_ROW_OF_Pairs(name, own, also, ...) \
  Union(LANELIGHT_OWN_##own(k##name##Pairs), FeatureSet also),
#define LANELIGHT_ROW_OF_Control(name, own, also, ...) \
  Union(LANELIGHT_OWN_##own(k##name##Control), FeatureSet also),
#define LANELIGHT_ROW_OF_Roulette(name, own, also, ...) \
  Union(LANELIGHT_OWN_##own(k##name##Roulette), FeatureSet also),
#define LANELIGHT_ROW_OF_LightSelection(name, own, also, ...) \
  Union(LANELIGHT_OWN_##own(k##name##LightSelection), FeatureSet also),
#define LANELIGHT_ROW_OF_LightPoints(name, own, also, ...) \
  Union(LANELIGHT_OWN_##own(k##name##LightPoints), FeatureSet also),
#define LANELIGHT_ROW_OF_LightCandidates(name, own, also, ...) \
  Union(LANELIGHT_OWN_##own(k##name##LightCandidates), FeatureSet also),
#define LANELIGHT_ROW_OF_ShadowRoulette(name, own, also, ...) \
  Union(LANELIGHT_OWN_##own(k##name##ShadowRoulette), FeatureSet also),
#define LANELIGHT_ROW_OF_Distances(name, own, also, ...) \
  Union(LANELIGHT_OWN_##own(k##name##Distances), FeatureSet also),
#define LANELIGHT_ROW_OF_Reuse(name, own, also, ...) \
  Union(LANELIGHT_OWN_##own(k##name##Reuse), FeatureSet also),
#define LANELIGHT_ROW_OF_Decide(name, own, also, ...) \
  Union(LANELIGHT_OWN_##own(k##name##Decide), FeatureSet also),

LANELIGHT_TURNS_ON(Directions, LANELIGHT_DIRECTIONS)
LANELIGHT_TURNS_ON(Points, LANELIGHT_POINTS)
LANELIGHT_TURNS_ON(Pairs, LANELIGHT_PAIRS)
LANELIGHT_TURNS_ON(Control, LANELIGHT_CONTROLS)
LANELIGHT_TURNS_ON(Roulette, LANELIGHT_ROULETTES)
LANELIGHT_TURNS_ON(LightSelection, LANELIGHT_LIGHT_SELECTIONS)
LANELIGHT_TURNS_ON(LightPoints, LANELIGHT_LIGHT_POINTS)
LANELIGHT_TURNS_ON(LightCandidates, LANELIGHT_LIGHT_CANDIDATE_CHOICES)
LANELIGHT_TURNS_ON(ShadowRoulette, LANELIGHT_SHADOW_ROULETTES)
LANELIGHT_TURNS_ON(Distances, LANELIGHT_DISTANCES)
LANELIGHT_TURNS_ON(Reuse, LANELIGHT_REUSES)
LANELIGHT_TURNS_ON(Decide, LANELIGHT_DECISIONS)

}  // namespace lanelight
