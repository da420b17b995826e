// A house of known shape, in the depths and the picture of a camera that looks at it from above (Tomic 2012, section
// "Recognition").
//
//   depths --> ground, groups that stand on it --> PCA and ICP of the shape --> does it explain the picture of depths?
//          --> chimney in the grey picture: which end is which, and where --> pose with covariance
//
// The pose is that of HouseModel's axes; the size is the length and the width.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "perception/recognition/house_model.hpp"
#include "perception/recognition/recognizer.hpp"

namespace swiftlet::perception {

struct HouseConfig {
  std::string name;
  HouseModel model;
  double inverse_depth_sigma_1_m = 0.00165;  ///< Of a pixel, noise and steps together; by the camera's data sheet.
  double range_max_m = 8.0;                  ///< Depths beyond are not looked at.
};

/// Needs a picture and depths of the same camera.
class HouseRecognizer final : public Recognizer {
 public:
  explicit HouseRecognizer(HouseConfig config) : config_(std::move(config)) {}

  std::vector<Recognized> recognize(const Observation& observation) override;

 private:
  HouseConfig config_;
};

}  // namespace swiftlet::perception
