// The error-state filter, the listener to its inputs, and which relative poses it gets.
#pragma once

#include <optional>
#include <string>

#include <tl/expected.hpp>

#include "common/event_log.hpp"
#include "common/time.hpp"
#include "perception/fusion/error_state_filter.hpp"
#include "perception/fusion/filter_tape.hpp"
#include "perception/fusion/odometry_choice.hpp"

namespace swiftlet::autonomy {

/// One thread. Only this class changes the filter.
class HeardFilter {
 public:
  explicit HeardFilter(const perception::FusionConfig& config) : filter_(config), choice_(config.odometry_choice) {}

  /// Gets all inputs of the filter from now on; null for no listener. It must outlive this.
  void setListener(perception::FilterListener* listener) { listener_ = listener; }
  /// Gives the input to the listener and then to the filter. Returns what perception::tell returns.
  tl::expected<perception::Insertion, std::string> tell(const perception::FilterInput& input) {
    if (listener_ != nullptr) listener_->heard(input);
    return perception::tell(filter_, input);
  }
  /// Whether the filter is to be told the relative pose that a sensor measured in its turn; nullopt if it measured
  /// none. Says when the sensor that is used has changed.
  bool uses(perception::OdometrySource source, const std::optional<perception::Measurement>& measurement,
            common::Time now, common::EventLog& log);
  /// Says when the filter's health has changed.
  void reportHealth(common::Time now, common::EventLog& log);
  const perception::ErrorStateFilter* operator->() const { return &filter_; }
  const perception::ErrorStateFilter& operator*() const { return filter_; }

 private:
  perception::ErrorStateFilter filter_;
  perception::OdometryChoice choice_;
  perception::FilterListener* listener_ = nullptr;
  perception::FusionStatus reported_ = perception::FusionStatus::kNotInitialized;
};

}  // namespace swiftlet::autonomy
