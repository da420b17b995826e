#include "autonomy/arrivals/silence_watch.hpp"

#include <utility>

#include <fmt/format.h>

namespace swiftlet::autonomy {

using common::Event;
using common::Severity;
using common::Time;

SilenceWatch::SilenceWatch(std::string sensor, std::string measurement, double silent_s)
    : sensor_(std::move(sensor)),
      measurement_(std::move(measurement)),
      silent_s_(silent_s),
      silence_(common::Duration::fromSeconds(silent_s)) {}

std::optional<Event> SilenceWatch::usableArrived(Time now) {
  since_ = now;
  if (!std::exchange(said_, false)) return std::nullopt;
  return Event{now, Severity::kInfo, "mapping3d", sensor_ + " sends again", {}};
}

void SilenceWatch::unusableArrived(Time now, const char* fault) {
  if (!since_) since_ = now;
  unusable_at_ = now;
  fault_ = fault;
}

std::optional<Event> SilenceWatch::watch(Time now) {
  if (said_ || !isDue(now)) return std::nullopt;
  said_ = true;
  const bool sends = unusable_at_ && now - *unusable_at_ < silence_;
  if (!sends)
    return Event{now, Severity::kWarning, "mapping3d", sensor_ + " is silent",
                 fmt::format("no {} for {:.1f} s", measurement_, silent_s_)};
  return Event{
      now, Severity::kWarning, "mapping3d", sensor_ + " sends nothing usable",
      fmt::format("no {} that can be used for {:.1f} s; of the last one: {}", measurement_, silent_s_, fault_)};
}

}  // namespace swiftlet::autonomy
