// The pattern recognizer of Tomic 2012, section "Recognition", as published:
//
//   "A corner detector is applied to the template image to obtain interesting points. Small patches are then generated
//   around these points and stored in a database. A simple operation to calculate a descriptor of the patches based on
//   orientation histograms is used [17]. Subsequently, the descriptors are compared pairwise using normalized
//   cross-correlation, sorted in an arbitrary number of classes, and a Bayes classifier is learned. This results in a
//   sequence of descriptors, which in turn define the pattern."
//
// What the paper leaves open, and how it is read here: corners are those of Shi and Tomasi; the template is looked at
// in halved sizes; histograms begin at their most frequent orientation, since a landing zone is seen from every
// heading; classes are formed greedily; the classifier is naive and Gaussian; classified corners vote
// for place, turn and size of the pattern, and the similarity transform on which most of them agree is found by RANSAC
// with a random stream that is reset for each picture; the pose is fitted to these corners. Measured beside
// PatternRecognizer in docs/recognition.md.
#pragma once

#include <array>
#include <complex>
#include <vector>

#include "perception/recognition/orientation_histogram.hpp"
#include "perception/recognition/pattern_template.hpp"
#include "perception/recognition/planar_pose.hpp"
#include "perception/recognition/recognizer.hpp"

namespace swiftlet::perception {

class HistogramRecognizer final : public Recognizer {
 public:
  explicit HistogramRecognizer(const PatternTemplate& pattern);

  std::vector<Recognized> recognize(const Observation& observation) override;

 private:
  /// A corner of the template.
  struct Member {
    OrientationHistogram histogram;
    Eigen::Vector2d point_m;
    double pixel_m = 0.0;  ///< Of the level in which it was found.
  };
  /// Descriptors that look alike.
  struct PatchClass {
    std::array<double, kOrientationBins> mean{}, variance{};
    double log_prior = 0.0;
    std::vector<Member> members;
  };
  /// A corner of the picture that may be one of the template.
  struct Candidate {
    PlanarMatch match;
    double turn_rad = 0.0;  ///< Of the picture against the template, clockwise.
    double px_per_m = 0.0;  ///< By the levels in which both were found.
  };

  void learn();
  /// The class with the greatest posterior probability; null if no class is near.
  const PatchClass* classify(const OrientationHistogram& histogram) const;
  std::vector<Candidate> candidates(const vision::GrayImage& gray) const;
  /// Those that agree on the middle, the turn and the size of the pattern, where most do.
  std::vector<std::vector<Candidate>> fullestBins(const std::vector<Candidate>& candidates) const;
  /// Those that a similarity transform explains, each place of the template and of the picture once.
  std::vector<PlanarMatch> agreeing(const std::vector<Candidate>& candidates, std::complex<double> factor,
                                    std::complex<double> offset_px) const;

  PatternTemplate pattern_;
  std::vector<PatchClass> classes_;
};

}  // namespace swiftlet::perception
