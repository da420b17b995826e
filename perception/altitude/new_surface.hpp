// A surface that is new below the vehicle, until it was seen for long enough to be believed.
#pragma once

#include <vector>

#include "common/tiled_grid.hpp"
#include "common/time.hpp"
#include "perception/altitude/ground_scan.hpp"
#include "perception/altitude/level_store.hpp"
#include "perception/altitude/multilevel_config.hpp"

namespace swiftlet::perception::altitude {

/// The least-squares line through the heights it was met at, scan by scan.
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
  double height_m() const { return h_m_ / scans; }  ///< Mean.
  double rate_m_s() const { return spread_s2() > 0.0 ? (th_m_s_ - t_s_ * h_m_ / scans) / spread_s2() : 0.0; }
  /// On the line.
  double heightAt_m(common::Time time) const { return height_m() + rate_m_s() * (seenFor_s(time) - t_s_ / scans); }
  /// The squared length of the time axis; the variance of the rate is that of one height over this.
  double spread_s2() const { return tt_s2_ - t_s_ * t_s_ / scans; }

  int scans = 0;
  int beams = 0;  ///< Of all scans.
  LevelSight last;
  std::vector<common::CellIndex> cells;
  bool seen = true;  ///< In the present scan.

 private:
  common::Time first_;
  double t_s_ = 0.0, tt_s2_ = 0.0, h_m_ = 0.0, th_m_s_ = 0.0;  ///< Sums over the scans.
};

double rateVariance_m2_s2(const MultilevelConfig& config, const NewSurface& surface);
/// A surface that is flat is met at one height; a slope is not.
bool isFlat(const MultilevelConfig& config, const NewSurface& surface, common::Time now);
/// One that rises or falls evenly may be a slope, or flat and the vertical speed is wrong. Slopes in rooms are short.
bool isFlatSeenFromAMovingPlace(const MultilevelConfig& config, const NewSurface& surface, common::Time now,
                                double speed_variance_m2_s2);

/// Algorithm 1, line 13: the beams that no level explains, in sets of neighbouring distance, for a vehicle at this
/// height. Those sets are the surfaces afterwards; what is not seen again is forgotten.
void seeNewSurfaces(std::vector<NewSurface>& surfaces, const MultilevelConfig& config, const std::vector<Beam>& beams,
                    double height_m, common::Time now);

}  // namespace swiftlet::perception::altitude
