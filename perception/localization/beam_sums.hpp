// The inner loop of Monte Carlo localization: for each particle, the sum of the field's bytes at the end points of a
// scan's beams. There is one version per instruction set, chosen at run time; all round alike and give the same bits.
#pragma once

#include <cstdint>
#include <span>

#include "perception/localization/map_field.hpp"
#include "perception/scan_matching/window_sums.hpp"

namespace swiftlet::perception {

/// Poses in cells of the field: (x, y) from the corner of cell (0, 0), the heading as its cosine and sine. The spans
/// have equal length.
struct CellPoses {
  std::span<const float> x;
  std::span<const float> y;
  std::span<const float> cosine;
  std::span<const float> sine;
};

/// End points of beams in the body frame, in cells of the field. The spans have equal length.
struct CellBeams {
  std::span<const float> x;
  std::span<const float> y;
};

/// sums[i] is the sum, over the beams, of the field's value at the beam's end point transformed by pose i. End points
/// outside the field take the value of its border. `sums` is as long as the poses. At most 2^23 beams; the field has at
/// most 2^30 cells.
void sumBeams(Instructions instructions, const FieldView& field, const CellPoses& poses, const CellBeams& beams,
              std::span<std::int32_t> sums);

}  // namespace swiftlet::perception
