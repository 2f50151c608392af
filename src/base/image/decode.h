// Decoders and encoders of single formats. Use ReadImage and WritePng.
//
// Each decoder's memory and time are bounded by the size of its file: a header that
// states more pixels than so many bytes can hold is refused before anything is allocated.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "src/base/image/image.h"

namespace lanelight {

/// Throws InputError if the size is not one of CheckImageSize, or if `bytes` cannot hold
/// so many pixels. `pixels_per_byte`: what the format packs into a byte at best.
void CheckImageFits(const std::string& path, long long width, long long height,
                    double pixels_per_byte, std::size_t bytes);

/// Names of 1 to 4 channels: Y, Y A, R G B, or R G B A.
std::vector<std::string> ChannelNames(int count);

/// The content decides which decoder is used. 16-bit samples become 8-bit ones.
/// InputError: damaged, truncated, not an image.
Image DecodeBytes(const std::string& path, const std::string& content);

/// Throws InputError for a JPEG that stb does not survive, or not soon: with a Huffman
/// table of more than 256 codes, or hundreds of scans, each of which goes over the image.
void CheckJpeg(const std::string& path, const std::string& content);

/// PNG by libpng. Every checksum must be right; a palette becomes R, G, B; a transparent
/// colour becomes A. gAMA and colour profiles are ignored, as in pbrt-v4.
Image DecodePng(const std::string& path, const std::string& content);

/// QOI ("Quite OK Image" format). Samples that the file calls linear become floats.
Image DecodeQoi(const std::string& path, const std::string& content);

/// Radiance HDR as float R, G, B.
Image ReadHdr(const std::string& path);

/// A PNG file of 8-bit RGB, rows from the top.
std::string EncodePng(int width, int height, const std::vector<std::uint8_t>& rgb);

}  // namespace lanelight
