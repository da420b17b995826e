#include "vision/corners.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace swiftlet::vision {
namespace {

/// Gradient along a corner's weakest direction, in grey levels per pixel, at least.
constexpr double kLeastContrast = 4.0;

/// Half the side of the window over which gradients are summed.
constexpr int kWindow_px = 2;
constexpr int kWindowPixels = (2 * kWindow_px + 1) * (2 * kWindow_px + 1);
/// Gradients need one more pixel, and so does the search for a local maximum.
constexpr int kBorder_px = kWindow_px + 2;

/// Products of the gradients at a pixel, or sums of them.
struct Moments {
  int uu = 0, uv = 0, vv = 0;
};

/// Central differences, twice the gradient, multiplied with each other along a row.
void gradientProducts(const GrayImage& image, int v, std::vector<Moments>& products) {
  const std::uint8_t *above = image.row(v - 1), *here = image.row(v), *below = image.row(v + 1);
  for (int u = 1; u + 1 < image.width_px; ++u) {
    const int du = here[u + 1] - here[u - 1], dv = below[u] - above[u];
    products[static_cast<std::size_t>(u)] = {du * du, du * dv, dv * dv};
  }
}

/// The gradient along the weakest direction, from the window's sums of squared doubled gradients.
float contrastOf(const Moments& sums) {
  const auto uu = static_cast<float>(sums.uu), uv = static_cast<float>(sums.uv), vv = static_cast<float>(sums.vv);
  const float smaller = 0.5F * (uu + vv - std::sqrt((uu - vv) * (uu - vv) + 4.0F * uv * uv));
  return 0.5F * std::sqrt(std::max(smaller, 0.0F) / static_cast<float>(kWindowPixels));
}

/// Sums over rows v - kWindow_px to v + kWindow_px, kept up to date from row to row.
class ColumnSums {
 public:
  explicit ColumnSums(const GrayImage& image)
      : image_(image), sums_(columns()), rows_(2 * kWindow_px + 1, std::vector<Moments>(columns())) {}

  /// Rows must come in order, each once.
  void enter(int v) {
    std::vector<Moments>& row = rows_[static_cast<std::size_t>(v) % rows_.size()];
    add(row, -1);
    gradientProducts(image_, v, row);
    add(row, 1);
  }
  const std::vector<Moments>& sums() const { return sums_; }

 private:
  std::size_t columns() const { return static_cast<std::size_t>(image_.width_px); }
  void add(const std::vector<Moments>& row, int sign) {
    for (std::size_t u = 0; u < row.size(); ++u) {
      sums_[u].uu += sign * row[u].uu;
      sums_[u].uv += sign * row[u].uv;
      sums_[u].vv += sign * row[u].vv;
    }
  }

  const GrayImage& image_;
  std::vector<Moments> sums_;
  std::vector<std::vector<Moments>> rows_;
};

void contrastOfRow(const std::vector<Moments>& columns, int width_px, float* contrast) {
  for (int u = kWindow_px + 1; u + kWindow_px + 1 < width_px; ++u) {
    Moments sums;
    for (int i = u - kWindow_px; i <= u + kWindow_px; ++i) {
      const Moments& column = columns[static_cast<std::size_t>(i)];
      sums.uu += column.uu;
      sums.uv += column.uv;
      sums.vv += column.vv;
    }
    contrast[u] = contrastOf(sums);
  }
}

bool isLocalMaximum(const float* at, int width_px) {
  const float value = *at;
  // Strict on one side, so that of two equal neighbours exactly one is the maximum.
  return value > at[-width_px - 1] && value > at[-width_px] && value > at[-width_px + 1] && value > at[-1] &&
         value >= at[1] && value >= at[width_px - 1] && value >= at[width_px] && value >= at[width_px + 1];
}

/// The peak of the parabola through three equally spaced values, from the middle one.
double parabolaPeak(float before, float here, float after) {
  const double curvature = static_cast<double>(before) - 2.0 * static_cast<double>(here) + static_cast<double>(after);
  if (curvature >= 0.0) return 0.0;
  return std::clamp(0.5 * (static_cast<double>(before) - static_cast<double>(after)) / curvature, -0.5, 0.5);
}

struct Candidate {
  Corner corner;
  int cell = 0;
  int rank = 0;  ///< 0 for the strongest of its cell.
};

std::vector<Candidate> localMaxima(const std::vector<float>& contrast, const GrayImage& image,
                                   const CornerConfig& config) {
  const int width_px = image.width_px;
  const int cells_across = width_px / config.cell_px + 1;
  std::vector<Candidate> found;
  for (int v = kBorder_px; v + kBorder_px < image.height_px; ++v) {
    const float* row = contrast.data() + static_cast<std::ptrdiff_t>(v) * width_px;
    for (int u = kBorder_px; u + kBorder_px < width_px; ++u) {
      const float* at = row + u;
      if (static_cast<double>(*at) < kLeastContrast || !isLocalMaximum(at, width_px)) continue;
      const Eigen::Vector2d offset(parabolaPeak(at[-1], at[0], at[1]),
                                   parabolaPeak(at[-width_px], at[0], at[width_px]));
      found.push_back({{Eigen::Vector2d(u, v) + offset, static_cast<double>(*at)},
                       v / config.cell_px * cells_across + u / config.cell_px});
    }
  }
  return found;
}

}  // namespace

std::vector<float> cornerContrast(const GrayImage& image) {
  std::vector<float> contrast(image.values.size(), 0.0F);
  if (image.width_px <= 2 * kBorder_px || image.height_px <= 2 * kBorder_px) return contrast;
  ColumnSums columns(image);
  for (int v = 1; v + 1 < image.height_px; ++v) {
    columns.enter(v);
    const int middle = v - kWindow_px;
    if (middle > kWindow_px)
      contrastOfRow(columns.sums(), image.width_px,
                    contrast.data() + static_cast<std::ptrdiff_t>(middle) * image.width_px);
  }
  return contrast;
}

std::vector<Corner> findCorners(const GrayImage& image, const CornerConfig& config) {
  std::vector<Candidate> found = localMaxima(cornerContrast(image), image, config);
  std::stable_sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) {
    return a.cell != b.cell ? a.cell < b.cell : a.corner.contrast > b.corner.contrast;
  });
  for (std::size_t i = 1; i < found.size(); ++i)
    if (found[i].cell == found[i - 1].cell) found[i].rank = found[i - 1].rank + 1;
  std::stable_sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) {
    return a.rank != b.rank ? a.rank < b.rank : a.corner.contrast > b.corner.contrast;
  });
  found.resize(std::min(found.size(), static_cast<std::size_t>(config.greatest_number)));
  std::vector<Corner> corners;
  corners.reserve(found.size());
  for (const Candidate& candidate : found) corners.push_back(candidate.corner);
  return corners;
}

}  // namespace swiftlet::vision
