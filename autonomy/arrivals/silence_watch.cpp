#include "autonomy/arrivals/silence_watch.hpp"

#include <utility>

#include <fmt/format.h>

namespace swiftlet::autonomy {

using common::Time;

SilenceWatch::SilenceWatch(std::string sensor, std::string measurement, double silent_s, common::EventLog& log)
    : sensor_(std::move(sensor)),
      measurement_(std::move(measurement)),
      silent_s_(silent_s),
      silence_(common::Duration::fromSeconds(silent_s)),
      log_(log) {}

void SilenceWatch::usableArrived(Time now) {
  since_ = now;
  if (std::exchange(silent_, false)) log_.info(now, "mapping3d", sensor_ + " sends again");
}

void SilenceWatch::unusableArrived(Time now, const char* fault) {
  if (!since_) since_ = now;
  unusable_at_ = now;
  fault_ = fault;
}

void SilenceWatch::watch(Time now) {
  if (silent_ || !isDue(now)) return;
  silent_ = true;
  const bool sends = unusable_at_ && now - *unusable_at_ < silence_;
  if (!sends)
    return log_.warn(now, "mapping3d", sensor_ + " is silent",
                     fmt::format("no {} for {:.1f} s", measurement_, silent_s_));
  log_.warn(now, "mapping3d", sensor_ + " sends nothing usable",
            fmt::format("no {} that can be used for {:.1f} s; of the last one: {}", measurement_, silent_s_, fault_));
}

}  // namespace swiftlet::autonomy
