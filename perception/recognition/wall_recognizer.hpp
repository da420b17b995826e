// Walls and corners of a scan as recognized objects: `wall`, whose frame is at the middle of what is seen of it with x
// along its normal towards the laser, and `corner`, with x along the bisector into the space that the laser sees.
#pragma once

#include <vector>

#include "perception/recognition/recognizer.hpp"
#include "perception/recognition/scan_lines.hpp"

namespace swiftlet::perception {

class WallRecognizer final : public Recognizer {
 public:
  explicit WallRecognizer(const ScanLineConfig& config) : config_(config) {}

  std::vector<Recognized> recognize(const Observation& observation) override;

 private:
  ScanLineConfig config_;
};

}  // namespace swiftlet::perception
