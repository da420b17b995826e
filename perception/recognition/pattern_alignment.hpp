// Aligns a pattern directly to a picture: the pose, gain and offset by which the picture's grey values are those of the
// template, by Gauss-Newton (B. Lucas, T. Kanade, IJCAI 1981) with the mean of both gradients (S. Benhimane, E. Malis,
// "Homography-based 2D visual tracking and servoing", IJRR 2007). The six parameters are those of the pose itself, as
// the camera is known, so that all pixels of the pattern measure it together.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/rgbd_frame.hpp"
#include "perception/recognition/pattern_template.hpp"
#include "perception/recognition/planar_pose.hpp"
#include "vision/gray_image.hpp"

namespace swiftlet::perception {

/// What a picture says for a pose of the pattern, after its brightness is taken out.
struct Evidence {
  double correlation = -1.0;       ///< Normalized cross-correlation of all of the pattern that is in the picture.
  double seen_share = 0.0;         ///< Share of the pattern's contrast in cells that look as they should.
  double seen_correlation = -1.0;  ///< Normalized cross-correlation within those cells.
  /// Shares of the pattern that are as dark as ink where paper should be, and as bright as paper where ink should be.
  double missing_paper = 1.0, missing_ink = 1.0;
};

struct AlignedPattern {
  PlanarPose pose;
  Eigen::Matrix<double, 6, 6> covariance;  ///< Of (rotation, position) in the optical frame; rad^2, rad m, m^2.
  double cost = 1.0;  ///< In [0, 1]: the share of the contrast that the pose leaves unexplained, robustly.
};

/// Const and without state: safe from any thread.
class PatternAligner {
 public:
  explicit PatternAligner(const PatternTemplate& pattern);

  /// The geometric mean of the sides that the pattern has in the picture. 0 if it is behind or beside the camera.
  double size_px(const common::PinholeCamera& camera, const PlanarPose& pose) const;
  /// Mean distance in pixels between the corners of the pattern at two poses.
  double cornerDistance_px(const common::PinholeCamera& camera, const PlanarPose& one, const PlanarPose& other) const;

  /// Normalized cross-correlation on a coarse grid: what a pose is worth before it is aligned.
  double coarseCorrelation(const std::vector<vision::GrayImage>& levels, const common::PinholeCamera& camera,
                           const PlanarPose& pose) const;
  /// In the level in which the pattern has about `size_px`. None if it leaves the picture, or turns away.
  std::optional<AlignedPattern> align(const std::vector<vision::GrayImage>& levels, const common::PinholeCamera& camera,
                                      const PlanarPose& start, double size_px) const;
  /// The same, with what the picture is blurred more than a box of `blur_px` among the parameters: to first order a
  /// blur adds second derivatives, also that of a motion, which blurs one direction alone.
  std::optional<AlignedPattern> alignFinely(const std::vector<vision::GrayImage>& levels,
                                            const common::PinholeCamera& camera, const PlanarPose& start,
                                            double size_px, double blur_px) const;
  /// How many pixels of that level one is the mean of, as a box. The outline of a round shape shrinks where it is
  /// blurred, so that a template of another sharpness would be placed too far away.
  double blur_px(const std::vector<vision::GrayImage>& levels, const common::PinholeCamera& camera,
                 const PlanarPose& pose, double size_px) const;
  /// The other pose that looks nearly the same; none where the two are one.
  std::optional<PlanarPose> mirrored(const common::PinholeCamera& camera, const PlanarPose& pose) const;
  Evidence evidence(const std::vector<vision::GrayImage>& levels, const common::PinholeCamera& camera,
                    const PlanarPose& pose) const;

 private:
  /// A place on the paper with what the template has there.
  struct Sample {
    Eigen::Vector2d point_m;
    double value;
    Eigen::Vector2d gradient_1_m;
    Eigen::Vector3d curvature;  ///< Second differences across, up and diagonally, over a pixel.
  };
  /// As a picture shows the template in which it has `size_px`.
  std::vector<Sample> samplesAt(double size_px, double blur_px) const;
  /// Between which levels of the template a pixel of a size lies.
  struct Sharpness {
    int finer_level = 0;
    float coarser_share = 0.0F;
  };
  Sharpness sharpness(double pixel_m) const;
  float templateValue(const Eigen::Vector2d& point_m, Sharpness sharpness) const;
  template <int kParameters>
  std::optional<AlignedPattern> alignWith(const std::vector<vision::GrayImage>& levels,
                                          const common::PinholeCamera& camera, const PlanarPose& start, double size_px,
                                          double blur_px) const;
  int levelOf(const std::vector<vision::GrayImage>& levels, double size_px, double wanted_px) const;

  PatternTemplate pattern_;
  std::vector<vision::GrayImage> template_levels_;
  double contrast_ = 0.0;  ///< Of the template: between its 5 % darkest and its 5 % brightest pixels.
};

}  // namespace swiftlet::perception
