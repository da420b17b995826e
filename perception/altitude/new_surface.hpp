// A new surface below the vehicle, until it was seen for long enough to be accepted.
#pragma once

#include <vector>

#include "common/tiled_grid.hpp"
#include "common/time.hpp"
#include "perception/altitude/ground_scan.hpp"
#include "perception/altitude/level_store.hpp"
#include "perception/altitude/multilevel_config.hpp"

namespace swiftlet::perception::altitude {

/// The least-squares line through the heights at which the surface was measured, scan by scan.
class NewSurface {
 public:
  explicit NewSurface(common::Time first) : first_(first) {}

  void add(const LevelSight& sight, double surface_m) {
    const double time_s = (sight.stamp - first_).seconds();
    ++scans;
    beams += sight.beams;
    last = sight;
    t_s_ += time_s;
    tt_s2_ += time_s * time_s;
    h_m_ += surface_m;
    th_m_s_ += time_s * surface_m;
  }
  double seenFor_s(common::Time now) const { return (now - first_).seconds(); }
  double height_m() const { return h_m_ / scans; }  ///< Mean over the scans.
  double rate_m_s() const { return spread_s2() > 0.0 ? (th_m_s_ - t_s_ * h_m_ / scans) / spread_s2() : 0.0; }
  /// Height of the line at `time`.
  double heightAt_m(common::Time time) const { return height_m() + rate_m_s() * (seenFor_s(time) - t_s_ / scans); }
  /// Sum of the squared deviations of the times from their mean. The variance of the rate is that of one height divided
  /// by this.
  double spread_s2() const { return tt_s2_ - t_s_ * t_s_ / scans; }

  int scans = 0;
  int beams = 0;  ///< Over all scans.
  LevelSight last;
  std::vector<common::CellIndex> cells;
  bool seen = true;  ///< Whether it was seen in the present scan.

 private:
  common::Time first_;
  double t_s_ = 0.0, tt_s2_ = 0.0, h_m_ = 0.0, th_m_s_ = 0.0;  ///< Sums over the scans.
};

/// Time for which a surface that rises or falls no faster than the error of the vertical speed must be seen (measured:
/// docs/decisions/altitude.md#095).
inline constexpr double kConfirmMoving_s = 1.0;
/// After this time a surface is no slope, as slopes in rooms are short, and no longer new.
inline constexpr double kLongestSight_s = 2.0 * kConfirmMoving_s;

double rateVariance_m2_s2(const MultilevelConfig& config, const NewSurface& surface);
/// Whether the surface is flat: measured at a constant height, unlike a slope, or rising or falling evenly because the
/// vertical speed is wrong. Two things support the latter: that it is seen for long, and that a level is known at its
/// height (`explained_by`, kNoLevel for none). The more of them, the greater the error of the speed may be.
bool isFlat(const MultilevelConfig& config, const NewSurface& surface, common::Time now, double speed_variance_m2_s2,
            int explained_by);

/// Algorithm 1, line 13: groups the beams that no level explains by neighbouring distance, for a vehicle at this
/// height. Afterwards `surfaces` are these groups; surfaces that are not seen again are removed.
void seeNewSurfaces(std::vector<NewSurface>& surfaces, const MultilevelConfig& config, const std::vector<Beam>& beams,
                    double height_m, common::Time now);

}  // namespace swiftlet::perception::altitude
