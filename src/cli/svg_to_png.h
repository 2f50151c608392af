// SVG to PNG by the program of librsvg. As a library it would bring Cairo, Pango and GLib
// into every start of this program; one plot in a while does not pay for that.
#pragma once

#include <string>

namespace lanelight {

/// The bytes of a PNG with two pixels for one of the SVG. Throws InputError where
/// `rsvg-convert` is missing, with how to get it, or fails.
std::string SvgToPng(const std::string& svg);

}  // namespace lanelight
