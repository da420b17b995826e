// Recognizes an arbitrary picture that is printed in a known size, from one picture of the camera.
//
//   picture --> pyramid --> closed curves --> polar patches --> turned against those of the template: affine hypotheses
//           --> two poses each --> coarse correlation: the best few --> direct alignment, coarse to fine
//           --> evidence cell by cell: recognized or not
//
// One shape that is seen whole is enough to begin with, so that the others may be hidden. Nothing is random.
#pragma once

#include <optional>
#include <vector>

#include "perception/recognition/known_shapes.hpp"
#include "perception/recognition/pattern_alignment.hpp"
#include "perception/recognition/pattern_template.hpp"
#include "perception/recognition/recognizer.hpp"

namespace swiftlet::perception {

class PatternRecognizer final : public Recognizer {
 public:
  explicit PatternRecognizer(const PatternTemplate& pattern);

  std::vector<Recognized> recognize(const Observation& observation) override;

  const std::vector<KnownShape>& shapes() const { return shapes_; }

 private:
  struct Hypothesis {
    PlanarPose pose;
    double score = 0.0;
  };
  std::vector<Hypothesis> hypotheses(const std::vector<vision::GrayImage>& levels,
                                     const common::PinholeCamera& camera) const;
  /// The better of the two poses that look nearly the same.
  std::optional<AlignedPattern> alignedFinely(const std::vector<vision::GrayImage>& levels,
                                              const common::PinholeCamera& camera, const PlanarPose& start) const;

  PatternTemplate pattern_;
  PatternAligner aligner_;
  std::vector<KnownShape> shapes_;
};

}  // namespace swiftlet::perception
