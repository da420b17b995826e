// Recognizes AprilTags of the family 36h11 by Debian's libapriltag (E. Olson, "AprilTag: a robust and flexible visual
// fiducial system", ICRA 2011; J. Wang, E. Olson, "AprilTag 2", IROS 2016).
//
// The frame of a tag is that of a pattern: origin at its middle, x right, y to its top, z out of the paper.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "common/message.hpp"
#include "perception/recognition/recognizer.hpp"

namespace swiftlet::perception {

/// A tag that is looked for.
struct KnownTag {
  std::string name;
  int id = 0;             ///< In the family 36h11: 0 to 586.
  double border_m = 0.0;  ///< Side of the black square. The printed tag with its white margin is 1.25 times as wide.
};

class TagRecognizer final : public Recognizer {
 public:
  static tl::expected<TagRecognizer, common::Message> create(std::vector<KnownTag> tags);
  TagRecognizer(TagRecognizer&&) noexcept;
  TagRecognizer& operator=(TagRecognizer&&) noexcept;
  ~TagRecognizer() override;

  std::vector<Recognized> recognize(const Observation& observation) override;

 private:
  class Detector;
  explicit TagRecognizer(std::vector<KnownTag> tags);

  std::vector<KnownTag> tags_;
  std::unique_ptr<Detector> detector_;
};

/// The tag as a picture, with its white margin; a cell has `cell_px` pixels on each side. `id` must be valid.
vision::GrayImage drawTag(int id, int cell_px);

}  // namespace swiftlet::perception
