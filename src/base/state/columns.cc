#include "src/base/state/columns.h"

#include <algorithm>
#include <cstring>

namespace lanelight {
namespace {

constexpr std::size_t kChunkBytes = 256 << 10;  // stays in the second cache, also thrice
constexpr unsigned kFastest = 1;                // of deflate

constexpr StateType kTypes[] = {StateType::kFloat32, StateType::kFloat64,
                                StateType::kUint32, StateType::kUint64,
                                StateType::kInt32};

std::vector<hsize_t> DimsInFile(std::size_t rows, const std::vector<std::size_t>& shape) {
  std::vector<hsize_t> dims = {rows};
  dims.insert(dims.end(), shape.begin(), shape.end());
  return dims;
}

// Chunks of about kChunkBytes hold some rows. Rows of several dimensions, {4, 3}, are
// split into parts of the last one, {1, 3}, so that each chunk holds one quantity.
hdf5::Handle Compressed(const StateColumn& column, const std::vector<hsize_t>& dims) {
  hdf5::Handle properties = hdf5::NewProperties(H5P_DATASET_CREATE);
  std::vector<hsize_t> chunk(dims.size(), 1);
  if (dims.size() > 1) chunk.back() = dims.back();
  const std::size_t row = chunk.back() * SizeOf(column.type);
  const hsize_t blocks = (dims[0] * row + kChunkBytes - 1) / kChunkBytes;
  chunk[0] = (dims[0] + blocks - 1) / blocks;
  const int rank = static_cast<int>(chunk.size());
  hdf5::Check(H5Pset_chunk(properties.get(), rank, chunk.data()), "chunks");
  hdf5::Check(H5Pset_shuffle(properties.get()), "the filter shuffle");
  hdf5::Check(H5Pset_deflate(properties.get(), kFastest), "the filter deflate");
  return properties;
}

// Rows of a dataset that are written or read at a time.
struct Block {
  hsize_t begin, rows;
  hdf5::Handle in_memory, in_file;  // data spaces
};

// Rows per chunk; all rows for a dataset without chunks.
hsize_t RowsOfChunk(const hdf5::Handle& dataset, const std::vector<hsize_t>& dims) {
  const hdf5::Handle properties(H5Dget_create_plist(dataset.get()), H5Pclose, "chunks");
  std::vector<hsize_t> chunk = dims;
  if (H5Pget_layout(properties.get()) == H5D_CHUNKED) {
    hdf5::Check(
        H5Pget_chunk(properties.get(), static_cast<int>(chunk.size()), chunk.data()),
        "chunks");
  }
  return chunk[0];
}

// Calls move(block) for blocks of whole chunks, so that each is filtered once.
template <class Move>
void ForBlocks(const hdf5::Handle& dataset, const Move& move) {
  const std::vector<hsize_t> dims = hdf5::DimsOf(dataset);
  const hsize_t step = RowsOfChunk(dataset, dims);
  std::vector<hsize_t> start(dims.size(), 0), count = dims;
  for (hsize_t begin = 0; begin < dims[0]; begin += step) {
    start[0] = begin;
    count[0] = std::min(step, dims[0] - begin);
    const Block block = {
        begin, count[0], hdf5::NewSpace(count),
        hdf5::Handle(H5Dget_space(dataset.get()), H5Sclose, "a data space")};
    hdf5::Check(H5Sselect_hyperslab(block.in_file.get(), H5S_SELECT_SET, start.data(),
                                    nullptr, count.data(), nullptr),
                "rows");
    move(block);
  }
}

// Calls copy(row of the column, row of the block, rows) for rows that follow each other
// in both.
template <class Copy>
void ForRuns(const Block& block, const TileRows* tiles, const Copy& copy) {
  const std::size_t end = block.begin + block.rows;
  for (std::size_t row = block.begin; row < end;) {
    const TileRows::Run run =
        tiles != nullptr ? tiles->At(row, end - row) : TileRows::Run{row, row, end - row};
    copy(run.film, row - block.begin, run.count);
    row += run.count;
  }
}

void ReadRows(const hdf5::Handle& dataset, const MutableStateColumn& column,
              const TileRows* tiles) {
  const std::size_t size = column.RowBytes();
  std::vector<char> values;
  ForBlocks(dataset, [&](const Block& block) {
    values.resize(block.rows * size);
    hdf5::Check(
        H5Dread(dataset.get(), hdf5::TypeInFile(column.type), block.in_memory.get(),
                block.in_file.get(), H5P_DEFAULT, values.data()),
        column.name);
    ForRuns(block, tiles, [&](std::size_t to, std::size_t from, std::size_t count) {
      std::memcpy(static_cast<char*>(column.data) + to * size, &values[from * size],
                  count * size);
    });
  });
}

std::string PathOf(const std::string& group, const std::string& name) {
  return group.empty() ? name : group + "/" + name;
}

std::string Describe(const std::string& group, const std::string& name) {
  return group.empty() ? name : fmt::format("{} \"{}\"", group, name);
}

hdf5::Handle OpenColumn(hid_t file, const std::string& group, const std::string& name) {
  if (!HasColumn(file, group, name)) {
    throw hdf5::Failure(fmt::format("the state has no {}", Describe(group, name)));
  }
  return hdf5::OpenDataset(file, PathOf(group, name));
}

std::string TypeName(const hdf5::Handle& dataset) {
  const hdf5::Handle type(H5Dget_type(dataset.get()), H5Tclose, "a type");
  for (StateType t : kTypes) {
    if (hdf5::Check(H5Tequal(type.get(), hdf5::TypeInFile(t)), "a type") > 0)
      return Name(t);
  }
  return "another type";
}

std::string Layout(const std::string& type, const std::vector<hsize_t>& dims) {
  return fmt::format("{} [{}]", type, fmt::join(dims, " x "));
}

}  // namespace

void WriteColumn(hid_t group, const StateColumn& column, const TileRows* tiles,
                 bool compress) {
  const std::size_t rows = tiles != nullptr ? tiles->size() : column.rows;
  const std::size_t size = column.RowBytes();
  const std::vector<hsize_t> dims = DimsInFile(rows, column.shape);
  const hid_t type = hdf5::TypeInFile(column.type);
  const hdf5::Handle dataset =
      hdf5::NewDataset(group, {column.name, column.meaning}, type, dims,
                       compress && rows > 0 ? Compressed(column, dims)
                                            : hdf5::NewProperties(H5P_DATASET_CREATE));
  std::vector<char> values;
  ForBlocks(dataset, [&](const Block& block) {
    values.resize(block.rows * size);
    ForRuns(block, tiles, [&](std::size_t from, std::size_t to, std::size_t count) {
      std::memcpy(&values[to * size], static_cast<const char*>(column.data) + from * size,
                  count * size);
    });
    hdf5::Check(H5Dwrite(dataset.get(), type, block.in_memory.get(), block.in_file.get(),
                         H5P_DEFAULT, values.data()),
                column.name);
  });
}

bool HasColumn(hid_t file, const std::string& group, const std::string& name) {
  return (group.empty() || hdf5::Has(file, group)) && !name.empty() &&
         hdf5::Has(file, PathOf(group, name));
}

std::size_t ColumnRows(hid_t file, const std::string& group, const std::string& name) {
  const hdf5::Handle dataset = OpenColumn(file, group, name);
  const std::vector<hsize_t> dims = hdf5::DimsOf(dataset);
  if (dims.empty()) {
    throw hdf5::Failure(fmt::format("the state's {} has no rows", Describe(group, name)));
  }
  const hdf5::Handle type(H5Dget_type(dataset.get()), H5Tclose, "a type");
  hdf5::CheckStored(
      dataset, Describe(group, name),
      static_cast<double>(dims[0]) * static_cast<double>(H5Tget_size(type.get())));
  return dims[0];
}

void ReadColumns(hid_t file, const std::string& group,
                 const std::vector<MutableStateColumn>& into, const TileRows* tiles) {
  std::vector<hdf5::Handle> datasets;
  for (const MutableStateColumn& column : into) {
    datasets.push_back(OpenColumn(file, group, column.name));
    const std::size_t rows = tiles != nullptr ? tiles->size() : column.rows;
    const std::string has = Layout(TypeName(datasets.back()),
                                   hdf5::DimsOf(datasets.back())),
                      expected =
                          Layout(Name(column.type), DimsInFile(rows, column.shape));
    if (has == expected) continue;
    throw hdf5::Failure(fmt::format("the state's {} is {}; this render has {}",
                                    Describe(group, column.name), has, expected));
  }
  for (std::size_t i = 0; i < into.size(); ++i) ReadRows(datasets[i], into[i], tiles);
}

}  // namespace lanelight
