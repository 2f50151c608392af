#include "src/vocabulary/path/features.h"

namespace lanelight {

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

}  // namespace lanelight
