// The columns of films, copied away and back, for tests.
#pragma once

#include <catch2/catch.hpp>
#include <cstring>
#include <string>
#include <vector>

#include "src/render/wave/films.h"

namespace lanelight {

struct ColumnCopy {
  std::string name;
  std::vector<char> bytes;

  bool operator==(const ColumnCopy&) const = default;
};

/// Returns all columns, those that tiles share too.
inline std::vector<MutableStateColumn> AllColumns(Films& films) {
  std::vector<MutableStateColumn> columns = films.Columns();
  for (const MutableStateColumn& shared : films.film().SharedColumns()) {
    columns.push_back(shared);
  }
  return columns;
}

inline std::vector<ColumnCopy> CopyColumns(Films& films) {
  std::vector<ColumnCopy> kept;
  for (const MutableStateColumn& column : AllColumns(films)) {
    ColumnCopy copy{column.name, std::vector<char>(column.rows * column.RowBytes())};
    std::memcpy(copy.bytes.data(), column.data, copy.bytes.size());
    kept.push_back(std::move(copy));
  }
  return kept;
}

/// Into films of the same kind.
inline void PutColumns(const std::vector<ColumnCopy>& kept, Films& films) {
  const std::vector<MutableStateColumn> columns = AllColumns(films);
  REQUIRE(columns.size() == kept.size());
  for (std::size_t i = 0; i < kept.size(); ++i) {
    REQUIRE(columns[i].name == kept[i].name);
    REQUIRE(columns[i].rows * columns[i].RowBytes() == kept[i].bytes.size());
    std::memcpy(columns[i].data, kept[i].bytes.data(), kept[i].bytes.size());
  }
}

}  // namespace lanelight
