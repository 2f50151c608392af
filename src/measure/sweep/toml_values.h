// Values of a TOML file, each with the place where it stands.
#pragma once

#include <memory>
#include <string>
#include <toml++/toml.h>
#include <vector>

#include "src/base/core/error.h"
#include "src/base/core/source_location.h"
#include "src/render/job/setting.h"

namespace lanelight {

/// A file while it is read.
class TomlFile {
 public:
  /// Throws InputError where the text is not TOML.
  TomlFile(const std::string& path, const std::string& text);

  const toml::table& root() const { return root_; }
  SourceLocation Where(const toml::source_region& region) const;
  SourceLocation Where(const toml::node& node) const { return Where(node.source()); }

  /// Throws InputError, naming `key`, unless the value is what the name says.
  const toml::table& Table(const std::string& key, const toml::node& node) const;
  /// Of [[key]]: at least one table.
  std::vector<const toml::table*> Tables(const std::string& key,
                                         const toml::node& node) const;
  /// The value as the text of a setting (src/render/job/setting.h).
  std::string Value(const std::string& key, ValueForm form, const toml::node& node) const;

 private:
  std::string Text(const std::string& key, const toml::node& node) const;
  bool Flag(const std::string& key, const toml::node& node) const;
  std::string Window(const std::string& key, const toml::node& node) const;
  std::int64_t Integer(const std::string& key, const toml::node& node) const;
  /// An integer will do. Finite.
  double Number(const std::string& key, const toml::node& node) const;
  [[noreturn]] void Refuse(const std::string& key, const toml::node& node,
                           const std::string& right) const;

  std::shared_ptr<const std::string> name_;
  toml::table root_;
};

}  // namespace lanelight
