// Wrapper of HDF5 with exceptions, for this folder alone.
#pragma once

#include <hdf5.h>

#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "src/base/core/column.h"

namespace lanelight::hdf5 {

class Failure : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

[[noreturn]] void Fail(const std::string& what);

/// Returns `value`; a negative one throws Failure, with `what` for the failed action.
template <class T>
T Check(T value, const std::string& what) {
  if (value < 0) Fail(what);
  return value;
}

/// Owns an identifier of HDF5.
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

 private:
  hid_t id_;
  Closer close_;
};

/// Locks HDF5 for this thread while it lives, since not every build of it is thread-safe,
/// and keeps it from printing errors. Sessions of a thread do not nest.
class Session {
 public:
  Session();
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

 private:
  std::unique_lock<std::mutex> lock_;
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

/// The little-endian type of the file; HDF5's own, never to be closed.
hid_t TypeInFile(StateType type);

Handle NewProperties(hid_t kind);
Handle NewSpace(const std::vector<hsize_t>& dims);  // none: one value
Handle NewGroup(hid_t parent, const char* name);
bool Has(hid_t parent, const std::string& name);

/// An attribute of one number.
void SetNumber(hid_t object, const char* name, std::uint64_t number);

/// What a dataset is called, and its attribute "meaning".
struct Title {
  std::string name, meaning;
};
/// `dims`: none for a single value; `properties` of H5P_DATASET_CREATE. The same datasets
/// give the same bytes at any time.
Handle NewDataset(hid_t parent, const Title& title, hid_t type,
                  const std::vector<hsize_t>& dims, const Handle& properties);
Handle OpenDataset(hid_t parent, const std::string& name);
std::vector<hsize_t> DimsOf(const Handle& dataset);

/// Throws Failure if what a dataset stores cannot become so many bytes. A file may claim
/// any size without content.
void CheckStored(const Handle& dataset, const std::string& name, double bytes);

/// Texts, UTF-8: attributes, and datasets of one text each.
void SetText(hid_t object, const char* name, const std::string& text);
void WriteText(hid_t parent, const Title& title, const std::string& text);
std::string ReadText(hid_t parent, const char* name);

}  // namespace lanelight::hdf5
