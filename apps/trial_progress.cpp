#include "apps/trial_progress.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "apps/show.hpp"

namespace swiftlet::apps {

TrialProgress::TrialProgress(int flights, bool quiet) : flights_(flights), quiet_(quiet), line_(quiet) {}

void TrialProgress::flies(const std::string& flight, double simulated_s) {
  const std::scoped_lock lock(mutex_);
  if (!line_.interactive()) return;
  now_ = fmt::format("{} at {:.0f} s", flight, simulated_s);
  const double wall_s = flight::secondsSince(begin_);
  std::optional<double> left_s;
  if (flown_ > 0) left_s = std::max(0.0, flown_wall_s_ * flights_ / flown_ - wall_s);
  line_.update(text(), wall_s, left_s);
}

void TrialProgress::over(const std::string& lines, bool passed) {
  const std::scoped_lock lock(mutex_);
  ++flown_;
  failed_ += passed ? 0 : 1;
  flown_wall_s_ = flight::secondsSince(begin_);
  line_.close();
  if (!quiet_) show(lines);
}

void TrialProgress::close() {
  const std::scoped_lock lock(mutex_);
  line_.close();
}

std::string TrialProgress::text() const {
  const std::string failed = failed_ > 0 ? fmt::format(", {} failed", failed_) : "";
  return fmt::format("{:3.0f} %  {} of {} flights{}, {}", 100.0 * flown_ / flights_, flown_, flights_, failed, now_);
}

}  // namespace swiftlet::apps
