#include "src/scene/parse/params.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "src/base/core/suggest.h"

namespace lanelight {
namespace {

std::string Typed(ParamType type, std::string_view name) {
  return fmt::format("{} {}", ParamTypeName(type), name);
}

bool Contains(std::initializer_list<ParamType> types, ParamType type) {
  return types.size() == 0 || std::find(types.begin(), types.end(), type) != types.end();
}

}  // namespace

std::vector<Vec3d> Triples(const Param& param) {
  std::vector<Vec3d> out;
  out.reserve(param.numbers.size() / 3);
  for (std::size_t i = 0; i + 2 < param.numbers.size(); i += 3) {
    out.push_back({param.numbers[i], param.numbers[i + 1], param.numbers[i + 2]});
  }
  return out;
}

ParamSet::ParamSet(std::string object, SourceLocation where, ParamList own,
                   std::shared_ptr<const ParamList> inherited, std::vector<Note>* notes)
    : object_(std::move(object)),
      where_(std::move(where)),
      own_(std::move(own)),
      used_(own_.size(), false),
      inherited_(std::move(inherited)),
      notes_(notes) {}

std::string ParamSet::ParameterMessage(const Param& param,
                                       const std::string& message) const {
  return fmt::format("{}, in {} of {}", message, Quoted(Typed(param.type, param.name)),
                     object_);
}

void ParamSet::Fail(const Param& param, const std::string& message) const {
  throw InputError(param.where, ParameterMessage(param, message));
}

void ParamSet::Warn(const Param& param, const std::string& message) const {
  notes_->push_back({param.where, ParameterMessage(param, message), false, true});
}

const Param* ParamSet::Find(std::string_view name,
                            std::initializer_list<ParamType> types) {
  if (std::find(legal_.begin(), legal_.end(), name) == legal_.end()) {
    legal_.emplace_back(name);
    legal_typed_.push_back(types.size() == 0 ? std::string(name)
                                             : Typed(*types.begin(), name));
  }
  for (std::size_t i = 0; i < own_.size(); ++i) {
    if (own_[i].name != name) continue;
    if (!Contains(types, own_[i].type)) {
      std::vector<std::string> supported;
      for (ParamType type : types) supported.push_back(Typed(type, name));
      throw InputError(own_[i].where, "found {} for {}; supported: {}",
                       Quoted(Typed(own_[i].type, name)), object_, QuotedList(supported));
    }
    used_[i] = true;
    return &own_[i];
  }
  if (!inherited_) return nullptr;
  // The last of several Attribute directives counts.
  for (auto it = inherited_->rbegin(); it != inherited_->rend(); ++it) {
    if (it->name == name && Contains(types, it->type)) return &*it;
  }
  return nullptr;
}

const Param& ParamSet::Need(std::string_view name, ParamType type) {
  const Param* param = Find(name, {type});
  if (param != nullptr) return *param;
  throw InputError(where_, "{} has no \"{}\"", object_, Typed(type, name));
}

const Param* ParamSet::FindSingle(std::string_view name, ParamType type) {
  const Param* param = Find(name, {type});
  if (param == nullptr) return nullptr;
  const std::size_t wanted = type == ParamType::kPoint3 ? 3 : 1;
  const std::size_t found =
      param->numbers.size() + param->strings.size() + param->bools.size();
  if (found != wanted) Fail(*param, "more than one value");
  return param;
}

void ParamSet::CheckLimits(const Param& param, Limits limits) const {
  const double value = param.numbers[0];
  if (value >= limits.low && value <= limits.high) return;
  Fail(param, "the value {} is outside {} to {}", value, limits.low, limits.high);
}

double ParamSet::Float(std::string_view name, double absent, Limits limits) {
  const Param* param = FindSingle(name, ParamType::kFloat);
  if (param == nullptr) return absent;
  CheckLimits(*param, limits);
  return param->numbers[0];
}

int ParamSet::Integer(std::string_view name, int absent, Limits limits) {
  const Param* param = FindSingle(name, ParamType::kInteger);
  if (param == nullptr) return absent;
  CheckLimits(*param, limits);
  return static_cast<int>(param->numbers[0]);
}

bool ParamSet::Bool(std::string_view name, bool absent) {
  const Param* param = FindSingle(name, ParamType::kBool);
  return param == nullptr ? absent : param->bools[0];
}

std::string ParamSet::String(std::string_view name, const std::string& absent) {
  const Param* param = FindSingle(name, ParamType::kString);
  return param == nullptr ? absent : param->strings[0];
}

Vec3d ParamSet::Point3(std::string_view name, Vec3d absent) {
  const Param* param = FindSingle(name, ParamType::kPoint3);
  return param == nullptr ? absent : Triples(*param)[0];
}

std::size_t ParamSet::ChoiceOf(std::string_view name,
                               const std::vector<std::string>& choices,
                               const char* unknown) {
  const Param* param = FindSingle(name, ParamType::kString);
  if (param == nullptr) return 0;
  auto it = std::find(choices.begin(), choices.end(), param->strings[0]);
  if (it == choices.end() && unknown != nullptr) {
    Warn(*param, fmt::format("unknown value {}; {} is used, as in pbrt-v4",
                             Quoted(param->strings[0]), Quoted(unknown)));
    it = std::find(choices.begin(), choices.end(), unknown);
  }
  if (it == choices.end()) {
    ThrowUnknown(param->where,
                 fmt::format("value of \"string {}\" of {}:", name, object_),
                 param->strings[0], choices);
  }
  return static_cast<std::size_t>(it - choices.begin());
}

void ParamSet::Ignore(std::string_view name, const std::string& why, bool changes_image) {
  const Param* param = Find(name, {});
  if (param == nullptr) return;
  const bool is_set = param->type != ParamType::kBool || param->bools[0];
  if (changes_image && !is_set) return;
  notes_->push_back(
      {param->where,
       fmt::format("parameter {} of {} has no effect: {}", Quoted(name), object_, why),
       changes_image});
}

void ParamSet::CheckAllUsed() {
  for (std::size_t i = 0; i < own_.size(); ++i) {
    if (used_[i]) continue;
    if (legal_typed_.empty()) {
      throw InputError(own_[i].where,
                       "unknown parameter {} of {}, which takes no parameters",
                       Quoted(own_[i].name), object_);
    }
    const std::string nearest = NearestName(own_[i].name, legal_);
    const std::string hint =
        nearest.empty() ? "" : fmt::format("did you mean {}? ", Quoted(nearest));
    std::sort(legal_typed_.begin(), legal_typed_.end());
    throw InputError(own_[i].where, "unknown parameter {} of {}; {}supported: {}",
                     Quoted(own_[i].name), object_, hint, QuotedList(legal_typed_));
  }
}

}  // namespace lanelight
