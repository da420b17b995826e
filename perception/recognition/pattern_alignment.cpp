#include "perception/recognition/pattern_alignment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "common/normal_distribution.hpp"
#include "perception/recognition/picture_pyramid.hpp"

namespace swiftlet::perception {
namespace {

using vision::GrayImage;

/// The pose, gain and offset; and by how much more than the template the picture is blurred across, up and diagonally.
constexpr int kWithoutBlur = 8, kWithBlur = 11;

/// Samples along each side of a grid over the pattern: about one a pixel, within these.
constexpr int kLeastSamples = 12, kMostSamples = 160;
/// Of these so many are used, where the template is steepest.
constexpr std::size_t kMostInformative = 3000;
constexpr int kIterations = 10;
/// A step that moves the corners by less has converged.
constexpr double kConverged_px = 0.01;
/// Least share of the samples that lie in the picture.
constexpr double kLeastInside = 0.5;
/// Cauchy's weight has an efficiency of 95 % for normal errors at this multiple of sigma (Z. Zhang, "Parameter
/// estimation techniques", IVC 1997, table 1).
constexpr double kCauchy = 2.385;
/// Residuals are at least this uncertain: a grey level is rounded, and interpolated.
constexpr double kLeastSigma = 1.0;
/// Neighbouring residuals are not independent: what a template does not know (blur, shading) spreads over some pixels.
/// So many samples count as one.
constexpr double kSamplesPerMeasurement = 6.0;

/// Cells of the evidence along each side, and samples along each side of a cell.
constexpr int kCells = 6, kCellSamples = 7;
/// A cell looks as it should from this correlation.
constexpr double kCellCorrelation = 0.6;
/// Standard deviation, in grey levels of the template, below which a cell is plain and says nothing.
constexpr double kPlainCell = 6.0;
/// Variance in squared grey levels added to that of the picture, so that noise in a plain place correlates with
/// nothing.
constexpr double kNoiseVariance = 9.0;

/// A pixel contradicts the template if it is off by more than this share of its contrast.
constexpr double kContradiction = 0.6;

/// Widths of the box that a pixel of the picture is the mean of: by a lens and a motion more than its own.
constexpr std::array<double, 7> kBlurs_px = {1.0, 1.4, 2.0, 2.8, 4.0, 5.6, 8.0};
constexpr int kBlurSamples = 50;

/// Two poses whose rotations differ by less are one.
constexpr double kOnePose_rad = 0.02;

/// A residual of this share of the contrast counts half in the cost (Geman and McClure).
constexpr double kCostShare = 0.15;

constexpr int kCoarseSamples = 16;

/// Sums for a correlation.
struct Correlation {
  double count = 0.0, a = 0.0, b = 0.0, aa = 0.0, ab = 0.0, bb = 0.0;

  void add(double x, double y) {
    count += 1.0;
    a += x;
    b += y;
    aa += x * x;
    ab += x * y;
    bb += y * y;
  }
  void add(const Correlation& other) {
    count += other.count;
    a += other.a;
    b += other.b;
    aa += other.aa;
    ab += other.ab;
    bb += other.bb;
  }
  double varianceA() const { return count > 0.0 ? std::max(0.0, aa / count - a * a / (count * count)) : 0.0; }
  double varianceB() const { return count > 0.0 ? std::max(0.0, bb / count - b * b / (count * count)) : 0.0; }
  double covariance() const { return ab / count - a * b / (count * count); }
  double value(double noise_variance) const {
    const double scale = varianceA() * (varianceB() + noise_variance);
    return count > 1.0 && scale > 0.0 ? covariance() / std::sqrt(scale) : -1.0;
  }
};

/// The camera of a level of the pyramid.
common::PinholeCamera cameraAt(common::PinholeCamera camera, int level) {
  for (int i = 0; i < level; ++i) camera = vision::halved(camera);
  return camera;
}

/// What a picture says at a sample: residual and its derivatives.
template <int kParameters>
struct Residual {
  Eigen::Matrix<double, kParameters, 1> jacobian;
  double value;
};

double medianAbsolute(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

PatternAligner::PatternAligner(const PatternTemplate& pattern)
    : pattern_(pattern), template_levels_(pyramidOf(pattern.picture(), 4)) {
  std::vector<std::uint8_t> values = pattern.picture().values;
  std::sort(values.begin(), values.end());
  contrast_ = values[values.size() * 19 / 20] - values[values.size() / 20];
}

PatternAligner::Sharpness PatternAligner::sharpness(double pixel_m) const {
  const double level = std::clamp(std::log2(pixel_m / pattern_.metresPerPixel()), 0.0,
                                  static_cast<double>(template_levels_.size()) - 1.001);
  const int finer = static_cast<int>(level);
  return {finer, static_cast<float>(level - finer)};
}

float PatternAligner::templateValue(const Eigen::Vector2d& point_m, Sharpness sharpness) const {
  const Eigen::Vector2d pixel = pattern_.pixel(point_m);
  const auto read = [&](int level) {
    const GrayImage& image = template_levels_[static_cast<std::size_t>(level)];
    const Eigen::Vector2d place = atLevel(pixel, level);
    const auto u = std::clamp(static_cast<float>(place.x()), 0.0F, static_cast<float>(image.width_px) - 1.01F);
    const auto v = std::clamp(static_cast<float>(place.y()), 0.0F, static_cast<float>(image.height_px) - 1.01F);
    return interpolated(image, u, v);
  };
  return (1.0F - sharpness.coarser_share) * read(sharpness.finer_level) +
         sharpness.coarser_share * read(sharpness.finer_level + 1);
}

int PatternAligner::levelOf(const std::vector<GrayImage>& levels, double size_px, double wanted_px) const {
  return std::clamp(static_cast<int>(std::floor(std::log2(size_px / wanted_px) + 0.5)), 0,
                    static_cast<int>(levels.size()) - 1);
}

double PatternAligner::size_px(const common::PinholeCamera& camera, const PlanarPose& pose) const {
  const double half_w = 0.5 * pattern_.width_m(), half_h = 0.5 * pattern_.height_m();
  std::array<Eigen::Vector2d, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d point = pose * Eigen::Vector2d(i == 0 || i == 3 ? -half_w : half_w, i < 2 ? -half_h : half_h);
    if (point.z() < 0.01 * pose.position_m.z() || point.z() <= 0.0) return 0.0;
    corners[i] = pixelOf(camera, point);
  }
  double doubled_area = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d &a = corners[i], &b = corners[(i + 1) % 4];
    doubled_area += a.x() * b.y() - a.y() * b.x();
  }
  // Counter-clockwise on the paper is negative in a picture whose v counts down.
  return doubled_area < 0.0 ? std::sqrt(-0.5 * doubled_area) : 0.0;
}

double PatternAligner::cornerDistance_px(const common::PinholeCamera& camera, const PlanarPose& one,
                                         const PlanarPose& other) const {
  double sum = 0.0;
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5}) {
      const Eigen::Vector2d point(x * pattern_.width_m(), y * pattern_.height_m());
      sum += 0.25 * (pixelOf(camera, one * point) - pixelOf(camera, other * point)).norm();
    }
  return sum;
}

double PatternAligner::coarseCorrelation(const std::vector<GrayImage>& levels, const common::PinholeCamera& camera,
                                         const PlanarPose& pose) const {
  const double size = size_px(camera, pose);
  if (size < kCoarseSamples / 2.0) return -1.0;
  const int level = levelOf(levels, size, kCoarseSamples);
  const common::PinholeCamera level_camera = cameraAt(camera, level);
  const GrayImage& image = levels[static_cast<std::size_t>(level)];
  const Sharpness sharp = sharpness(pattern_.width_m() / kCoarseSamples);
  Correlation sums;
  for (int row = 0; row < kCoarseSamples; ++row)
    for (int column = 0; column < kCoarseSamples; ++column) {
      const Eigen::Vector2d point_m(((column + 0.5) / kCoarseSamples - 0.5) * pattern_.width_m(),
                                    ((row + 0.5) / kCoarseSamples - 0.5) * pattern_.height_m());
      const Eigen::Vector3d point = pose * point_m;
      if (point.z() <= 0.0) return -1.0;
      const Eigen::Vector2d pixel = pixelOf(level_camera, point);
      if (!isInside(image, pixel.x(), pixel.y(), 0.0)) continue;
      sums.add(static_cast<double>(templateValue(point_m, sharp)),
               static_cast<double>(interpolated(image, static_cast<float>(pixel.x()), static_cast<float>(pixel.y()))));
    }
  return sums.count < kLeastInside * kCoarseSamples * kCoarseSamples ? -1.0 : sums.value(kNoiseVariance);
}

std::vector<PatternAligner::Sample> PatternAligner::samplesAt(double size_px, double blur_px) const {
  const double side_m = std::sqrt(pattern_.width_m() * pattern_.height_m()), pixel_m = blur_px * side_m / size_px;
  const double step_m =
      side_m / std::clamp(size_px, static_cast<double>(kLeastSamples), static_cast<double>(kMostSamples));
  const int columns = std::max(4, static_cast<int>(pattern_.width_m() / step_m + 0.5));
  const int rows = std::max(4, static_cast<int>(pattern_.height_m() / step_m + 0.5));
  const Sharpness sharp = sharpness(pixel_m);
  const auto read = [&](double x_m, double y_m) { return static_cast<double>(templateValue({x_m, y_m}, sharp)); };
  std::vector<Eigen::Vector2d> places;
  std::vector<double> values;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      places.emplace_back(((column + 0.5) / columns - 0.5) * pattern_.width_m(),
                          ((row + 0.5) / rows - 0.5) * pattern_.height_m());
      values.push_back(read(places.back().x(), places.back().y()));
    }
  // Plain places measure nothing: the steepest are enough.
  std::vector<double> steepness;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const auto at = [&](int r, int c) {
        return values[static_cast<std::size_t>(std::clamp(r, 0, rows - 1) * columns + std::clamp(c, 0, columns - 1))];
      };
      const double across = at(row, column + 1) - at(row, column - 1), up = at(row + 1, column) - at(row - 1, column);
      steepness.push_back(across * across + up * up);
    }
  double least = -1.0;
  if (steepness.size() > kMostInformative) {
    std::vector<double> sorted = steepness;
    const auto last = sorted.begin() + static_cast<std::ptrdiff_t>(kMostInformative);
    std::nth_element(sorted.begin(), last, sorted.end(), std::greater<>());
    least = *last;
  }
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (steepness[i] <= least) continue;
    const double x = places[i].x(), y = places[i].y(), h = pixel_m;
    const double left = read(x - h, y), right = read(x + h, y), lower = read(x, y - h), upper = read(x, y + h);
    samples.push_back({places[i],
                       values[i],
                       {(right - left) / (2.0 * h), (upper - lower) / (2.0 * h)},
                       {left - 2.0 * values[i] + right, lower - 2.0 * values[i] + upper,
                        0.25 * (read(x + h, y + h) - read(x - h, y + h) - read(x + h, y - h) + read(x - h, y - h))}});
  }
  return samples;
}

std::optional<AlignedPattern> PatternAligner::align(const std::vector<GrayImage>& levels,
                                                    const common::PinholeCamera& camera, const PlanarPose& start,
                                                    double wanted_px) const {
  return alignWith<kWithoutBlur>(levels, camera, start, wanted_px, 1.0);
}

std::optional<AlignedPattern> PatternAligner::alignFinely(const std::vector<GrayImage>& levels,
                                                          const common::PinholeCamera& camera, const PlanarPose& start,
                                                          double wanted_px, double blur_px) const {
  return alignWith<kWithBlur>(levels, camera, start, wanted_px, blur_px);
}

template <int kParameters>
std::optional<AlignedPattern> PatternAligner::alignWith(const std::vector<GrayImage>& levels,
                                                        const common::PinholeCamera& camera, const PlanarPose& start,
                                                        double wanted_px, double blur_px) const {
  using Parameters = Eigen::Matrix<double, kParameters, 1>;
  using Squares = Eigen::Matrix<double, kParameters, kParameters>;
  const double size = size_px(camera, start);
  if (!(size > 0.0)) return std::nullopt;
  const int level = levelOf(levels, size, wanted_px);
  const common::PinholeCamera level_camera = cameraAt(camera, level);
  const GrayImage& image = levels[static_cast<std::size_t>(level)];
  const double size_at_level = size / (1 << level);
  const std::vector<Sample> samples = samplesAt(size_at_level, blur_px);

  Correlation sums;
  for (const Sample& sample : samples) {
    const Eigen::Vector3d point = start * sample.point_m;
    const Eigen::Vector2d pixel = pixelOf(level_camera, point);
    if (point.z() > 0.0 && isInside(image, pixel.x(), pixel.y(), 1.0))
      sums.add(sample.value,
               static_cast<double>(interpolated(image, static_cast<float>(pixel.x()), static_cast<float>(pixel.y()))));
  }
  if (!(sums.varianceA() > 0.0)) return std::nullopt;
  AlignedPattern aligned{start, {}, 1.0};
  // Gain, offset and blur: the grey value is that of the template times the first, and so on.
  Eigen::Matrix<double, kParameters - 6, 1> brightness = Eigen::Matrix<double, kParameters - 6, 1>::Zero();
  brightness[0] = std::sqrt(sums.varianceB() / sums.varianceA());
  brightness[1] = (sums.b - brightness[0] * sums.a) / sums.count;
  std::vector<Residual<kParameters>> residuals;
  residuals.reserve(samples.size());
  std::vector<double> absolute;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    residuals.clear();
    absolute.clear();
    for (const Sample& sample : samples) {
      const Eigen::Vector3d arm = aligned.pose.rotation.leftCols<2>() * sample.point_m;
      const Eigen::Vector3d point = aligned.pose.position_m + arm;
      if (point.z() <= 0.0) return std::nullopt;
      const Eigen::Vector2d pixel = pixelOf(level_camera, point);
      if (!isInside(image, pixel.x(), pixel.y(), 1.0)) continue;
      const auto u = static_cast<float>(pixel.x()), v = static_cast<float>(pixel.y());
      const Eigen::RowVector2d gradient(
          static_cast<double>(0.5F * (interpolated(image, u + 1.0F, v) - interpolated(image, u - 1.0F, v))),
          static_cast<double>(0.5F * (interpolated(image, u, v + 1.0F) - interpolated(image, u, v - 1.0F))));
      const double inverse = 1.0 / point.z();
      Eigen::Matrix<double, 2, 3> by_point;
      by_point << level_camera.fx_px * inverse, 0.0, -(pixel.x() - level_camera.cx_px) * inverse, 0.0,
          level_camera.fy_px * inverse, -(pixel.y() - level_camera.cy_px) * inverse;
      const Eigen::Matrix2d by_place = by_point * aligned.pose.rotation.leftCols<2>();
      if (by_place.determinant() == 0.0) return std::nullopt;
      // Where the pose is right, the gradient of the picture is that of the template. Their mean converges in second
      // order, and has half of the picture's noise.
      const Eigen::RowVector2d expected = brightness[0] * sample.gradient_1_m.transpose() * by_place.inverse();
      const Eigen::Vector3d moves = (0.5 * (gradient + expected) * by_point).transpose();
      Residual<kParameters> residual;
      residual.jacobian.template head<3>() = arm.cross(moves);
      residual.jacobian.template segment<3>(3) = moves;
      residual.jacobian[6] = -sample.value;
      residual.jacobian[7] = -1.0;
      if constexpr (kParameters == kWithBlur) residual.jacobian.template tail<3>() = -sample.curvature;
      residual.value = static_cast<double>(interpolated(image, u, v)) +
                       brightness.dot(residual.jacobian.template tail<kParameters - 6>());
      residuals.push_back(residual);
      absolute.push_back(std::abs(residual.value));
    }
    if (static_cast<double>(residuals.size()) < kLeastInside * static_cast<double>(samples.size())) return std::nullopt;
    const double sigma = std::max(kLeastSigma, common::kSigmaOfMedian * medianAbsolute(absolute));
    const double scale = kCostShare * brightness[0] * contrast_;
    Squares H = Squares::Zero();
    Parameters g = Parameters::Zero();
    double weighted_squares = 0.0, weights = 0.0, cost = 0.0;
    for (const Residual<kParameters>& residual : residuals) {
      const double squared = residual.value * residual.value;
      const double weight = 1.0 / (1.0 + squared / (kCauchy * kCauchy * sigma * sigma));
      for (int column = 0; column < kParameters; ++column) {
        const double weighted = weight * residual.jacobian[column];
        for (int row = column; row < kParameters; ++row) H(row, column) += weighted * residual.jacobian[row];
        g[column] -= weighted * residual.value;
      }
      weighted_squares += weight * squared;
      weights += weight;
      cost += squared / (squared + scale * scale);
    }
    aligned.cost = cost / static_cast<double>(residuals.size());
    const double variance = std::max(kLeastSigma * kLeastSigma, weighted_squares / weights);
    const Eigen::LDLT<Squares> solver(H);
    if (solver.info() != Eigen::Success || !solver.isPositive()) return std::nullopt;
    const Parameters step = solver.solve(g);
    if (!step.allFinite()) return std::nullopt;
    const PlanarPose next = moved(aligned.pose, step.template head<6>());
    brightness += step.template tail<kParameters - 6>();
    const double next_px = size_px(level_camera, next);
    if (!(brightness[0] > 0.0) || !(next_px > 0.25 * size_at_level) || next_px > 4.0 * size_at_level)
      return std::nullopt;
    const bool is_done =
        iteration + 1 == kIterations || cornerDistance_px(level_camera, aligned.pose, next) < kConverged_px;
    aligned.pose = next;
    if (!is_done) continue;
    aligned.covariance =
        (variance * kSamplesPerMeasurement * solver.solve(Squares::Identity())).template topLeftCorner<6, 6>();
    break;
  }
  return aligned;
}

std::optional<PlanarPose> PatternAligner::mirrored(const common::PinholeCamera& camera, const PlanarPose& pose) const {
  Eigen::Matrix3d homography;
  homography << pose.rotation.leftCols<2>(), pose.position_m;
  homography.row(0) = camera.fx_px * homography.row(0) + camera.cx_px * homography.row(2);
  homography.row(1) = camera.fy_px * homography.row(1) + camera.cy_px * homography.row(2);
  const auto poses =
      infinitesimalPoses(camera, expandedAt(homography, Eigen::Vector2d::Zero()), Eigen::Vector2d::Zero());
  if (!poses) return std::nullopt;
  const auto apart = [&](const PlanarPose& other) { return (other.rotation - pose.rotation).norm(); };
  const PlanarPose& other = apart((*poses)[0]) < apart((*poses)[1]) ? (*poses)[1] : (*poses)[0];
  if (apart(other) < kOnePose_rad || !other.showsFace()) return std::nullopt;
  return other;
}

double PatternAligner::blur_px(const std::vector<GrayImage>& levels, const common::PinholeCamera& camera,
                               const PlanarPose& pose, double wanted_px) const {
  const double size = size_px(camera, pose);
  if (!(size > 0.0)) return 1.0;
  const int level = levelOf(levels, size, wanted_px);
  const common::PinholeCamera level_camera = cameraAt(camera, level);
  const GrayImage& image = levels[static_cast<std::size_t>(level)];
  const double pixel_m = std::sqrt(pattern_.width_m() * pattern_.height_m()) / (size / (1 << level));
  std::array<Correlation, kBlurs_px.size()> sums;
  std::array<Sharpness, kBlurs_px.size()> sharp{};
  for (std::size_t i = 0; i < sums.size(); ++i) sharp[i] = sharpness(kBlurs_px[i] * pixel_m);
  for (int row = 0; row < kBlurSamples; ++row)
    for (int column = 0; column < kBlurSamples; ++column) {
      const Eigen::Vector2d point_m(((column + 0.5) / kBlurSamples - 0.5) * pattern_.width_m(),
                                    ((row + 0.5) / kBlurSamples - 0.5) * pattern_.height_m());
      const Eigen::Vector3d point = pose * point_m;
      const Eigen::Vector2d pixel = pixelOf(level_camera, point);
      if (!(point.z() > 0.0) || !isInside(image, pixel.x(), pixel.y(), 0.0)) continue;
      const auto value =
          static_cast<double>(interpolated(image, static_cast<float>(pixel.x()), static_cast<float>(pixel.y())));
      for (std::size_t i = 0; i < sums.size(); ++i)
        sums[i].add(static_cast<double>(templateValue(point_m, sharp[i])), value);
    }
  std::size_t best = 0;
  for (std::size_t i = 1; i < sums.size(); ++i)
    if (sums[i].value(0.0) > sums[best].value(0.0)) best = i;
  return kBlurs_px[best];
}

Evidence PatternAligner::evidence(const std::vector<GrayImage>& levels, const common::PinholeCamera& camera,
                                  const PlanarPose& pose) const {
  const double size = size_px(camera, pose);
  if (!(size > 0.0)) return {};
  constexpr int kSamples = kCells * kCellSamples;
  const int level = levelOf(levels, size, kSamples);
  const common::PinholeCamera level_camera = cameraAt(camera, level);
  const GrayImage& image = levels[static_cast<std::size_t>(level)];
  const Sharpness sharp =
      sharpness(std::sqrt(pattern_.width_m() * pattern_.height_m()) / std::min<double>(size, kSamples));
  std::array<Correlation, kCells * kCells> cells, known_cells;
  std::vector<Eigen::Vector2d> pairs;  // What the template has, and what the picture shows.
  for (int row = 0; row < kSamples; ++row)
    for (int column = 0; column < kSamples; ++column) {
      const Eigen::Vector2d point_m(((column + 0.5) / kSamples - 0.5) * pattern_.width_m(),
                                    (0.5 - (row + 0.5) / kSamples) * pattern_.height_m());
      const auto cell = static_cast<std::size_t>(row / kCellSamples * kCells + column / kCellSamples);
      const double known = static_cast<double>(templateValue(point_m, sharp));
      known_cells[cell].add(known, known);
      const Eigen::Vector3d point = pose * point_m;
      if (point.z() <= 0.0) return {};
      const Eigen::Vector2d pixel = pixelOf(level_camera, point);
      if (!isInside(image, pixel.x(), pixel.y(), 0.0)) continue;
      pairs.emplace_back(known, static_cast<double>(
                                    interpolated(image, static_cast<float>(pixel.x()), static_cast<float>(pixel.y()))));
      cells[cell].add(pairs.back().x(), pairs.back().y());
    }
  Correlation all, seen;
  double contrast = 0.0, seen_contrast = 0.0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    all.add(cells[i]);
    const double sigma = std::sqrt(known_cells[i].varianceA());
    if (sigma < kPlainCell) continue;
    contrast += sigma;
    if (cells[i].count < 0.5 * known_cells[i].count || cells[i].value(kNoiseVariance) < kCellCorrelation) continue;
    seen_contrast += sigma;
    seen.add(cells[i]);
  }
  if (!(seen.varianceA() > 0.0 && contrast > 0.0)) return {all.value(kNoiseVariance), 0.0, -1.0, 1.0, 1.0};
  // The brightness that the cells have that look as they should.
  const double gain = seen.covariance() / seen.varianceA();
  const double offset = (seen.b - gain * seen.a) / seen.count;
  int darker = 0, brighter = 0;
  for (const Eigen::Vector2d& pair : pairs) {
    const double share = (pair.y() - gain * pair.x() - offset) / (gain * contrast_);
    darker += share < -kContradiction ? 1 : 0;
    brighter += share > kContradiction ? 1 : 0;
  }
  const double count = static_cast<double>(pairs.size());
  return {all.value(kNoiseVariance), seen_contrast / contrast, seen.value(kNoiseVariance), darker / count,
          brighter / count};
}

}  // namespace swiftlet::perception
