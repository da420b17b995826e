#include "benchmarks/rgbd_peers/opencv_odometry.hpp"

#include <opencv2/core.hpp>
#include <opencv2/rgbd.hpp>

#include "interfaces/rgbd/rgbd_calibration.hpp"

namespace swiftlet::rgbd_peers {
namespace {

class OpencvOdometry final : public Peer {
 public:
  explicit OpencvOdometry(const std::string& kind) : odometry_(cv::rgbd::Odometry::create(kind)) {}

  void add(const RecordedFrame&, const mapping3d::PyramidLevel& small) override {
    const common::PinholeCamera& camera = small.camera;
    odometry_->setCameraMatrix(
        (cv::Mat_<double>(3, 3) << camera.fx_px, 0.0, camera.cx_px, 0.0, camera.fy_px, camera.cy_px, 0.0, 0.0, 1.0));
    const cv::Mat gray(camera.height_px, camera.width_px, CV_8U, const_cast<std::uint8_t*>(small.gray.values.data()));
    const cv::Mat depth(camera.height_px, camera.width_px, CV_32F, const_cast<float*>(small.depth.depth_m.data()));
    auto frame = cv::rgbd::OdometryFrame::create(gray.clone(), depth.clone());
    cv::Mat T_new_last;
    const bool placed = !last_ || odometry_->compute(last_, frame, T_new_last);
    poses_.emplace_back();
    // A frame that was not placed is passed over: the next one is compared with the last that was.
    if (!placed) return;
    if (last_) T_map_optical_ = T_map_optical_ * poseOf(T_new_last).inverse();
    last_ = frame;
    poses_.back() = interfaces::T_camera_optical() * T_map_optical_ * interfaces::T_camera_optical().inverse();
  }

  std::vector<std::optional<common::Pose3>> finish() override { return poses_; }

 private:
  static common::Pose3 poseOf(const cv::Mat& matrix) {
    Eigen::Matrix3d rotation;
    Eigen::Vector3d position_m;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) rotation(row, column) = matrix.at<double>(row, column);
      position_m[row] = matrix.at<double>(row, 3);
    }
    return {Eigen::Quaterniond(rotation).normalized(), position_m};
  }

  cv::Ptr<cv::rgbd::Odometry> odometry_;
  cv::Ptr<cv::rgbd::OdometryFrame> last_;
  common::Pose3 T_map_optical_;
  std::vector<std::optional<common::Pose3>> poses_;
};

}  // namespace

std::vector<Contender> opencvContenders() {
  cv::setNumThreads(1);  // As ours have.
  std::vector<Contender> contenders;
  for (const std::string kind : {"RgbdOdometry", "ICPOdometry", "RgbdICPOdometry"})
    contenders.push_back({"cv::rgbd " + kind, [kind] { return std::make_unique<OpencvOdometry>(kind); }});
  return contenders;
}

}  // namespace swiftlet::rgbd_peers
