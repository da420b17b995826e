#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>

#include "benchmarks/rgbd_peers/opencv_odometry.hpp"
#include "interfaces/rgbd/rgbd_calibration.hpp"

namespace swiftlet::rgbd_peers {
namespace {

/// Against the last key frame. A frame that shares too few corners with it becomes the next one.
class OrbPnp final : public Peer {
 public:
  void add(const RecordedFrame&, const mapping3d::PyramidLevel& small) override {
    const common::PinholeCamera& camera = small.camera;
    const cv::Mat gray(camera.height_px, camera.width_px, CV_8U, const_cast<std::uint8_t*>(small.gray.values.data()));
    std::vector<cv::KeyPoint> corners;
    cv::Mat descriptors;
    orb_->detectAndCompute(gray, cv::noArray(), corners, descriptors);
    const int inliers = place(camera, corners, descriptors);
    poses_.emplace_back();
    if (inliers < kLeastInliers && !points_.empty()) return;
    if (inliers < kFewInliers) keep(small, corners, descriptors);
    poses_.back() = interfaces::T_camera_optical() * T_map_optical_ * interfaces::T_camera_optical().inverse();
  }

  std::vector<std::optional<common::Pose3>> finish() override { return poses_; }

 private:
  static constexpr int kLeastInliers = 12, kFewInliers = 100;

  int place(const common::PinholeCamera& camera, const std::vector<cv::KeyPoint>& corners, const cv::Mat& descriptors) {
    std::vector<cv::DMatch> matches;
    if (!points_.empty() && !descriptors.empty()) matcher_.match(descriptors, descriptors_, matches);
    std::vector<cv::Point3f> points;
    std::vector<cv::Point2f> pixels;
    for (const cv::DMatch& match : matches) {
      points.push_back(points_[static_cast<std::size_t>(match.trainIdx)]);
      pixels.push_back(corners[static_cast<std::size_t>(match.queryIdx)].pt);
    }
    const cv::Matx33d lens(camera.fx_px, 0.0, camera.cx_px, 0.0, camera.fy_px, camera.cy_px, 0.0, 0.0, 1.0);
    cv::Mat turn, shift, inliers, rotation;
    constexpr int kTrials = 300;
    constexpr float kWithin_px = 2.0F;
    if (points.size() < static_cast<std::size_t>(kLeastInliers) ||
        !cv::solvePnPRansac(points, pixels, lens, cv::noArray(), turn, shift, false, kTrials, kWithin_px, 0.99,
                            inliers))
      return 0;
    cv::Rodrigues(turn, rotation);
    Eigen::Matrix3d R_camera_key;
    for (int i = 0; i < 9; ++i) R_camera_key(i / 3, i % 3) = rotation.at<double>(i / 3, i % 3);
    const common::Pose3 T_camera_key{Eigen::Quaterniond(R_camera_key).normalized(),
                                     {shift.at<double>(0), shift.at<double>(1), shift.at<double>(2)}};
    if (inliers.rows >= kLeastInliers) T_map_optical_ = T_map_key_ * T_camera_key.inverse();
    return inliers.rows;
  }

  void keep(const mapping3d::PyramidLevel& small, const std::vector<cv::KeyPoint>& corners,
            const cv::Mat& descriptors) {
    points_.clear();
    descriptors_ = cv::Mat();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const float depth_m = small.depth.at(static_cast<int>(corners[i].pt.x), static_cast<int>(corners[i].pt.y));
      if (!common::isMeasured(depth_m)) continue;
      const Eigen::Vector3d at = small.camera.point_camera_m(corners[i].pt.x, corners[i].pt.y, depth_m);
      points_.emplace_back(-at.y(), -at.z(), at.x());
      descriptors_.push_back(descriptors.row(static_cast<int>(i)));
    }
    T_map_key_ = T_map_optical_;
  }

  cv::Ptr<cv::ORB> orb_ = cv::ORB::create(1000);
  cv::BFMatcher matcher_{cv::NORM_HAMMING, true};
  std::vector<cv::Point3f> points_;  ///< Of the key frame, in axes of image processing.
  cv::Mat descriptors_;
  common::Pose3 T_map_key_, T_map_optical_;
  std::vector<std::optional<common::Pose3>> poses_;
};

}  // namespace

std::vector<Contender> orbPnpContenders() {
  cv::setNumThreads(1);
  return {{"cv::ORB, solvePnPRansac", [] { return std::make_unique<OrbPnp>(); }}};
}

}  // namespace swiftlet::rgbd_peers
