// The inner loop of Monte Carlo localization: for each particle, the sum of the field's bytes where the beams of a scan
// would end. One version per instruction set, chosen at run time; all round the same and give the same bits.
#pragma once

#include <cstdint>
#include <span>

#include "perception/localization/map_field.hpp"
#include "perception/scan_matching/window_sums.hpp"

namespace swiftlet::perception {

/// Poses in cells of the field: (x, y) from the corner of cell (0, 0), the direction as its cosine and sine. Spans of
/// equal length.
struct CellPoses {
  std::span<const float> x;
  std::span<const float> y;
  std::span<const float> cosine;
  std::span<const float> sine;
};

/// End points of beams in the body frame, in cells of the field. Spans of equal length.
struct CellBeams {
  std::span<const float> x;
  std::span<const float> y;
};

/// sums[i] = sum over the beams of the field at pose i applied to the beam's end; ends outside the field have the value
/// of its border. `sums` is as long as the poses. At most 2^23 beams; the field has at most 2^30 cells.
void sumBeams(Instructions instructions, const FieldView& field, const CellPoses& poses, const CellBeams& beams,
              std::span<std::int32_t> sums);

}  // namespace swiftlet::perception
