// Groups of stages and task parts, in which a profile adds up their times. GroupOf
// (src/render/wave/profile.h) says which stage is in which group.
#pragma once

#include <cstddef>

namespace lanelight {

// X(name, text, meaning), in the order of a path
#define LANELIGHT_PROFILE_GROUPS(X)                                                  \
  X(Camera, "camera", "starts paths and their camera rays")                          \
  X(Sampling, "sampling", "sample points")                                           \
  X(Intersect, "intersect", "closest hits of rays")                                  \
  X(Media, "media", "events in media, and their interfaces")                         \
  X(Surface, "surface", "points and normals of hits")                                \
  X(Texture, "texture", "textures, bumps and spectra of materials")                  \
  X(Lights, "lights", "light samples, and light that rays hit")                      \
  X(Shade, "shade", "scattering at materials")                                       \
  X(Shadow, "shadow", "shadow rays")                                                 \
  X(Queues, "queues", "sorting of paths, Russian roulette and splitting")            \
  X(Film, "film", "adds light to samples, and samples to the film")                  \
  X(VisibleLights, "visible lights",                                                 \
    "more rays at edges of visible lights (seen-lights=apart)")                      \
  X(Reuse, "path reuse", "connects paths of a block of pixels (reuse=block)")        \
  X(LightPaths, "light subpaths", "paths that start at lights (light-paths=splats)") \
  X(Training, "training", "trial runs and training passes before the image")         \
  X(Outside, "outside", "task set-up, scheduler, progress and idle threads")

enum class ProfileGroup : int {
#define X(name, ...) k##name,
  LANELIGHT_PROFILE_GROUPS(X)
#undef X
      kCount
};
inline constexpr std::size_t kNumProfileGroups = std::size_t(ProfileGroup::kCount);

inline constexpr const char* Name(ProfileGroup group) {
#define X(name, text, meaning) text,
  constexpr const char* kNames[] = {LANELIGHT_PROFILE_GROUPS(X)};
#undef X
  return kNames[int(group)];
}

inline constexpr const char* Meaning(ProfileGroup group) {
#define X(name, text, meaning) meaning,
  constexpr const char* kMeanings[] = {LANELIGHT_PROFILE_GROUPS(X)};
#undef X
  return kMeanings[int(group)];
}

}  // namespace lanelight
