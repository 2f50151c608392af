#include "bench/calibrate/every_strategy.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "bench/calibrate/truth.h"
#include "src/vocabulary/strategy/strategy.h"

namespace lanelight::bench {
namespace {

// Arguments that are choices of their own: words, not numbers ("[:all|:pixel]"). Behind a
// number, which reuse=block alone has ("[:N[:random|:compact]]"), they come with that.
std::vector<std::string> Words(std::string_view arguments) {
  std::vector<std::string> words = {""};
  std::string before;
  for (std::size_t at = 0; (at = arguments.find(':', at)) != arguments.npos;) {
    const std::size_t end = arguments.find_first_of("|[]", ++at);
    const std::string_view word = arguments.substr(at, end - at);
    const bool is_word =
        word.find_first_not_of("abcdefghijklmnopqrstuvwxyz-") == std::string_view::npos;
    if (is_word) {
      words.push_back(before + ":" + std::string(word));
    } else if (word == "N") {
      before = ":" + std::to_string(kDefaultReusedPaths);
    }
  }
  return words;
}

// Strategies of different meaning.
class List {
 public:
  void Add(const std::string& name) {
    const std::string meaning = ToText(ParseStrategy(name));
    if (std::find(meanings_.begin(), meanings_.end(), meaning) != meanings_.end()) return;
    meanings_.push_back(meaning);
    names_.push_back(name);
  }
  const std::vector<std::string>& names() const { return names_; }

 private:
  std::vector<std::string> meanings_, names_;
};

}  // namespace

std::vector<std::string> EveryStrategy() {
  List list;
  list.Add(kDefaultName);
  for (const ChoiceInfo& choice : AllChoices()) {
    for (const std::string& word : Words(choice.arguments)) {
      list.Add(std::string(choice.axis) + "=" + choice.name + word);
    }
  }
  for (const PresetInfo& preset : AllPresets()) list.Add(preset.name);
  return list.names();
}

}  // namespace lanelight::bench
