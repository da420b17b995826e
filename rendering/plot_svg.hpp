// Line plots as SVG text for the report: it opens offline and follows the reader's light or dark scheme.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace swiftlet::rendering {

struct Series {
  std::string name;
  std::vector<Eigen::Vector2d> points;  ///< x ascending; a point with NaN breaks the line.
  bool dashed = false;
};

/// A stretch of x that is shaded and named: "taking off", "hold".
struct Span {
  double begin = 0.0;
  double end = 0.0;
  std::string name;
};

struct Plot {
  std::string title;
  std::string x_label;  ///< With its unit: "time (s)".
  std::string y_label;
  std::vector<Series> series;
  std::vector<Span> spans;
  std::optional<double> y_min;  ///< None: computed from the data.
  std::optional<double> y_max;
  int width_px = 560;
  int height_px = 250;
};

/// One <svg> element with its own style. Long series are thinned to what a pixel column can show (its first, lowest,
/// highest and last value), so that no peak is lost.
std::string plotSvg(const Plot& plot);

}  // namespace swiftlet::rendering
