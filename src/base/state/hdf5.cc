#include "src/base/state/hdf5.h"

#include <fmt/format.h>

#include <algorithm>

namespace lanelight::hdf5 {
namespace {

// Text type of a fixed length, at least 1.
Handle TextType(const std::string& text) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "a type of text");
  Check(H5Tset_size(type.get(), std::max<std::size_t>(1, text.size())), "its length");
  Check(H5Tset_strpad(type.get(), H5T_STR_NULLPAD), "its padding");
  Check(H5Tset_cset(type.get(), H5T_CSET_UTF8), "its encoding");
  return type;
}

const char* DataOf(const std::string& text) { return text.empty() ? "\0" : text.data(); }

}  // namespace

void Fail(const std::string& what) {
  std::string reason;
  // The first error is the innermost.
  H5Ewalk2(
      H5E_DEFAULT, H5E_WALK_UPWARD,
      [](unsigned, const H5E_error2_t* error, void* text) -> herr_t {
        if (error->desc != nullptr) *static_cast<std::string*>(text) = error->desc;
        return 1;
      },
      &reason);
  throw Failure(reason.empty() ? what : fmt::format("{}: {}", what, reason));
}

Session::Session() {
  static std::mutex alone;
  lock_ = std::unique_lock(alone);
  H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}
Session::~Session() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }

hid_t TypeInFile(StateType type) {
  const hid_t types[] = {H5T_IEEE_F32LE, H5T_IEEE_F64LE, H5T_STD_U32LE, H5T_STD_U64LE,
                         H5T_STD_I32LE};  // in the order of StateType
  return types[static_cast<int>(type)];
}

Handle NewProperties(hid_t kind) {
  return Handle(H5Pcreate(kind), H5Pclose, "properties");
}

Handle NewSpace(const std::vector<hsize_t>& dims) {
  return Handle(dims.empty() ? H5Screate(H5S_SCALAR)
                             : H5Screate_simple(static_cast<int>(dims.size()),
                                                dims.data(), nullptr),
                H5Sclose, "a data space");
}

Handle NewGroup(hid_t parent, const char* name) {
  return Handle(H5Gcreate2(parent, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose,
                name);
}

bool Has(hid_t parent, const std::string& name) {
  return Check(H5Lexists(parent, name.c_str(), H5P_DEFAULT), name) > 0;
}

void SetNumber(hid_t object, const char* name, std::uint64_t number) {
  const Handle space = NewSpace({});
  const Handle attribute(
      H5Acreate2(object, name, H5T_STD_U64LE, space.get(), H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose, name);
  Check(H5Awrite(attribute.get(), H5T_NATIVE_UINT64, &number), name);
}

Handle NewDataset(hid_t parent, const Title& title, hid_t type,
                  const std::vector<hsize_t>& dims, const Handle& properties) {
  const Handle space = NewSpace(dims);
  Check(H5Pset_obj_track_times(properties.get(), false), "no times");
  Handle dataset(H5Dcreate2(parent, title.name.c_str(), type, space.get(), H5P_DEFAULT,
                            properties.get(), H5P_DEFAULT),
                 H5Dclose, title.name);
  SetText(dataset.get(), "meaning", title.meaning);
  return dataset;
}

Handle OpenDataset(hid_t parent, const std::string& name) {
  return Handle(H5Dopen2(parent, name.c_str(), H5P_DEFAULT), H5Dclose, name);
}

std::vector<hsize_t> DimsOf(const Handle& dataset) {
  const Handle space(H5Dget_space(dataset.get()), H5Sclose, "a data space");
  const int n = Check(H5Sget_simple_extent_ndims(space.get()), "dimensions");
  std::vector<hsize_t> dims(static_cast<std::size_t>(n));
  Check(H5Sget_simple_extent_dims(space.get(), dims.data(), nullptr), "dimensions");
  return dims;
}

void CheckStored(const Handle& dataset, const std::string& name, double bytes) {
  constexpr double kMaxExpansion = 1032;  // by deflate
  const auto stored = static_cast<double>(H5Dget_storage_size(dataset.get()));
  if (bytes <= kMaxExpansion * stored) return;
  throw Failure(
      fmt::format("{} should have {:.0f} bytes, but the file stores only {:.0f}", name,
                  bytes, stored));
}

void SetText(hid_t object, const char* name, const std::string& text) {
  const Handle type = TextType(text), space = NewSpace({});
  const Handle attribute(
      H5Acreate2(object, name, type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose, name);
  Check(H5Awrite(attribute.get(), type.get(), DataOf(text)), name);
}

void WriteText(hid_t parent, const Title& title, const std::string& text) {
  const Handle type = TextType(text);
  const Handle dataset =
      NewDataset(parent, title, type.get(), {}, NewProperties(H5P_DATASET_CREATE));
  Check(H5Dwrite(dataset.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, DataOf(text)),
        title.name);
}

std::string ReadText(hid_t parent, const char* name) {
  const Handle dataset = OpenDataset(parent, name);
  const Handle type(H5Dget_type(dataset.get()), H5Tclose, name);
  const bool fixed = Check(H5Tget_class(type.get()), name) == H5T_STRING &&
                     Check(H5Tis_variable_str(type.get()), name) == 0;
  if (!fixed || !DimsOf(dataset).empty()) {
    throw Failure(fmt::format("{} is not a single string", name));
  }
  const std::size_t size = H5Tget_size(type.get());
  CheckStored(dataset, name, static_cast<double>(size));
  std::string text(size, '\0');
  Check(H5Dread(dataset.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()),
        name);
  if (text == std::string(1, '\0')) text.clear();
  return text;
}

}  // namespace lanelight::hdf5
