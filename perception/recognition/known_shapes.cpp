#include "perception/recognition/known_shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <Eigen/LU>

#include "perception/recognition/picture_pyramid.hpp"

namespace swiftlet::perception {
namespace {

using vision::GrayImage;

/// Widths at which the template is looked at; each level of the picture's pyramid halves what is larger.
constexpr double kSmallest_px = 24.0, kLargest_px = 180.0, kSizeRatio = 1.4142135623730951;
/// By how many grey levels a curve of the template differs from the mean around it, so that the same curve is found
/// in a picture in full light, in half and in a quarter of it.
constexpr std::array kTemplateContrasts = {6, 12, 24};
/// Curves that enclose less, as a share of the paper, are found only where the pattern is large and has others.
constexpr double kLeastShapeShare = 0.006;
/// Two frames are the same if their middles are this near, and their axes this equal, in units of their size.
constexpr double kSameMiddle = 0.25, kSameAxes = 0.35;
constexpr float kSameCorrelation = 0.92F;
constexpr double kSameTurn_rad = 0.25;
/// The greatest number; the time of a picture is proportional to it.
constexpr std::size_t kMostShapes = 60;

/// The template with `width_px`, and as much around it as a window reaches, of the colours of its edge.
struct SizedTemplate {
  GrayImage framed;
  int margin_px = 0;
  double scale = 1.0;  ///< Pixels of the template per pixel.
};

SizedTemplate sized(const std::vector<GrayImage>& levels, double width_px) {
  const GrayImage& full = levels.front();
  SizedTemplate made;
  made.scale = full.width_px / width_px;
  const int width = static_cast<int>(width_px), height = std::max(4, static_cast<int>(full.height_px / made.scale));
  made.margin_px = 16;
  made.framed = {width + 2 * made.margin_px, height + 2 * made.margin_px, {}};
  const int level =
      std::clamp(static_cast<int>(std::floor(std::log2(made.scale) + 0.5)), 0, static_cast<int>(levels.size()) - 1);
  const GrayImage& source = levels[static_cast<std::size_t>(level)];
  for (int v = 0; v < made.framed.height_px; ++v)
    for (int u = 0; u < made.framed.width_px; ++u) {
      const Eigen::Vector2d place = atLevel(
          {(u - made.margin_px + 0.5) * made.scale - 0.5, (v - made.margin_px + 0.5) * made.scale - 0.5}, level);
      const auto x = std::clamp(static_cast<float>(place.x()), 0.0F, static_cast<float>(source.width_px) - 1.01F);
      const auto y = std::clamp(static_cast<float>(place.y()), 0.0F, static_cast<float>(source.height_px) - 1.01F);
      made.framed.values.push_back(static_cast<std::uint8_t>(interpolated(source, x, y) + 0.5F));
    }
  return made;
}

/// The part inside of the margin.
GrayImage paperOf(const SizedTemplate& made) {
  GrayImage paper{made.framed.width_px - 2 * made.margin_px, made.framed.height_px - 2 * made.margin_px, {}};
  for (int v = 0; v < paper.height_px; ++v) {
    const std::uint8_t* const row = made.framed.row(v + made.margin_px) + made.margin_px;
    paper.values.insert(paper.values.end(), row, row + paper.width_px);
  }
  return paper;
}

bool liesOnPaper(const GrayImage& paper, const ClosedCurve& curve) {
  const Eigen::Matrix2d axes = curve.whitening.inverse();
  const double half_u = 1.5 * axes.row(0).norm(), half_v = 1.5 * axes.row(1).norm();
  return curve.middle_px.x() - half_u > 0.0 && curve.middle_px.y() - half_v > 0.0 &&
         curve.middle_px.x() + half_u < paper.width_px - 1.0 && curve.middle_px.y() + half_v < paper.height_px - 1.0;
}

bool isSame(const KnownShape& a, const KnownShape& b) {
  if ((a.whitening_1_m * (b.middle_m - a.middle_m)).norm() > kSameMiddle) return false;
  const Eigen::Matrix2d between = a.whitening_1_m * b.whitening_1_m.inverse();
  if ((between.transpose() * between - Eigen::Matrix2d::Identity()).norm() > kSameAxes) return false;
  const PatchMatch match = bestTurn(a.patch, b.patch, kSameCorrelation);
  return match.correlation >= kSameCorrelation &&
         std::abs(std::remainder(match.turn_rad, 6.283185307179586)) < kSameTurn_rad;
}

}  // namespace

std::vector<KnownShape> knownShapes(const PatternTemplate& pattern) {
  const std::vector<GrayImage> levels = pyramidOf(pattern.picture(), 4);
  std::vector<KnownShape> shapes;
  // The large ones first: they are seen from afar.
  const auto add = [&](const SizedTemplate& made, const GrayImage& paper, const ClosedCurve& curve) {
    const auto patch = polarPatch(paper, curve, kPatchRings);
    if (!patch) return;
    const double metres = made.scale * pattern.metresPerPixel();
    KnownShape shape{
        *patch,
        pattern.point_pattern_m((curve.middle_px + Eigen::Vector2d(0.5, 0.5)) * made.scale - Eigen::Vector2d(0.5, 0.5)),
        curve.whitening / metres};
    shape.whitening_1_m.col(1) *= -1.0;
    if (std::none_of(shapes.begin(), shapes.end(), [&](const KnownShape& other) { return isSame(shape, other); }))
      shapes.push_back(shape);
  };
  for (double width_px = kSmallest_px; width_px < kLargest_px; width_px *= kSizeRatio) {
    const SizedTemplate made = sized(levels, width_px);
    const GrayImage paper = paperOf(made);
    ClosedCurve outline;
    outline.middle_px = {0.5 * (paper.width_px - 1), 0.5 * (paper.height_px - 1)};
    outline.whitening = std::sqrt(12.0) * Eigen::Vector2d(1.0 / paper.width_px, 1.0 / paper.height_px).asDiagonal();
    outline.area_px2 = static_cast<double>(paper.width_px) * paper.height_px;
    add(made, paper, outline);
    for (const int contrast : kTemplateContrasts)
      for (ClosedCurve curve : findClosedCurves(made.framed, contrast)) {
        curve.middle_px -= Eigen::Vector2d::Constant(made.margin_px);
        if (curve.area_px2 >= kLeastShapeShare * outline.area_px2 && liesOnPaper(paper, curve)) add(made, paper, curve);
      }
  }
  if (shapes.size() > kMostShapes) shapes.resize(kMostShapes);
  return shapes;
}

}  // namespace swiftlet::perception
