// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <drawpoint/benchmarks/micro/comparison.hpp>
#include <iomanip>
#include <limits>
#include <sstream>

namespace drawpoint::benchmarks {
namespace {

constexpr double panel_width = 330, panel_height = 360, left = 70, top = 60, panel_pitch = 590;  // [px]
constexpr double label_height = 15;
// Of medium lightness, so that they stand out from white and from black.
constexpr const char* colours[] = {"#2f7fc1", "#d9661f", "#1a9e6c", "#c4569b",
                                   "#b58a00", "#7d6bd0", "#808080", "#d04545"};

struct Curve {
  std::string name;
  const char* colour;
  bool dashed;
  std::vector<std::pair<double, double>> points;  // decimal logarithms of ms and value
};

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void add(double x) { low = std::min(low, x), high = std::max(high, x); }
  double share(double x) const { return (x - low) / (high - low); }
};

std::vector<Curve> curves_of(const std::vector<Measured>& rows, double (*value)(const Evaluation&)) {
  std::vector<Curve> curves;
  std::vector<std::string> methods;
  for (const Measured& row : rows) {
    const auto known = std::find(methods.begin(), methods.end(), row.method);
    const auto colour = static_cast<std::size_t>(known - methods.begin()) % std::size(colours);
    if (known == methods.end()) methods.push_back(row.method);
    if (curves.empty() || curves.back().name != series_name(row))
      curves.push_back({series_name(row), colours[colour], row.substeps > 1, {}});
    const double y = value(row.evaluation);
    if (y > 0 && std::isfinite(y))
      curves.back().points.emplace_back(std::log10(row.evaluation.milliseconds), std::log10(y));
  }
  std::erase_if(curves, [](const Curve& curve) { return curve.points.empty(); });
  return curves;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : std::string(1, c);
  return out;
}

std::string power_of_ten(int exponent) {
  static const char* digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "10⁻" : "10";
  for (const char digit : std::to_string(std::abs(exponent))) text += digits[digit - '0'];
  return text;
}

// One pair of axes, decades wide, with its curves.
class Panel {
 public:
  Panel(std::ostream& out, double x, const std::vector<Curve>& curves) : out_(out), x_(x) {
    for (const Curve& curve : curves)
      for (const auto& [time, value] : curve.points) time_.add(time), value_.add(value);
    for (Range* range : {&time_, &value_}) {
      range->low = std::floor(range->low);
      range->high = std::max(std::ceil(range->high), range->low + 1);
    }
  }

  void axes(const std::string& what) const {
    for (int k = static_cast<int>(time_.low); k <= static_cast<int>(time_.high); ++k) {
      line("grid", across(k), top, across(k), top + panel_height);
      text(across(k), top + panel_height + 20, "middle", power_of_ten(k));
    }
    for (int k = static_cast<int>(value_.low); k <= static_cast<int>(value_.high); ++k) {
      line("grid", x_, down(k), x_ + panel_width, down(k));
      text(x_ - 8, down(k) + 4, "end", power_of_ten(k));
    }
    text(x_ + panel_width / 2, top + panel_height + 42, "middle", "time of a solve [ms]");
    text(x_, top - 12, "start", what);
  }

  void draw(const std::vector<Curve>& curves) const {
    for (const Curve& curve : curves) {
      out_ << "<polyline class=\"curve\" stroke=\"" << curve.colour << "\""
           << (curve.dashed ? " stroke-dasharray=\"6 3\"" : "") << " points=\"";
      for (const auto& [time, value] : curve.points) out_ << across(time) << ',' << down(value) << ' ';
      out_ << "\"/>\n";
      for (const auto& [time, value] : curve.points)
        out_ << "<circle r=\"2.5\" fill=\"" << curve.colour << "\" cx=\"" << across(time) << "\" cy=\""
             << down(value) << "\"/>\n";
    }
  }

  // Each name beside the end of its curve, moved down as far as the one above needs, with a line to the end.
  void name(std::vector<Curve> curves) const {
    std::sort(curves.begin(), curves.end(),
              [](const Curve& a, const Curve& b) { return a.points.back().second > b.points.back().second; });
    const double at = x_ + panel_width + 30;
    double free = top - label_height;
    for (std::size_t k = 0; k < curves.size(); ++k) {
      const auto& [time, value] = curves[k].points.back();
      const double room_below = label_height * static_cast<double>(curves.size() - 1 - k);
      const double lowest = top + panel_height - 4 - room_below;
      const double y = free = std::max(free + label_height, std::min(down(value), lowest));
      out_ << "<path class=\"leader\" stroke=\"" << curves[k].colour << "\" d=\"M" << across(time) << ' '
           << down(value) << " L" << at - 3 << ' ' << y << "\"/>\n<text class=\"name\" fill=\""
           << curves[k].colour << "\" x=\"" << at << "\" y=\"" << y + 4 << "\">" << escaped(curves[k].name)
           << "</text>\n";
    }
  }

 private:
  double across(double time) const { return x_ + panel_width * time_.share(time); }
  double down(double value) const { return top + panel_height * (1 - value_.share(value)); }
  void line(const char* kind, double x1, double y1, double x2, double y2) const {
    out_ << "<line class=\"" << kind << "\" x1=\"" << x1 << "\" y1=\"" << y1 << "\" x2=\"" << x2 << "\" y2=\""
         << y2 << "\"/>\n";
  }
  void text(double x, double y, const char* anchor, const std::string& words) const {
    out_ << "<text class=\"word\" x=\"" << x << "\" y=\"" << y << "\" text-anchor=\"" << anchor << "\">"
         << escaped(words) << "</text>\n";
  }

  std::ostream& out_;
  double x_;
  Range time_, value_;
};

constexpr const char* style = R"(<style>
text { font: 12px sans-serif; }
.word { fill: #767676; }
.title { fill: #767676; font-size: 15px; }
.grid { stroke: #888; stroke-opacity: 0.3; }
.curve { fill: none; stroke-width: 1.8; }
.leader { fill: none; stroke-width: 0.7; stroke-opacity: 0.6; }
@media (prefers-color-scheme: dark) { .word, .title { fill: #ccc; } }
</style>
)";

}  // namespace

std::string comparison_svg(const std::vector<Measured>& rows, const std::string& title) {
  std::ostringstream out;
  out << std::fixed << std::setprecision(1)
      << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 1220 480\">\n"
      << style << "<text class=\"title\" x=\"" << left << "\" y=\"24\">" << escaped(title) << "</text>\n";
  const std::vector<std::pair<std::string, double (*)(const Evaluation&)>> panels{
      {"residual, of the contact load", [](const Evaluation& e) { return e.residual.contacts(); }},
      {"distance of velocities to the converged ones of the same S",
       [](const Evaluation& e) { return e.distance.velocities; }}};
  double x = left;
  for (const auto& [what, value] : panels) {
    const std::vector<Curve> curves = curves_of(rows, value);
    if (curves.empty()) continue;
    const Panel panel(out, x, curves);
    panel.axes(what);
    panel.draw(curves);
    panel.name(curves);
    x += panel_pitch;
  }
  out << "</svg>\n";
  return out.str();
}

}  // namespace drawpoint::benchmarks
