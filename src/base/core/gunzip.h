// Compressed files (gzip, RFC 1952) to the bytes that they hold.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace lanelight {

/// True for content that begins like gzip data, and for files named .gz whatever they
/// hold.
bool IsGzip(std::string_view path, std::string_view content);

/// Returns the maximum number of bytes that a file of `packed` bytes may unpack to: 100
/// times its size, at least 256 MiB, at most 4 GiB. A small hostile file cannot fill the
/// memory.
std::size_t MaxUnpackedSize(std::size_t packed);

/// Returns what the gzip members in `packed` hold, one after the other. Throws InputError
/// without a place: no gzip data, truncated, a wrong checksum, more than `max_size`
/// bytes.
std::string Gunzip(std::string_view packed, std::size_t max_size);

}  // namespace lanelight
