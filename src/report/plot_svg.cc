// The drawing of plots, as text.
#include <algorithm>
#include <array>
#include <cmath>

#include "src/report/plot.h"
#include "src/report/values.h"

namespace lanelight {
namespace {

constexpr double kWidth = 960, kTop = 56, kBelow = 84;
constexpr double kPitch = 24;  // of rows and of names in a legend
constexpr const char *kInk = "#1c1e21", *kMuted = "#5b6169", *kGrid = "#e3e3e0";

// Of radius 4 around the origin, one after the other.
constexpr std::array kMarkers = {"M-4 0a4 4 0 1 0 8 0a4 4 0 1 0 -8 0z",  // circle
                                 "M-3.7 -3.7h7.4v7.4h-7.4z",             // square
                                 "M0 -5L4.6 3.6H-4.6z",                  // triangle
                                 "M0 -5.2l5.2 5.2l-5.2 5.2l-5.2 -5.2z",  // diamond
                                 "M0 5L4.6 -3.6H-4.6z"};  // the triangle, down
constexpr std::array kPlotDashes = {"none", "7 4", "2 3", "9 3 2 3"};

struct Box {
  double left, right, bottom;
  double width() const { return right - left; }
  double height() const { return bottom - kTop; }
};

std::string XmlEscaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '"') {
      out += "&quot;";
    } else {
      out += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    }
  }
  return out;
}

// At most so many characters of UTF-8.
std::string Shortened(const std::string& text, std::size_t most) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if ((text[i] & 0xc0) != 0x80 && ++count > most) return text.substr(0, i) + "…";
  }
  return text;
}

class SvgWriter {
 public:
  std::string Write(const Plot& plot) {
    const PlotPanel& first = plot.panels.front();
    const double rows = kPitch * static_cast<double>(first.series.size());
    const bool beside = plot.panels.size() > 1;
    const double height = kTop + kBelow + (first.rows ? rows : std::max(380.0, rows));
    out_ = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
        "viewBox=\"0 0 {0} {1}\" font-family=\"system-ui, 'DejaVu Sans', sans-serif\" "
        "font-size=\"12\">\n<title>{2}</title>\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
        kWidth, height, XmlEscaped(plot.title));
    Text(20, 30, kInk, "font-size=\"17\" font-weight=\"600\"", plot.title);
    Text(20, height - 14, kMuted, "font-size=\"10.5\"", Shortened(plot.source, 150));
    const double bottom = height - kBelow;
    if (first.rows) {
      Rows(first, {310, kWidth - 20, bottom}, 20, 40);
    } else {
      Curves(first, {76, beside ? 590.0 : 680.0, bottom});
      if (beside) {
        Rows(plot.panels[1], {790, kWidth - 20, bottom}, 608, 22);
      } else {
        for (std::size_t i = 0; i < first.series.size(); ++i) {
          Name(first.series[i], 698, kTop + kPitch * (double(i) + 0.5), 32);
        }
      }
    }
    return std::move(out_) + "</svg>\n";
  }

 private:
  static std::string Color(const PlotSeries& s) {
    const std::vector<std::string> colors = PlotColors();
    return colors[static_cast<std::size_t>(s.look) % colors.size()];
  }

  void Text(double x, double y, const char* color, const std::string& style,
            const std::string& text) {
    out_ += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" fill=\"{}\" {}>{}</text>\n", x,
                        y, color, style, XmlEscaped(text));
  }

  struct Segment {
    double x0, y0, x1, y1;
  };
  void Line(const Segment& s, const std::string& color, const std::string& style = "") {
    out_ += fmt::format(
        "<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\" "
        "stroke=\"{}\" {}/>\n",
        s.x0, s.y0, s.x1, s.y1, color, style);
  }

  void Marker(const PlotSeries& s, double x, double y, const std::string& data) {
    out_ += fmt::format(
        "<path transform=\"translate({:.2f} {:.2f})\" d=\"{}\" fill=\"{}\" {}/>\n", x, y,
        kMarkers[static_cast<std::size_t>(s.look) % kMarkers.size()], Color(s), data);
  }

  void Point(const PlotSeries& s, const PlotPoint& p, double x, double y) {
    Marker(s, x, y,
           fmt::format("class=\"point\" data-series=\"{}\" data-x=\"{}\" data-y=\"{}\"",
                       XmlEscaped(s.name), p.x, p.y.value));
  }

  std::string Dash(const PlotSeries& s) const {
    const std::size_t look = static_cast<std::size_t>(s.look);
    return fmt::format(
        "stroke-dasharray=\"{}\"",
        kPlotDashes[(look + look / PlotColors().size()) % kPlotDashes.size()]);
  }

  void Name(const PlotSeries& s, double x, double y, std::size_t most) {
    Line({x, y, x + 30, y}, Color(s), "stroke-width=\"1.8\" " + Dash(s));
    Marker(s, x + 15, y, "");
    Text(x + 38, y + 4, kInk, "class=\"name\"", Shortened(s.name, most));
  }

  void XAxis(const PlotAxis& axis, const PlotScale& scale, const Box& box) {
    for (const double tick : TicksOf(scale, axis, static_cast<int>(box.width() / 52))) {
      const double x = box.left + scale.At(tick);
      Line({x, kTop, x, box.bottom + 4}, kGrid);
      Text(x, box.bottom + 18, kMuted,
           fmt::format("text-anchor=\"middle\" class=\"tick-x\" data-value=\"{}\"", tick),
           TickText(tick, axis));
    }
    Line({box.left, box.bottom, box.right, box.bottom}, kMuted);
    Text((box.left + box.right) / 2, box.bottom + 38, kInk, "text-anchor=\"middle\"",
         axis.label);
  }

  void YAxis(const PlotAxis& axis, const PlotScale& scale, const Box& box) {
    for (const double tick : TicksOf(scale, axis, static_cast<int>(box.height() / 34))) {
      const double y = box.bottom - scale.At(tick);
      Line({box.left - 4, y, box.right, y}, kGrid);
      Text(box.left - 8, y + 4, kMuted,
           fmt::format("text-anchor=\"end\" class=\"tick-y\" data-value=\"{}\"", tick),
           TickText(tick, axis));
    }
    Line({box.left, kTop, box.left, box.bottom}, kMuted);
    Text(0, 0, kInk,
         fmt::format("text-anchor=\"middle\" transform=\"translate(18 {:.2f}) "
                     "rotate(-90)\"",
                     (kTop + box.bottom) / 2),
         axis.label);
  }

  void Curves(const PlotPanel& panel, const Box& box) {
    std::vector<double> xs, ys;
    if (panel.mark) ys.push_back(*panel.mark);
    for (const PlotSeries& s : panel.series) {
      for (const PlotPoint& p : s.points) {
        xs.push_back(p.x);
        // An interval down to nothing must not flatten all curves.
        for (const double y : {p.y.value, p.y.high, std::max(p.y.low, p.y.value / 8)}) {
          ys.push_back(y);
        }
      }
    }
    const PlotScale x = ScaleFor(xs, panel.x, box.width());
    const PlotScale y = ScaleFor(ys, panel.y, box.height());
    XAxis(panel.x, x, box);
    YAxis(panel.y, y, box);
    if (panel.slope) Guide(*panel.slope, x, y, box);
    if (panel.mark) {
      const double at = box.bottom - y.At(*panel.mark);
      Line({box.left, at, box.right, at}, kMuted, "stroke-dasharray=\"1 3\"");
    }
    for (const PlotSeries& s : panel.series) Curve(s, x, y, box);
  }

  void Curve(const PlotSeries& s, const PlotScale& x, const PlotScale& y,
             const Box& box) {
    std::string path;
    for (const PlotPoint& p : s.points) {
      path += fmt::format("{}{:.2f} {:.2f}", path.empty() ? "M" : "L",
                          box.left + x.At(p.x), box.bottom - y.At(p.y.value));
    }
    out_ += fmt::format(
        "<path class=\"curve\" d=\"{}\" fill=\"none\" stroke=\"{}\" "
        "stroke-width=\"1.8\" {}/>\n",
        path, Color(s), Dash(s));
    for (const PlotPoint& p : s.points) {
      const double px = box.left + x.At(p.x);
      if (p.y.HasBounds()) {
        const double low = box.bottom - y.At(p.y.low);
        const double high = box.bottom - y.At(p.y.high);
        Line({px, low, px, high}, Color(s), "class=\"bar\"");
        for (const double end : {low, high}) Line({px - 3, end, px + 3, end}, Color(s));
      }
      Point(s, p, px, box.bottom - y.At(p.y.value));
    }
  }

  // A dashed line of y ~ x^slope in the upper right, where curves leave room.
  void Guide(double slope, const PlotScale& x, const PlotScale& y, const Box& box) {
    const double from = std::pow(x.from, 0.5) * std::pow(x.to, 0.5);
    const double top = y.to / std::pow(y.to / y.from, 0.05);
    const double to =
        std::min(x.to / 1.05, from * std::pow(std::pow(y.to / y.from, 0.5), -1 / slope));
    const double x0 = box.left + x.At(from), y0 = box.bottom - y.At(top);
    const double x1 = box.left + x.At(to);
    const double y1 = box.bottom - y.At(top * std::pow(to / from, slope));
    Line({x0, y0, x1, y1}, "#8d939a", "stroke-dasharray=\"4 4\"");
    Text((x0 + x1) / 2 + 6, (y0 + y1) / 2 - 6, kMuted, "font-size=\"11\"",
         fmt::format("slope −{}", -slope == 0.5 ? "½" : fmt::format("{:g}", -slope)));
  }

  void Rows(const PlotPanel& panel, const Box& box, double names, std::size_t most) {
    std::vector<double> values;
    if (panel.mark) values.push_back(*panel.mark);
    for (const PlotSeries& s : panel.series) {
      for (const PlotPoint& p : s.points) {
        for (const double v : {p.y.value, p.y.low, p.y.high}) values.push_back(v);
      }
    }
    const PlotScale scale = ScaleFor(values, panel.y, box.width());
    XAxis(panel.y, scale, box);
    if (panel.mark) {
      const double at = box.left + scale.At(*panel.mark);
      Line({at, kTop, at, box.bottom}, kMuted, "stroke-dasharray=\"3 3\"");
    }
    const double pitch =
        std::min(32.0, box.height() / static_cast<double>(panel.series.size()));
    double y = kTop + pitch / 2;
    for (const PlotSeries& s : panel.series) {
      Name(s, names, y, most);
      for (const PlotPoint& p : s.points) {
        if (p.y.HasBounds()) {
          Line({box.left + scale.At(p.y.low), y, box.left + scale.At(p.y.high), y},
               Color(s), "class=\"bar\" stroke-width=\"1.8\"");
        }
        Point(s, p, box.left + scale.At(p.y.value), y);
      }
      y += pitch;
    }
  }

  std::string out_;
};

}  // namespace

std::string PlotSvg(const Plot& plot) { return SvgWriter().Write(plot); }

std::string PlotCsv(const Plot& plot) {
  const auto number = [](double v) {
    return std::isfinite(v) ? fmt::format("{}", v) : std::string();
  };
  std::string text = "series,quantity,value,low,high,at,at_quantity\n";
  for (const PlotPanel& panel : plot.panels) {
    for (const PlotSeries& s : panel.series) {
      for (const PlotPoint& p : s.points) {
        text += fmt::format("{},{},{},{},{},{},{}\n", CsvField(s.name),
                            CsvField(panel.y.label), number(p.y.value), number(p.y.low),
                            number(p.y.high), panel.rows ? "" : number(p.x),
                            panel.rows ? "" : CsvField(panel.x.label));
      }
    }
  }
  return text;
}

}  // namespace lanelight
