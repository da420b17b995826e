// A picture that is looked for, and how large it is printed.
//
// The frame `pattern`: origin at the middle of the picture, x to its right, y to its top, z out of the paper to whom
// looks at it.
#pragma once

#include <string>
#include <string_view>

#include <Eigen/Core>
#include <tl/expected.hpp>

#include "common/message.hpp"
#include "vision/gray_image.hpp"

namespace swiftlet::perception {

class PatternTemplate {
 public:
  /// Refused: a size that is not a positive number, a picture with a side under 16 px or more than 8 times the other,
  /// and a picture without corners, which shows no place.
  static tl::expected<PatternTemplate, common::Message> create(std::string name, vision::GrayImage picture,
                                                               double width_m);
  /// The same from the bytes of a PNG or JPEG; what is transparent is white.
  static tl::expected<PatternTemplate, common::Message> read(std::string name, std::string_view bytes, double width_m);

  const std::string& name() const { return name_; }
  const vision::GrayImage& picture() const { return picture_; }
  double metresPerPixel() const { return width_m_ / picture_.width_px; }
  double width_m() const { return width_m_; }
  double height_m() const { return picture_.height_px * metresPerPixel(); }

  /// The place on the paper of a pixel; integers are the centres of pixels.
  Eigen::Vector2d point_pattern_m(const Eigen::Vector2d& pixel) const {
    const double scale = metresPerPixel();
    return {(pixel.x() + 0.5 - 0.5 * picture_.width_px) * scale, -(pixel.y() + 0.5 - 0.5 * picture_.height_px) * scale};
  }
  Eigen::Vector2d pixel(const Eigen::Vector2d& point_pattern_m) const {
    const double scale = metresPerPixel();
    return {point_pattern_m.x() / scale + 0.5 * picture_.width_px - 0.5,
            -point_pattern_m.y() / scale + 0.5 * picture_.height_px - 0.5};
  }

 private:
  PatternTemplate(std::string name, vision::GrayImage picture, double width_m);

  std::string name_;
  vision::GrayImage picture_;
  double width_m_ = 0.0;
};

}  // namespace swiftlet::perception
