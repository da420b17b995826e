#include "autonomy/arrivals/silence_watch.hpp"

#include <utility>

#include <fmt/format.h>

namespace swiftlet::autonomy {

using common::Time;

SilenceWatch::SilenceWatch(std::string sensor, std::string measurement, double silent_s, common::EventLog& log)
    : sensor_(std::move(sensor)),
      measurement_(std::move(measurement)),
      silence_(common::Duration::fromSeconds(silent_s)),
      log_(log) {}

void SilenceWatch::usableArrived(Time now) {
  since_ = now;
  if (silent_.update(false, now) == common::Edge::kLeft) log_.info(now, "mapping3d", sensor_ + " sends again");
}

void SilenceWatch::unusableArrived(Time now, const char* fault) {
  if (!since_) since_ = now;
  unusable_at_ = now;
  fault_ = fault;
}

void SilenceWatch::watch(Time now) {
  if (silent_.update(isDue(now), now) != common::Edge::kEntered) return;
  const bool sends = unusable_at_ && now - *unusable_at_ < silence_;
  if (!sends)
    return log_.warn(now, "mapping3d", sensor_ + " is silent",
                     fmt::format("no {} for {:.1f} s", measurement_, silence_.seconds()));
  log_.warn(now, "mapping3d", sensor_ + " sends nothing usable",
            fmt::format("no usable {} for {:.1f} s; the last one: {}", measurement_, silence_.seconds(), fault_));
}

}  // namespace swiftlet::autonomy
