// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/bench/bench_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace polargrain::app {
namespace {

constexpr double kWidth = 760.0;
constexpr double kHeight = 460.0;
constexpr double kMargin = 60.0;
constexpr double kBorder = 20.0;
/// What has no place on a logarithmic axis.
constexpr double kLeastError = 1e-6;
constexpr double kLeastSeconds = 1e-3;
constexpr double kLineHeight = 13.0;
constexpr double kLetterWidth = 6.5;

/// From a number to a place along a logarithmic axis of at least one decade, of steps 1, 2, 5.
class Axis {
 public:
  Axis(const std::vector<double>& values, double first, double last) : first_(first), last_(last) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    from_ = std::log10(*least) - 0.1;
    to_ = std::max(std::log10(*most) + 0.1, from_ + 1.0);
  }
  [[nodiscard]] double place(double value) const {
    return first_ + (last_ - first_) * (std::log10(value) - from_) / (to_ - from_);
  }
  [[nodiscard]] std::vector<double> ticks() const {
    std::vector<double> values;
    const bool fine = to_ - from_ < 4.0;
    for (double power = std::floor(from_); power <= to_; power += 1.0) {
      for (const double digit : {1.0, 2.0, 5.0}) {
        const double value = digit * std::pow(10.0, power);
        if ((fine || digit == 1.0) && std::log10(value) >= from_ && std::log10(value) <= to_)
          values.push_back(value);
      }
    }
    return values;
  }

 private:
  double from_ = 0.0;
  double to_ = 1.0;
  double first_;
  double last_;
};

/// A mark with its name.
struct Mark {
  double seconds = 0.0;
  double error = 0.0;
  std::string name;  ///< empty: not written
  bool square = false;
  double size = 5.0;  ///< half its width
  const char* colour = "#8ac";
};

/// Puts names where they cover no other.
class Names {
 public:
  std::string write(const std::string& name, double cx, double cy, double gap) {
    const double width = kLetterWidth * static_cast<double>(name.size());
    const bool to_the_left = cx + gap + width > kWidth;
    const double x = to_the_left ? cx - gap - width : cx + gap;
    double y = cy + 4.0;
    for (int k = 0; k < 12; ++k) {  // below and above in turns, ever farther
      y = cy + 4.0 + kLineHeight * static_cast<double>(k % 2 == 0 ? k / 2 : -(k + 1) / 2);
      if (is_free(x, x + width, y)) break;
    }
    taken_.push_back({x, x + width, y});
    return fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='{}'>{}</text>\n",
                       to_the_left ? cx - gap : cx + gap, y, to_the_left ? "end" : "start", escaped(name));
  }

 private:
  struct Place {
    double left, right, y;
  };
  [[nodiscard]] bool is_free(double left, double right, double y) const {
    return std::none_of(taken_.begin(), taken_.end(), [&](const Place& place) {
      return left < place.right && right > place.left && std::abs(y - place.y) < kLineHeight - 1.0;
    });
  }
  std::vector<Place> taken_;
};

std::vector<Mark> marks_of(std::size_t y, const std::vector<BenchResult>& results,
                           const std::vector<SizeScatter>& sizes) {
  std::vector<Mark> marks;
  for (const BenchResult& result : results) {
    if (&result == &results.front() || y >= result.errors.size()) continue;
    const BenchSetting& setting = result.setting;
    Mark mark{result.seconds, result.errors[y].largest,
              setting.label.empty() ? setting.group : setting.label};
    mark.square = result.has_own_packing();
    if (mark.square && sizes.size() > 1) mark.size = 3.5;
    for (const SizeScatter& size : sizes)  // their mean bears the name
      if (size.grains == setting.grains && size.packings > 1) mark.name.clear();
    mark.colour = !result.done() ? "#fff" : result.on_front ? "#c33" : mark.square ? "#bd9" : "#8ac";
    marks.push_back(mark);
  }
  for (const SizeScatter& size : sizes) {
    if (size.is_reference || size.packings < 2) continue;
    marks.push_back({size.seconds, size.errors[y].largest,
                     fmt::format("{} grains, mean of {}", size.grains, size.packings), true, 6.0, "#6a4"});
  }
  for (Mark& mark : marks) {
    mark.seconds = std::max(kLeastSeconds, mark.seconds);
    mark.error = std::max(kLeastError, mark.error);
  }
  return marks;
}

std::string grid(const Axis& across, const Axis& up) {
  std::string svg;
  const double bottom = kHeight - kMargin;
  for (const double seconds : across.ticks())
    svg += fmt::format(
        "<path d='M{0:.1f} {1}V{2}' stroke='#ddd'/><text x='{0:.1f}' y='{3}' "
        "text-anchor='middle'>{4:g}</text>\n",
        across.place(seconds), kBorder, bottom, bottom + 18.0, seconds);
  for (const double error : up.ticks())
    svg += fmt::format(
        "<path d='M{0} {1:.1f}H{2}' stroke='#ddd'/><text x='{3}' y='{4:.1f}' "
        "text-anchor='end'>{5:g} %</text>\n",
        kMargin, up.place(error), kWidth - kBorder, kMargin - 6.0, up.place(error) + 4.0, 100.0 * error);
  return svg + fmt::format(
                   "<text x='{}' y='{}' text-anchor='middle'>wall time, s</text>\n"
                   "<text x='{}' y='{}'>largest error</text>\n",
                   0.5 * kWidth, kHeight - 14.0, kMargin + 4.0, kBorder - 6.0);
}

}  // namespace

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

std::string bench_plot(std::size_t y, const std::vector<BenchResult>& results,
                       const std::vector<SizeScatter>& sizes) {
  const std::vector<Mark> marks = marks_of(y, results, sizes);
  if (marks.empty()) return "";
  std::vector<double> seconds;
  std::vector<double> errors;
  for (const Mark& mark : marks) {
    seconds.push_back(mark.seconds);
    errors.push_back(mark.error);
  }
  for (const SizeScatter& size : sizes)
    if (size.deviations[y].largest > 0.0) errors.push_back(std::max(kLeastError, size.deviations[y].largest));
  const Axis across(seconds, kMargin, kWidth - kBorder);
  const Axis up(errors, kHeight - kMargin, kBorder);
  std::string svg = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0} {1}' width='{0}' height='{1}' "
      "font-family='sans-serif' font-size='12'>\n",
      kWidth, kHeight);
  svg += grid(across, up);
  Names names;
  // From below, so that names which make way for others keep the order of their lines.
  std::vector<SizeScatter> ascending = sizes;
  std::sort(ascending.begin(), ascending.end(), [y](const SizeScatter& a, const SizeScatter& b) {
    return a.deviations[y].largest < b.deviations[y].largest;
  });
  for (const SizeScatter& size : ascending) {
    if (size.deviations[y].largest <= 0.0) continue;
    const double place = up.place(std::max(kLeastError, size.deviations[y].largest));
    svg += fmt::format("<path d='M{} {:.1f}H{}' stroke='#6a4' stroke-dasharray='6 4'/>\n", kMargin, place,
                       kWidth - kBorder);
    svg += names.write(fmt::format("scatter of {} grains", size.grains), kWidth - kBorder, place - 9.0, 4.0);
  }
  for (const Mark& mark : marks) {
    const double cx = across.place(mark.seconds);
    const double cy = up.place(mark.error);
    svg += mark.square ? fmt::format("<rect x='{:.1f}' y='{:.1f}' width='{}' height='{}'", cx - mark.size,
                                     cy - mark.size, 2.0 * mark.size, 2.0 * mark.size)
                       : fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='{}'", cx, cy, mark.size);
    svg += fmt::format(" fill='{}' stroke='#333'/>\n", mark.colour);
  }
  for (const Mark& mark : marks)
    if (!mark.name.empty())
      svg += names.write(mark.name, across.place(mark.seconds), up.place(mark.error), mark.size + 3.0);
  return svg + "</svg>\n";
}

}  // namespace polargrain::app
