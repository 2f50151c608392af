// Checks JSON against the part of JSON Schema that docs/*.schema.json use.
#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace lanelight::test {

inline bool HasJsonType(const nlohmann::json& value, const std::string& type) {
  if (type == "integer") return value.is_number_integer();
  if (type == "number") return value.is_number();
  return value.type_name() == type;
}

/// Appends a line for each place where `value` differs from `schema`, a part of `root`.
inline void FindSchemaErrors(const nlohmann::json& root, const nlohmann::json& schema,
                             const nlohmann::json& value, const std::string& place,
                             std::vector<std::string>& errors) {
  const auto fail = [&](const std::string& what) {
    errors.push_back(place + ": " + what + ": " + value.dump().substr(0, 100));
  };
  if (schema.contains("$ref")) {
    const std::string pointer = schema.at("$ref").get<std::string>().substr(1);
    const auto& part = root.at(nlohmann::json::json_pointer(pointer));
    return FindSchemaErrors(root, part, value, place, errors);
  }
  if (schema.contains("anyOf")) {
    const auto fits = [&](const nlohmann::json& choice) {
      std::vector<std::string> found;
      FindSchemaErrors(root, choice, value, place, found);
      return found.empty();
    };
    const auto& choices = schema.at("anyOf");
    if (std::none_of(choices.begin(), choices.end(), fits)) fail("no choice fits");
    return;
  }
  if (schema.contains("enum")) {
    const auto& values = schema.at("enum");
    if (std::find(values.begin(), values.end(), value) == values.end()) fail("value");
  }
  if (schema.contains("type")) {
    const auto& types = schema.at("type");
    const auto fits = [&](const nlohmann::json& type) {
      return HasJsonType(value, type.get<std::string>());
    };
    const bool good =
        types.is_string() ? fits(types) : std::any_of(types.begin(), types.end(), fits);
    if (!good) return fail("type");
  }
  if (value.is_number() && schema.contains("minimum") && value < schema.at("minimum")) {
    fail("below the minimum");
  }
  if (value.is_array() && schema.contains("items")) {
    for (std::size_t i = 0; i < value.size(); ++i) {
      FindSchemaErrors(root, schema.at("items"), value[i],
                       place + "/" + std::to_string(i), errors);
    }
  }
  if (!value.is_object() || !schema.contains("properties")) return;
  for (const auto& name : schema.value("required", nlohmann::json::array())) {
    if (!value.contains(name.get<std::string>())) fail("lacks " + name.dump());
  }
  for (const auto& [name, member] : value.items()) {
    if (schema.at("properties").contains(name)) {
      FindSchemaErrors(root, schema.at("properties").at(name), member, place + "/" + name,
                       errors);
    } else if (!schema.value("additionalProperties", true)) {
      fail("has an unknown member " + name);
    }
  }
}

/// Returns a line for each place where `value` differs from `schema`.
inline std::vector<std::string> SchemaErrors(const nlohmann::json& schema,
                                             const nlohmann::json& value) {
  std::vector<std::string> errors;
  FindSchemaErrors(schema, schema, value, "", errors);
  return errors;
}

}  // namespace lanelight::test
