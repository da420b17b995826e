// What one number of a nature is drawn from.
#pragma once

namespace swiftlet::simulation {

/// In the unit of the number; both ends are equal if it is fixed.
struct NatureRange {
  double low = 0.0;
  double high = 0.0;
};

}  // namespace swiftlet::simulation
