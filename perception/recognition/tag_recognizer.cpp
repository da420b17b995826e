#include "perception/recognition/tag_recognizer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include <Eigen/LU>

extern "C" {
#include <apriltag/apriltag.h>
#include <apriltag/apriltag_pose.h>
#include <apriltag/tag36h11.h>
}

#include "perception/recognition/planar_pose.hpp"

namespace swiftlet::perception {
namespace {

using common::Message;

constexpr int kTags = 587;
/// Standard deviation of a coordinate of a corner, at least: four corners leave two degrees of freedom, too few to
/// trust their residuals alone.
constexpr double kLeastCornerSigma_px = 0.1;
/// A decision margin that is as good as any.
constexpr double kSureMargin = 50.0;

class Family {
 public:
  Family() : family_(tag36h11_create()) {}
  ~Family() { tag36h11_destroy(family_); }
  Family(const Family&) = delete;
  Family& operator=(const Family&) = delete;
  apriltag_family_t* get() const { return family_; }

 private:
  apriltag_family_t* family_;
};

PlanarPose poseOf(const apriltag_pose_t& found) {
  // The library's tag has y down and z into the paper.
  PlanarPose pose;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      pose.rotation(row, column) = MATD_EL(found.R, row, column) * (column == 0 ? 1.0 : -1.0);
    pose.position_m[row] = MATD_EL(found.t, row, 0);
  }
  return pose;
}

/// The pose by the library, its covariance from what the corners differ from it.
Recognized recognizedTag(const KnownTag& tag, apriltag_detection_t& detection, const common::PinholeCamera& camera) {
  // The library's pixels begin at their corner, ours at their centre.
  for (auto& corner : detection.p)
    for (double& coordinate : corner) coordinate -= 0.5;
  const Eigen::Matrix3d shift = (Eigen::Matrix3d() << 1.0, 0.0, -0.5, 0.0, 1.0, -0.5, 0.0, 0.0, 1.0).finished();
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> homography(detection.H->data);
  homography = (shift * homography).eval();
  apriltag_detection_info_t info{&detection, tag.border_m, camera.fx_px, camera.fy_px, camera.cx_px, camera.cy_px};
  apriltag_pose_t found{};
  estimate_tag_pose(&info, &found);
  const PlanarPose pose = poseOf(found);
  // Debian's library does not export matd_destroy; a matrix is one block of calloc.
  std::free(found.R);
  std::free(found.t);

  // The library's corners go around from the lower left, seen as the tag stands.
  const double half = 0.5 * tag.border_m;
  const std::array<Eigen::Vector2d, 4> corners = {Eigen::Vector2d(-half, -half), Eigen::Vector2d(half, -half),
                                                  Eigen::Vector2d(half, half), Eigen::Vector2d(-half, half)};
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  double squares = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d point = pose * corners[i];
    const PixelJacobian jacobian = pixelJacobian(camera, pose, point);
    information += jacobian.transpose() * jacobian;
    squares += (pixelOf(camera, point) - Eigen::Vector2d(detection.p[i][0], detection.p[i][1])).squaredNorm();
  }
  const double variance = std::max(kLeastCornerSigma_px * kLeastCornerSigma_px, squares / 2.0);
  return {tag.name, T_camera_plane(pose), inCameraAxes(variance * information.inverse()),
          std::clamp(static_cast<double>(detection.decision_margin) / kSureMargin, 1e-3, 1.0)};
}

}  // namespace

class TagRecognizer::Detector {
 public:
  Detector() : detector_(apriltag_detector_create()) {
    apriltag_detector_add_family(detector_, family_.get());
    detector_->nthreads = 1;
    // At full resolution: half of it, the library's default, loses tags of 40 px.
    detector_->quad_decimate = 1.0F;
  }
  ~Detector() { apriltag_detector_destroy(detector_); }
  Detector(const Detector&) = delete;
  Detector& operator=(const Detector&) = delete;

  apriltag_detector_t* get() const { return detector_; }

 private:
  Family family_;
  apriltag_detector_t* detector_;
};

TagRecognizer::TagRecognizer(std::vector<KnownTag> tags)
    : tags_(std::move(tags)), detector_(std::make_unique<Detector>()) {}
TagRecognizer::TagRecognizer(TagRecognizer&&) noexcept = default;
TagRecognizer& TagRecognizer::operator=(TagRecognizer&&) noexcept = default;
TagRecognizer::~TagRecognizer() = default;

tl::expected<TagRecognizer, Message> TagRecognizer::create(std::vector<KnownTag> tags) {
  for (const KnownTag& tag : tags) {
    if (tag.id < 0 || tag.id >= kTags)
      return tl::unexpected(Message("tag.no-id", "has the id {}; those of 36h11 are 0 to {}", tag.id, kTags - 1));
    if (!(std::isfinite(tag.border_m) && tag.border_m > 0.0))
      return tl::unexpected(Message("tag.no-size", "is {} m wide; a tag has a size above 0", tag.border_m));
  }
  return TagRecognizer(std::move(tags));
}

std::vector<Recognized> TagRecognizer::recognize(const Observation& observation) {
  if (!hasWholePicture(observation)) return {};
  const vision::GrayImage& gray = observation.picture->gray;
  // The library only reads the picture; it is not const there.
  image_u8_t image{gray.width_px, gray.height_px, gray.width_px, const_cast<std::uint8_t*>(gray.values.data())};
  zarray_t* const detections = apriltag_detector_detect(detector_->get(), &image);
  std::vector<Recognized> recognized;
  for (int i = 0; i < zarray_size(detections); ++i) {
    apriltag_detection_t* detection = nullptr;
    zarray_get(detections, i, &detection);
    const auto tag =
        std::find_if(tags_.begin(), tags_.end(), [&](const KnownTag& known) { return known.id == detection->id; });
    if (tag != tags_.end()) recognized.push_back(recognizedTag(*tag, *detection, observation.picture->camera));
  }
  apriltag_detections_destroy(detections);
  std::stable_sort(recognized.begin(), recognized.end(),
                   [](const Recognized& a, const Recognized& b) { return a.confidence > b.confidence; });
  return recognized;
}

vision::GrayImage drawTag(int id, int cell_px) {
  const Family family;
  image_u8_t* const cells = apriltag_to_image(family.get(), static_cast<std::uint32_t>(id));
  vision::GrayImage picture{cells->width * cell_px, cells->height * cell_px, {}};
  for (int v = 0; v < picture.height_px; ++v)
    for (int u = 0; u < picture.width_px; ++u)
      picture.values.push_back(cells->buf[(v / cell_px) * cells->stride + u / cell_px]);
  // Nor image_u8_destroy: the pixels and what describes them.
  std::free(cells->buf);
  std::free(cells);
  return picture;
}

}  // namespace swiftlet::perception
