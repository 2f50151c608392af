// Shared parts of the readers of EXR files.
#pragma once

#include <ImfHeader.h>
#include <ImfIO.h>

#include <map>
#include <stdexcept>
#include <string>

#include "src/base/image/image.h"

namespace lanelight {

/// A reason, to which WithExr() adds the path.
struct DamagedExr : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// An EXR file in memory, which separates errors of the system from those of the format.
class ExrMemoryInput : public Imf::IStream {
 public:
  ExrMemoryInput(const std::string& path, const std::string& content)
      : Imf::IStream(path.c_str()), content_(content) {}

  bool read(char c[], int n) override;
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t to) override;

 private:
  const std::string& content_;
  std::size_t at_ = 0;
};

/// Returns the attributes of strings and numbers.
std::map<std::string, ImageAttribute> ExrAttributes(const Imf::Header& header);

/// The best compression of OpenEXR stores fewer samples than this per byte of file.
inline constexpr std::size_t kMaxExrSamplesPerByte = 4096;

/// Throws DamagedExr if the headers of an EXR file claim more than the file can hold:
/// attributes, and with `reads_pixels` the data window and tiles. OpenEXR takes the
/// memory for all of these before it reads them.
void CheckExrMemory(const std::string& content, bool reads_pixels);

/// Returns the cause of an error in plain words.
std::string ExrProblem(const std::exception& error, const std::string& content);

}  // namespace lanelight
