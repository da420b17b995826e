// What a depth of one metre is stored as, told from the stored numbers.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace swiftlet::interfaces {

struct DepthUnits {
  double per_m = 0.0;
  std::string note;  ///< For people: what was assumed, or what is doubtful; empty if nothing is odd.
};

/// The units of a recording whose format stores `usual_per_m` a metre, from some of its codes (0: not measured):
/// millimetres or 1/5000 m. The usual one stays unless the codes speak against it: they would be nearer or farther than
/// such cameras measure, or all of them are whole multiples of five, as only millimetres stored as 1/5000 m are. Where
/// the other unit is possible too, the note says so.
DepthUnits depthUnitsOf(const std::vector<std::uint16_t>& codes, double usual_per_m);

}  // namespace swiftlet::interfaces
