#include "src/parse/format.h"

namespace lanelight {

const FormatTable& PbrtFormat() {
  static const FormatTable kTable = [] {
    FormatTable all;
    for (const auto part : {DirectiveFormat, OptionFormat, ShapeFormat, LightFormat,
                            MaterialFormat, TextureFormat, MediumFormat}) {
      for (FormatObject& object : part()) all.push_back(std::move(object));
    }
    return all;
  }();
  return kTable;
}

std::string_view WhyRefused(std::string_view directive, std::string_view type) {
  for (const FormatObject& object : PbrtFormat()) {
    if (object.status != FormatStatus::kRefused) continue;
    if (directive == object.directive && type == object.type) return object.why;
  }
  return "";
}

}  // namespace lanelight
