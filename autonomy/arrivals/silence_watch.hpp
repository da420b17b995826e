// Notices a sensor that sends nothing, or nothing that can be used.
#pragma once

#include <optional>
#include <string>

#include "common/event_log.hpp"
#include "common/hysteresis.hpp"
#include "common/time.hpp"

namespace swiftlet::autonomy {

/// One thread. The silence counts from the last usable measurement, or from the first of all while none was usable. A
/// sensor that has never sent is not silent.
class SilenceWatch {
 public:
  /// For people: "camera" sends a "frame".
  SilenceWatch(std::string sensor, std::string measurement, double silent_s, common::EventLog& log);

  void usableArrived(common::Time now);
  /// `fault`: why it cannot be used, for people.
  void unusableArrived(common::Time now, const char* fault);
  /// To be called at every tick.
  void watch(common::Time now);

  bool isDue(common::Time now) const { return since_ && now - *since_ >= silence_; }
  /// Start of the silence; nullopt before the first measurement.
  std::optional<common::Time> since() const { return since_; }

 private:
  std::string sensor_, measurement_;
  common::Duration silence_;
  std::optional<common::Time> since_, unusable_at_;
  std::string fault_;  ///< Of the last measurement that could not be used.
  common::Hysteresis silent_;
  common::EventLog& log_;
};

}  // namespace swiftlet::autonomy
