// Reads values of a TOML file with their locations.
#pragma once

#include <memory>
#include <string>
#include <toml++/toml.h>
#include <vector>

#include "src/base/core/error.h"
#include "src/base/core/source_location.h"
#include "src/render/job/setting.h"

namespace lanelight {

/// A TOML file.
class TomlFile {
 public:
  /// Parses the text. Throws InputError if it is not TOML.
  TomlFile(const std::string& path, const std::string& text);

  const toml::table& root() const { return root_; }
  SourceLocation Where(const toml::source_region& region) const;
  SourceLocation Where(const toml::node& node) const { return Where(node.source()); }

  /// Returns the table. Throws InputError that names `key` for another type.
  const toml::table& Table(const std::string& key, const toml::node& node) const;
  /// Returns the tables of [[key]], at least one.
  std::vector<const toml::table*> Tables(const std::string& key,
                                         const toml::node& node) const;
  /// Returns the value as the text of a setting (src/render/job/setting.h).
  std::string Value(const std::string& key, ValueForm form, const toml::node& node) const;

 private:
  /// Returns the value; throws InputError that asks for `right` for another type.
  template <class T>
  const T& As(const std::string& key, const toml::node& node, const char* right) const {
    if (const auto* value = node.as<T>()) return value->get();
    Refuse(key, node, right);
  }
  std::string Window(const std::string& key, const toml::node& node) const;
  /// Returns a finite number; the file may have an integer.
  double Number(const std::string& key, const toml::node& node) const;
  [[noreturn]] void Refuse(const std::string& key, const toml::node& node,
                           const std::string& right) const;

  std::shared_ptr<const std::string> name_;
  toml::table root_;
};

}  // namespace lanelight
