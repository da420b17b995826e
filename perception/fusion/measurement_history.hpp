// The measurements in the history of the fusion filter, in the order in which they are applied, which does not depend
// on the order of arrival.
#pragma once

#include <span>
#include <vector>

#include "common/time.hpp"
#include "perception/fusion/measurement.hpp"

namespace swiftlet::perception::fusion {

/// Measurements of the same kind and time are ordered by their values, so that their order does not depend on arrival
/// either.
class MeasurementHistory {
 public:
  explicit MeasurementHistory(std::size_t capacity);

  void clear() { measurements_.clear(); }
  /// False if the history is full; nothing changes then.
  bool insert(const Measurement& measurement);
  /// Drops measurements at or before `time`. Up to 31 of them may stay until a later call.
  void dropUntil(common::Time time);
  /// The measurements with after < stamp <= until.
  std::span<const Measurement> within(common::Time after, common::Time until) const;
  bool holdsClone(common::Time time) const;

 private:
  std::vector<Measurement> measurements_;
  std::size_t capacity_;
};

}  // namespace swiftlet::perception::fusion
