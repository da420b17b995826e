// The place of the vehicle in the given map, which may be loaded in flight.
#pragma once

#include <memory>

#include "autonomy/estimation/flight_localizer.hpp"
#include "common/event_log.hpp"
#include "common/jobs.hpp"

namespace swiftlet::autonomy {

/// A localizer as soon as there is a map; null before. One thread.
class GivenMapPlace {
 public:
  /// `given` may be null and is read only here.
  GivenMapPlace(const GivenMap* given, const FlightLocalizerConfig& config, common::JobRunner& jobs,
                common::EventLog& log)
      : config_(config), jobs_(jobs), log_(log) {
    if (given != nullptr) load(*given);
  }

  void load(const GivenMap& given) {
    if (localizer_)
      localizer_->load(given);
    else
      localizer_ = std::make_unique<FlightLocalizer>(given, config_, jobs_, log_);
  }
  explicit operator bool() const { return localizer_ != nullptr; }
  FlightLocalizer* operator->() { return localizer_.get(); }
  const FlightLocalizer* operator->() const { return localizer_.get(); }

 private:
  FlightLocalizerConfig config_;
  common::JobRunner& jobs_;
  common::EventLog& log_;
  std::unique_ptr<FlightLocalizer> localizer_;
};

}  // namespace swiftlet::autonomy
