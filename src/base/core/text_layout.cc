#include "src/base/core/text_layout.h"

#include <fmt/format.h>

#include <algorithm>

namespace lanelight {
namespace {

using Cells = std::vector<std::string>;

constexpr std::size_t kGap = 2;  // between columns

// End of the word at `begin`: before a space, or after a comma, so that lists of choices
// can be broken.
std::size_t WordEnd(std::string_view text, std::size_t begin) {
  for (std::size_t i = begin; i < text.size(); ++i) {
    if (text[i] == ' ') return i;
    const bool number = i + 1 < text.size() && text[i + 1] >= '0' && text[i + 1] <= '9';
    if (text[i] == ',' && !number) return i + 1;
  }
  return text.size();
}

// Splits the columns into tables that fit; returns the first column of each.
std::vector<std::size_t> Blocks(const std::vector<std::size_t>& widths,
                                const TableLayout& layout) {
  std::size_t keys = 0;
  for (std::size_t c = 0; c < layout.keys; ++c) keys += widths[c] + kGap;
  std::vector<std::size_t> first = {layout.keys};
  std::size_t used = keys;
  for (std::size_t c = layout.keys; c < widths.size(); ++c) {
    if (used + widths[c] > layout.width && c > first.back()) {
      first.push_back(c);
      used = keys;
    }
    used += widths[c] + kGap;
  }
  return first;
}

void AppendCell(const std::string& cell, std::size_t width, bool left, std::string& row) {
  const std::string fill(width - std::min(width, TextWidth(cell)), ' ');
  row += left ? cell + fill : fill + cell;
  row += std::string(kGap, ' ');
}

}  // namespace

std::size_t TextWidth(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

std::string Wrapped(std::string_view text, std::size_t width, std::size_t indent) {
  std::string out, line;
  bool first = true;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = WordEnd(text, begin);
    const std::string word(text.substr(begin, end - begin));
    const bool spaced = begin > 0 && text[begin - 1] == ' ';
    const std::size_t room = width - std::min(width, first ? indent : std::size_t{0});
    if (!line.empty() && TextWidth(line) + spaced + TextWidth(word) > room) {
      out += line + "\n";
      line = std::string(indent, ' ') + word;
      first = false;
    } else {
      line += (spaced && !line.empty() ? " " : "") + word;
    }
    begin = end < text.size() && text[end] == ' ' ? end + 1 : end;
  }
  return out + line;
}

std::string LabelledRow(const std::string& label, const std::string& text,
                        std::size_t width, std::size_t label_columns) {
  if (label.size() > label_columns && label_columns > 0) {
    // The end of the label counts as the first word.
    const std::size_t cut = label_columns - 1;
    return label.substr(0, cut) +
           Wrapped(label.substr(cut) + " " + text, width, label_columns + 1) + "\n";
  }
  const std::string row = label + std::string(label_columns - label.size(), ' ');
  return row + " " + Wrapped(text, width, label_columns + 1) + "\n";
}

std::string TextTable(const std::vector<Cells>& lines, const TableLayout& layout) {
  std::vector<std::size_t> widths(lines[0].size());
  for (const Cells& line : lines) {
    for (std::size_t c = 0; c < line.size(); ++c) {
      widths[c] = std::max(widths[c], TextWidth(line[c]));
    }
  }
  const std::vector<std::size_t> first = Blocks(widths, layout);
  std::string text;
  for (std::size_t b = 0; b < first.size(); ++b) {
    const std::size_t end = b + 1 < first.size() ? first[b + 1] : widths.size();
    if (b > 0) text += "\n";
    for (const Cells& line : lines) {
      std::string row;
      for (std::size_t c = 0; c < end; ++c) {
        if (c >= layout.keys && c < first[b]) continue;
        const bool left = c < layout.keys || c + layout.words >= widths.size();
        AppendCell(line[c], widths[c], left, row);
      }
      row.erase(row.find_last_not_of(' ') + 1);
      text += row + "\n";
    }
  }
  return text;
}

std::string ListText(const std::vector<std::string>& names, std::size_t max_names) {
  std::string text;
  const std::size_t shown = names.size() > max_names ? max_names : names.size();
  for (std::size_t i = 0; i < shown; ++i) {
    const bool last = i + 1 == names.size();
    text += (i == 0 ? "" : last ? " and " : ", ") + names[i];
  }
  if (names.size() > shown) text += fmt::format(" and {} more", names.size() - shown);
  return text;
}

std::string DurationText(double seconds) {
  if (!(seconds >= 0) || seconds > 1e9) return "unknown";
  if (seconds > 0 && seconds < 0.00995) return fmt::format("{:.2g} ms", 1e3 * seconds);
  if (seconds < 1) return fmt::format("{:.0f} ms", 1e3 * seconds);
  if (seconds < 60) return fmt::format("{:.1f} s", seconds);
  const long whole = std::lround(seconds);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

}  // namespace lanelight
