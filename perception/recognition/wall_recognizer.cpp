#include "perception/recognition/wall_recognizer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/pose2.hpp"

namespace swiftlet::perception {
namespace {

/// So many beams make a wall as sure as it gets.
constexpr double kSureBeams = 50.0;

double sureness(const ScanLine& line) { return std::min(1.0, line.beams / kSureBeams); }

Recognized placed(const char* what, const Eigen::Vector2d& point_m, double heading_rad,
                  const Eigen::Matrix3d& covariance, double confidence) {
  Recognized object{what, common::lifted({point_m.x(), point_m.y(), heading_rad}, 0.0), {}, confidence};
  object.covariance.setZero();
  constexpr int kAt[3] = {3, 4, 2};  // x and y of the position, and the rotation about z.
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) object.covariance(kAt[row], kAt[column]) = covariance(row, column);
  return object;
}

Recognized wallOf(const ScanLine& line, double range_sigma_m) {
  const Eigen::Vector2d normal = line.normal(), along(-normal.y(), normal.x());
  const Eigen::Vector2d middle = 0.5 * (line.begin_m + line.end_m);
  // A point of the wall moves with the distance along the normal, and with the angle by its lever. Along the wall the
  // ends are where the beams happen to end.
  Eigen::Matrix<double, 3, 2> by_line;
  by_line.topRows<2>() = normal * Eigen::RowVector2d(-along.dot(middle), 1.0);
  by_line.row(2) << 1.0, 0.0;
  Eigen::Matrix3d covariance = by_line * line.covariance * by_line.transpose();
  const double spacing_m = line.length_m() / std::max(1, line.beams - 1);
  covariance.topLeftCorner<2, 2>() +=
      (spacing_m * spacing_m + range_sigma_m * range_sigma_m) * along * along.transpose();
  return placed("wall", middle, std::remainder(line.angle_rad + std::numbers::pi, 2.0 * std::numbers::pi), covariance,
                sureness(line));
}

}  // namespace

std::vector<Recognized> WallRecognizer::recognize(const Observation& observation) {
  if (observation.scan == nullptr) return {};
  const std::vector<ScanLine> lines = findLines(*observation.scan, config_);
  std::vector<Recognized> recognized;
  for (const ScanLine& line : lines) recognized.push_back(wallOf(line, config_.range_sigma_m));
  for (const ScanCorner& corner : findCorners(lines, config_)) {
    const auto first = static_cast<std::size_t>(corner.first_line);
    recognized.push_back(placed("corner", corner.point_m, corner.heading_rad, corner.covariance,
                                std::min(sureness(lines[first]), sureness(lines[first + 1]))));
  }
  std::stable_sort(recognized.begin(), recognized.end(),
                   [](const Recognized& a, const Recognized& b) { return a.confidence > b.confidence; });
  return recognized;
}

}  // namespace swiftlet::perception
