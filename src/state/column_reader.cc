#include "src/state/column_reader.h"

#include <algorithm>
#include <atomic>

#include "src/core/parallel.h"
#include "src/state/chunk_codec.h"
#include "src/state/chunk_grid.h"

namespace lanelight {
namespace {

constexpr std::size_t kReadPerThread = 8;  // read at a time

constexpr StateType kTypes[] = {StateType::kFloat32, StateType::kFloat64,
                                StateType::kUint32, StateType::kUint64,
                                StateType::kInt32};

// A dataset that is being read.
struct Source {
  const MutableStateColumn& column;
  ChunkGrid grid;
  hdf5::Handle dataset;
};

// One chunk of one of them.
struct ReadTask {
  const Source* source;
  std::size_t chunk;
};

hdf5::Handle OpenColumn(hid_t file, const std::string& group, const std::string& name) {
  if (!HasColumn(file, group, name)) {
    throw hdf5::Failure(fmt::format("the state has no {} \"{}\"", group, name));
  }
  return hdf5::OpenDataset(file, group + "/" + name);
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

void CheckLayout(const hdf5::Handle& dataset, const std::string& what, std::size_t rows,
                 const MutableStateColumn& column) {
  std::vector<hsize_t> wanted = {rows};
  wanted.insert(wanted.end(), column.shape.begin(), column.shape.end());
  const std::string has = Layout(TypeName(dataset), hdf5::DimsOf(dataset)),
                    wants = Layout(Name(column.type), wanted);
  if (has == wants) return;
  throw hdf5::Failure(
      fmt::format("the state's {} is {}; this render has {}", what, has, wants));
}

// Chunks that went through shuffle and deflate, and nothing else.
bool HasOurFilters(const hdf5::Handle& properties) {
  if (H5Pget_nfilters(properties.get()) != 2) return false;
  const H5Z_filter_t wanted[] = {H5Z_FILTER_SHUFFLE, H5Z_FILTER_DEFLATE};
  for (unsigned i = 0; i < 2; ++i) {
    std::size_t numbers = 0;
    unsigned flags = 0;
    if (H5Pget_filter2(properties.get(), i, &flags, &numbers, nullptr, 0, nullptr,
                       nullptr) != wanted[i]) {
      return false;
    }
  }
  return true;
}

ChunkGrid GridOf(const hdf5::Handle& dataset, const std::string& what, std::size_t rows,
                 const MutableStateColumn& column) {
  if (rows == 0) return ChunkGrid::Choose(column.type, column.shape, 0);
  const hdf5::Handle properties(H5Dget_create_plist(dataset.get()), H5Pclose, what);
  std::vector<hsize_t> chunk(column.shape.size() + 1);
  if (H5Pget_layout(properties.get()) == H5D_CHUNKED && HasOurFilters(properties)) {
    hdf5::Check(
        H5Pget_chunk(properties.get(), static_cast<int>(chunk.size()), chunk.data()),
        what);
    auto grid =
        ChunkGrid::Of(column.type, column.shape, rows, {chunk.begin(), chunk.end()});
    if (grid) return *grid;
  }
  throw hdf5::Failure(fmt::format("the state's {} is not chunked as states are", what));
}

Source OpenSource(hid_t file, const std::string& group, const MutableStateColumn& column,
                  const TileRows* tiles) {
  const std::string what = fmt::format("{} \"{}\"", group, column.name);
  hdf5::Handle dataset = OpenColumn(file, group, column.name);
  const std::size_t rows = tiles != nullptr ? tiles->size() : column.rows;
  CheckLayout(dataset, what, rows, column);
  ChunkGrid grid = GridOf(dataset, what, rows, column);
  return {column, std::move(grid), std::move(dataset)};
}

void ReadChunk(const ReadTask& task, std::vector<unsigned char>& bytes) {
  const std::string& name = task.source->column.name;
  const hid_t dataset = task.source->dataset.get();
  const std::vector<std::size_t> position = task.source->grid.Offset(task.chunk);
  const std::vector<hsize_t> offset(position.begin(), position.end());
  hsize_t size = 0;
  hdf5::Check(H5Dget_chunk_storage_size(dataset, offset.data(), &size), name);
  bytes.resize(size);
  std::uint32_t skipped_filters = 0;
  if (size > 0) {
    hdf5::Check(H5Dread_chunk(dataset, H5P_DEFAULT, offset.data(), &skipped_filters,
                              bytes.data()),
                name);
  }
  if (size == 0 || skipped_filters != 0) {
    throw hdf5::Failure(fmt::format("\"{}\" lacks a compressed chunk", name));
  }
}

// What a thread needs for a chunk.
struct ReadWorker {
  ChunkDecoder decoder;
  std::vector<char> values;

  bool Decode(const ReadTask& task, const TileRows* tiles,
              const std::vector<unsigned char>& bytes) {
    const ChunkGrid& grid = task.source->grid;
    values.resize(grid.chunk_bytes());
    if (!decoder.Decode(bytes, grid.value_bytes(),
                        grid.chunk_bytes() / grid.value_bytes(), values.data())) {
      return false;
    }
    grid.Scatter(task.chunk, tiles, values.data(), task.source->column.data);
    return true;
  }
};

// HDF5 reads the chunks of a batch one by one, before all threads expand them.
void ReadChunks(const std::vector<ReadTask>& tasks, const TileRows* tiles) {
  const std::size_t threads = static_cast<std::size_t>(MaxThreads());
  std::vector<ReadWorker> workers(threads);
  std::vector<std::vector<unsigned char>> chunks(
      std::min(tasks.size(), kReadPerThread * threads));
  for (std::size_t begin = 0; begin < tasks.size(); begin += chunks.size()) {
    const std::size_t n = std::min(chunks.size(), tasks.size() - begin);
    for (std::size_t i = 0; i < n; ++i) ReadChunk(tasks[begin + i], chunks[i]);
    std::atomic<bool> complete{true};
    ParallelFor(n, [&](std::size_t i) {
      ReadWorker& worker = workers[static_cast<std::size_t>(ThreadIndex())];
      if (!worker.Decode(tasks[begin + i], tiles, chunks[i])) complete = false;
    });
    if (!complete) throw hdf5::Failure("a chunk does not expand");
  }
}

}  // namespace

bool HasColumn(hid_t file, const std::string& group, const std::string& name) {
  return hdf5::Has(file, group) && !name.empty() && hdf5::Has(file, group + "/" + name);
}

std::size_t ColumnRows(hid_t file, const std::string& group, const std::string& name) {
  const std::vector<hsize_t> dims = hdf5::DimsOf(OpenColumn(file, group, name));
  if (dims.empty()) {
    throw hdf5::Failure(fmt::format("the state's {} \"{}\" has no rows", group, name));
  }
  return dims[0];
}

void ReadColumns(hid_t file, const std::string& group,
                 const std::vector<MutableStateColumn>& into, const TileRows* tiles) {
  std::vector<Source> sources;
  for (const MutableStateColumn& column : into) {
    sources.push_back(OpenSource(file, group, column, tiles));
  }
  std::vector<ReadTask> tasks;
  for (const Source& source : sources) {
    for (std::size_t i = 0; i < source.grid.chunks(); ++i) tasks.push_back({&source, i});
  }
  ReadChunks(tasks, tiles);
}

}  // namespace lanelight
