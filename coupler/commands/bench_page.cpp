// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/commands/bench_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace polargrain::coupler {
namespace {

constexpr double kWidth = 760.0;
constexpr double kHeight = 460.0;
constexpr double kMargin = 60.0;
/// An error of nothing has no place on a logarithmic axis.
constexpr double kLeastError = 1e-6;

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '&')
      out += "&amp;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

/// From a number to a place along a logarithmic axis.
class Axis {
 public:
  Axis(double least, double most, double first, double last)
      : from_(std::floor(std::log10(least))), to_(std::ceil(std::log10(most))), first_(first), last_(last) {
    if (to_ <= from_) to_ = from_ + 1.0;
  }
  [[nodiscard]] double place(double value) const {
    return first_ + (last_ - first_) * (std::log10(value) - from_) / (to_ - from_);
  }
  [[nodiscard]] std::vector<double> decades() const {
    std::vector<double> values;
    for (double power = from_; power <= to_; power += 1.0) values.push_back(std::pow(10.0, power));
    return values;
  }

 private:
  double from_;
  double to_;
  double first_;
  double last_;
};

std::string name_of(const BenchResult& result) {
  return result.setting.label.empty() ? result.setting.group : result.setting.label;
}

bool shown(const BenchResult& result) {
  return result.setting.group != "reference" && !result.errors.empty();
}

double error_of_curve(const BenchResult& result, std::size_t curve) {
  return std::max(kLeastError, result.errors[curve].largest);
}

std::string plot(const std::string& y, std::size_t curve, const std::vector<BenchResult>& results) {
  double fastest = HUGE_VAL, slowest = 0.0, closest = HUGE_VAL, farthest = 0.0;
  for (const BenchResult& result : results) {
    if (!shown(result)) continue;
    fastest = std::min(fastest, result.seconds);
    slowest = std::max(slowest, result.seconds);
    closest = std::min(closest, error_of_curve(result, curve));
    farthest = std::max(farthest, error_of_curve(result, curve));
  }
  if (slowest == 0.0) return "";
  const Axis across(std::max(1e-3, fastest), std::max(1e-3, slowest), kMargin, kWidth - 20.0);
  const Axis up(closest, farthest, kHeight - kMargin, 20.0);
  std::string svg = fmt::format(
      "<h2>{0}</h2>\n<svg viewBox='0 0 {1} {2}' width='{1}' height='{2}' font-family='sans-serif' "
      "font-size='12'>\n",
      escaped(y), kWidth, kHeight);
  for (const double seconds : across.decades()) {
    svg += fmt::format(
        "<path d='M{0:.1f} 20V{1}' stroke='#ddd'/><text x='{0:.1f}' y='{2}' "
        "text-anchor='middle'>{3:g}</text>\n",
        across.place(seconds), kHeight - kMargin, kHeight - kMargin + 18.0, seconds);
  }
  for (const double error : up.decades()) {
    svg += fmt::format(
        "<path d='M{0} {1:.1f}H{2}' stroke='#ddd'/><text x='{3}' y='{4:.1f}' "
        "text-anchor='end'>{5:g} %</text>\n",
        kMargin, up.place(error), kWidth - 20.0, kMargin - 6.0, up.place(error) + 4.0, 100.0 * error);
  }
  svg += fmt::format("<text x='{}' y='{}' text-anchor='middle'>wall time, s</text>\n", 0.5 * kWidth,
                     kHeight - 14.0);
  for (const BenchResult& result : results) {
    if (!shown(result)) continue;
    const double cx = across.place(std::max(1e-3, result.seconds));
    const double cy = up.place(error_of_curve(result, curve));
    svg += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='5' fill='{}' stroke='#333'/>", cx, cy,
                       !result.done()    ? "#fff"
                       : result.on_front ? "#c33"
                                         : "#8ac");
    svg +=
        fmt::format("<text x='{:.1f}' y='{:.1f}'>{}</text>\n", cx + 8.0, cy + 4.0, escaped(name_of(result)));
  }
  return svg + "</svg>\n";
}

std::vector<std::string> columns(const std::vector<std::string>& y) {
  std::vector<std::string> names{"what", "setting", "status", "s", "cell evaluations", "DEM steps"};
  for (const std::string& name : y) {
    names.push_back("error of " + name);
    names.push_back("of its peak");
  }
  names.push_back("front");
  return names;
}

std::vector<std::string> cells(const BenchResult& result) {
  std::vector<std::string> row{result.setting.group,
                               result.setting.label,
                               result.done() ? "done" : "stopped",
                               fmt::format("{:.1f}", result.seconds),
                               fmt::format("{:.0f}", result.evaluations),
                               fmt::format("{:.0f}", result.dem_steps)};
  for (const BenchError& error : result.errors) {
    row.push_back(fmt::format("{:.2f} %", 100.0 * error.largest));
    row.push_back(fmt::format("{:.2f} %", 100.0 * error.peak));
  }
  row.push_back(result.on_front ? "x" : "");
  return row;
}

}  // namespace

std::string bench_table(const std::vector<std::string>& y, const std::vector<BenchResult>& results) {
  std::string text = fmt::format("| {} |\n|", fmt::join(columns(y), " | "));
  for (std::size_t k = 0; k < columns(y).size(); ++k) text += "---|";
  text += '\n';
  for (const BenchResult& result : results) text += fmt::format("| {} |\n", fmt::join(cells(result), " | "));
  return text;
}

std::string bench_page(const std::string& title, const std::string& x, const std::vector<std::string>& y,
                       const std::vector<BenchResult>& results) {
  std::string page = fmt::format(
      "<!DOCTYPE html>\n<html lang='en'><head><meta "
      "charset='utf-8'><title>{0}</title>\n<style>body{{font-family:"
      "sans-serif;margin:2em}}table{{border-collapse:collapse}}td,th{{border:1px solid #ccc;padding:.2em "
      ".6em;"
      "text-align:left}}tr.front{{background:#fdd}}</style></head><body>\n<h1>{0}</h1>\n<p>Reference: {1}. "
      "Errors are the largest difference from its curve over {2}, as a share of the curve's range. Red: no "
      "other "
      "run is both faster and closer. White: stopped before its end.</p>\n",
      escaped("Speed against error: " + title), escaped(results.front().setting.label), escaped(x));
  for (std::size_t k = 0; k < y.size(); ++k) page += plot(y[k], k, results);
  page += "<table>\n<tr>";
  for (const std::string& name : columns(y)) page += "<th>" + escaped(name) + "</th>";
  page += "</tr>\n";
  for (const BenchResult& result : results) {
    page += result.on_front ? "<tr class='front'>" : "<tr>";
    for (const std::string& cell : cells(result)) page += "<td>" + escaped(cell) + "</td>";
    page += "</tr>\n";
  }
  page += "</table>\n";
  for (const BenchResult& result : results) {
    if (!result.done())
      page += fmt::format("<p>{}: {}</p>\n", escaped(name_of(result)), escaped(result.status));
  }
  return page + "</body></html>\n";
}

}  // namespace polargrain::coupler
