// What we use of HDF5, with exceptions. For files of this folder that include <hdf5.h>.
#pragma once

#include <hdf5.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "src/core/column.h"

namespace lanelight::hdf5 {

/// What HDF5 could not do, and why.
class Failure : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

[[noreturn]] void Fail(const std::string& what);

/// `value`, unless it is negative, as HDF5 says that something failed: what was tried.
template <class T>
T Check(T value, const std::string& what) {
  if (value < 0) Fail(what);
  return value;
}

/// An identifier of HDF5, closed in the end.
class Handle {
 public:
  using Closer = herr_t (*)(hid_t);
  Handle(hid_t id, Closer close, const std::string& what)
      : id_(Check(id, what)), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(Handle&& other) noexcept
      : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&&) = delete;
  hid_t get() const { return id_; }
  /// Closes it now and says if that fails.
  void Close(const std::string& what) { Check(close_(std::exchange(id_, -1)), what); }

 private:
  hid_t id_;
  Closer close_;
};

/// While it lives HDF5 prints nothing when something fails in this thread.
class Quiet {
 public:
  Quiet();
  ~Quiet();
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

/// The little-endian type of the file; HDF5's own, never to be closed.
hid_t TypeInFile(StateType type);

Handle NewProperties(hid_t kind);
Handle NewSpace(const std::vector<hsize_t>& dims);  // none: one value
Handle NewGroup(hid_t parent, const char* name);
bool Has(hid_t parent, const std::string& name);

/// Attributes.
void SetText(hid_t object, const char* name, const std::string& text);
void SetNumber(hid_t object, const char* name, std::uint64_t number);

/// `dims`: none for a single value; `properties` of H5P_DATASET_CREATE. The same datasets
/// give the same bytes at any time.
Handle NewDataset(hid_t parent, const std::string& name, const std::string& meaning,
                  hid_t type, const std::vector<hsize_t>& dims, const Handle& properties);
Handle OpenDataset(hid_t parent, const std::string& name);
std::vector<hsize_t> DimsOf(const Handle& dataset);

/// What a dataset is called, and its attribute "meaning".
struct Title {
  const char *name, *meaning;
};
/// Datasets of one text, UTF-8.
void WriteText(hid_t parent, const Title& title, const std::string& text);
std::string ReadText(hid_t parent, const char* name);
/// Datasets of whole numbers, four in a row.
void WriteFours(hid_t parent, const Title& title,
                const std::vector<std::int32_t>& values);
std::vector<std::int32_t> ReadFours(hid_t parent, const char* name);

}  // namespace lanelight::hdf5
