#include <algorithm>
#include <set>

#include "src/core/parallel.h"
#include "src/image/atomic_file.h"
#include "src/state/chunk_codec.h"
#include "src/state/chunk_grid.h"
#include "src/state/memory_file.h"
#include "src/state/seal.h"
#include "src/state/state_file.h"

namespace lanelight {
namespace {

constexpr std::size_t kChunksPerThread = 16;  // compressed at a time

// A dataset that is being written; tiles is null for tables.
struct Target {
  const StateColumn& column;
  const TileRows* tiles;
  ChunkGrid grid;
  hdf5::Handle dataset;
};

// One chunk of one of them.
struct Task {
  const Target* target;
  std::size_t chunk;
};

void CheckColumns(const std::vector<StateColumn>& columns) {
  std::set<std::string> names;
  for (const StateColumn& c : columns) {
    LL_CHECK(!c.name.empty());
    LL_CHECK_EQ(c.name.find_first_of("/."), std::string::npos);
    LL_CHECK(names.insert(c.name).second);
    LL_CHECK_GT(c.RowBytes(), 0u);
    LL_CHECK(c.rows == 0 || c.data != nullptr);
  }
}

void CheckContent(const StateContent& content) {
  LL_CHECK_EQ(TileProblem(content.tiles, content.window), "");
  CheckColumns(content.pixels);
  CheckColumns(content.tables);
  for (const StateColumn& c : content.pixels) {
    LL_CHECK_EQ(c.rows, content.window.pixels());
  }
}

hdf5::Handle ColumnProperties(const ChunkGrid& grid) {
  hdf5::Handle properties = hdf5::NewProperties(H5P_DATASET_CREATE);
  if (grid.chunks() == 0) return properties;
  const std::vector<hsize_t> chunk(grid.chunk().begin(), grid.chunk().end());
  hdf5::Check(
      H5Pset_chunk(properties.get(), static_cast<int>(chunk.size()), chunk.data()),
      "chunks");
  hdf5::Check(H5Pset_shuffle(properties.get()), "the filter shuffle");
  hdf5::Check(H5Pset_deflate(properties.get(), 1), "the filter deflate");
  hdf5::Check(H5Pset_fill_time(properties.get(), H5D_FILL_TIME_NEVER), "no filling");
  return properties;
}

Target NewTarget(hid_t group, const StateColumn& column, const TileRows* tiles) {
  const std::size_t rows = tiles != nullptr ? tiles->size() : column.rows;
  ChunkGrid grid = ChunkGrid::Choose(column.type, column.shape, rows);
  std::vector<hsize_t> dims = {rows};
  dims.insert(dims.end(), column.shape.begin(), column.shape.end());
  hdf5::Handle dataset =
      hdf5::NewDataset(group, column.name, column.meaning, hdf5::TypeInFile(column.type),
                       dims, ColumnProperties(grid));
  return {column, tiles, std::move(grid), std::move(dataset)};
}

void WriteChunk(const Task& task, const std::vector<unsigned char>& bytes) {
  const std::vector<std::size_t> position = task.target->grid.Offset(task.chunk);
  const std::vector<hsize_t> offset(position.begin(), position.end());
  hdf5::Check(H5Dwrite_chunk(task.target->dataset.get(), H5P_DEFAULT, 0, offset.data(),
                             bytes.size(), bytes.data()),
              task.target->column.name);
}

// What a thread needs for a chunk.
struct Worker {
  ChunkEncoder encoder;
  std::vector<char> values;

  void Encode(const Task& task, std::vector<unsigned char>& out) {
    const ChunkGrid& grid = task.target->grid;
    values.resize(grid.chunk_bytes());
    grid.Gather(task.chunk, task.target->tiles, task.target->column.data, values.data());
    encoder.Encode(values.data(), grid.value_bytes(),
                   grid.chunk_bytes() / grid.value_bytes(), out);
  }
};

// HDF5 takes the chunks of a batch one by one, after all threads have compressed them.
void WriteChunks(const std::vector<Task>& tasks) {
  const std::size_t threads = static_cast<std::size_t>(MaxThreads());
  std::vector<Worker> workers(threads);
  std::vector<std::vector<unsigned char>> chunks(
      std::min(tasks.size(), kChunksPerThread * threads));
  for (std::size_t begin = 0; begin < tasks.size(); begin += chunks.size()) {
    const std::size_t n = std::min(chunks.size(), tasks.size() - begin);
    ParallelFor(n, [&](std::size_t i) {
      workers[static_cast<std::size_t>(ThreadIndex())].Encode(tasks[begin + i],
                                                              chunks[i]);
    });
    for (std::size_t i = 0; i < n; ++i) WriteChunk(tasks[begin + i], chunks[i]);
  }
}

void WriteColumns(hid_t file, const StateContent& content) {
  const TileRows tiles(content.tiles, content.window);
  const hdf5::Handle pixels = hdf5::NewGroup(file, "pixels"),
                     tables = hdf5::NewGroup(file, "tables");
  std::vector<Target> targets;
  for (const StateColumn& c : content.pixels) {
    targets.push_back(NewTarget(pixels.get(), c, &tiles));
  }
  for (const StateColumn& c : content.tables) {
    targets.push_back(NewTarget(tables.get(), c, nullptr));
  }
  std::vector<Task> tasks;
  for (const Target& target : targets) {
    for (std::size_t i = 0; i < target.grid.chunks(); ++i) tasks.push_back({&target, i});
  }
  WriteChunks(tasks);
}

std::vector<std::int32_t> Numbers(const std::vector<PixelRect>& rects) {
  std::vector<std::int32_t> numbers;
  for (const PixelRect& r : rects)
    numbers.insert(numbers.end(), {r.x0, r.y0, r.x1, r.y1});
  return numbers;
}

void WriteContent(hid_t file, const StateContent& content) {
  hdf5::SetText(file, "meaning", "the state of a render by lanelight");
  hdf5::SetNumber(file, "schema", kStateSchema);
  hdf5::WriteText(file, {"identity", "the run that this is a state of (JSON)"},
                  content.identity);
  hdf5::WriteText(file, {"report", "what the run has done so far (JSON)"},
                  content.report);
  hdf5::WriteFours(file,
                   {"window", "the film: pixels [x0, x1) x [y0, y1), as x0 y0 x1 y1"},
                   Numbers({content.window}));
  hdf5::WriteFours(file,
                   {"tiles",
                    "tiles whose pixels are in /pixels, one after the other, row by row: "
                    "x0 y0 x1 y1"},
                   Numbers(content.tiles));
  WriteColumns(file, content);
}

}  // namespace

class SerialisedState::Bytes : public MemoryFile {};

SerialisedState::SerialisedState(std::unique_ptr<Bytes> bytes)
    : bytes_(std::move(bytes)) {}
SerialisedState::SerialisedState(SerialisedState&&) noexcept = default;
SerialisedState& SerialisedState::operator=(SerialisedState&&) noexcept = default;
SerialisedState::~SerialisedState() = default;

std::string_view SerialisedState::bytes() const { return bytes_->bytes(); }

void SerialisedState::Write(const std::string& path) const {
  WriteFileAtomically(path, bytes());
}

SerialisedState SerialiseState(const StateContent& content) {
  CheckContent(content);
  const hdf5::Quiet quiet;
  auto bytes = std::make_unique<SerialisedState::Bytes>();
  try {
    hdf5::Handle file = bytes->Create(kSealBytes);
    WriteContent(file.get(), content);
    bytes->Finish(std::move(file), kSealBytes);
  } catch (const hdf5::Failure& failure) {
    throw CheckFailure(fmt::format("HDF5 cannot make a state: {}", failure.what()));
  }
  Seal(bytes->data(), bytes->bytes().size(), kStateSchema);
  return SerialisedState(std::move(bytes));
}

}  // namespace lanelight
