// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/element/element_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/page/page.hpp"

namespace polargrain::app {
namespace {

constexpr const char* kMeanColour = "text";

/// A chart of two columns. @param factors turn values into the numbers shown
struct Picture {
  std::string title;
  std::string x;
  std::string y;
  ChartAxis x_axis;
  ChartAxis y_axis;
  double x_factor = 1.0;
  double y_factor = 1.0;
};

class Charts {
 public:
  Charts(const std::vector<std::string>& columns, const std::vector<ElementCurve>& curves,
         const ElementMean& mean)
      : columns_(columns), curves_(curves), mean_(mean) {}

  [[nodiscard]] bool has(const std::string& name) const {
    return std::ranges::find(columns_, name) != columns_.end();
  }

  [[nodiscard]] double largest(const std::string& name) const {
    double value = 0.0;
    for (const ElementCurve& curve : curves_)
      for (const auto& row : curve.rows) value = std::max(value, std::abs(row[column(name)]));
    return value;
  }

  [[nodiscard]] std::string html(const Picture& picture) const {
    std::vector<ChartSeries> series;
    for (const ElementCurve& curve : curves_)
      series.push_back(line(curve.name, curve.rows, {}, 0.0, picture));
    if (!mean_.mean.empty()) {
      // Of two curves the interval is 13 standard deviations of their mean wide to each side, and nothing else is seen.
      const bool interval = curves_.size() > 2;
      for (const double side : {0.0, -1.0, 1.0}) {
        if (side != 0.0 && !interval) continue;
        const std::string name = side == 0.0 ? "mean" : side < 0.0 ? "mean, 95 % below" : "mean, 95 % above";
        series.push_back(line(name, mean_.mean, mean_.half_width, side, picture));
        series.back().colour = kMeanColour;
        series.back().dashed = side != 0.0;
      }
    }
    return "<h2>" + escaped(picture.title) + "</h2>\n" +
           chart(picture.x_axis, picture.y_axis, series, series.size() > 1);
  }

 private:
  [[nodiscard]] std::size_t column(const std::string& name) const {
    return static_cast<std::size_t>(std::ranges::find(columns_, name) - columns_.begin());
  }

  /// @param side how many half widths beside the rows
  [[nodiscard]] ChartSeries line(const std::string& name, const std::vector<std::vector<double>>& rows,
                                 const std::vector<std::vector<double>>& half, double side,
                                 const Picture& picture) const {
    ChartSeries series;
    series.name = name;
    series.line = true;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      double y = rows[k][column(picture.y)];
      if (side != 0.0) y += side * half[k][column(picture.y)];
      series.points.emplace_back(picture.x_factor * rows[k][column(picture.x)], picture.y_factor * y);
    }
    return series;
  }

  const std::vector<std::string>& columns_;
  const std::vector<ElementCurve>& curves_;
  const ElementMean& mean_;
};

}  // namespace

std::string element_page(const std::string& title, const std::vector<std::string>& columns,
                         const std::vector<ElementCurve>& curves, const ElementMean& mean,
                         const std::string& before) {
  const Charts charts(columns, curves, mean);
  const bool shears = charts.largest("e12") > charts.largest("e22");
  const std::string strain = shears ? "e12" : "axial_strain";
  const ChartAxis strain_axis{.title = shears ? "shear strain" : "axial strain", .percent = true};
  const ChartAxis p_axis{.title = "mean effective stress p, kPa"};
  std::vector<Picture> pictures;
  if (shears)
    pictures.push_back(
        {"Shear stress", strain, "s12_Pa", strain_axis, {.title = "shear stress, kPa"}, 1.0, 1e-3});
  else
    pictures.push_back({"Stress ratio", strain, "stress_ratio", strain_axis, {.title = "s1 / s3"}});
  pictures.push_back({"Volume strain",
                      strain,
                      "volume_strain",
                      strain_axis,
                      {.title = "volume strain, dilation positive", .percent = true}});
  pictures.push_back({"Stress path", "p_Pa", "q_Pa", p_axis, {.title = "q, kPa"}, 1e-3, 1e-3});
  if (charts.has("void_ratio"))
    pictures.push_back({"Void ratio", "p_Pa", "void_ratio", p_axis, {.title = "void ratio"}, 1e-3});
  std::string body =
      "<p>Drawing a rectangle with the mouse enlarges it, a double click shows all again.</p>\n";
  for (const ElementCurve& curve : curves)
    if (!curve.failure.empty())
      body +=
          fmt::format("<p>{}: ended before its end: {}</p>\n", escaped(curve.name), escaped(curve.failure));
  body += before;
  for (const Picture& picture : pictures) body += charts.html(picture);
  return page(title, body);
}

}  // namespace polargrain::app
