// Time and Duration: 64-bit nanoseconds as strong types, so that two stamps cannot be added.
// Values are plain data; safe to use from any thread.
#pragma once

#include <cmath>
#include <compare>
#include <cstdint>

namespace swiftlet::common {

/// A span of time, possibly negative.
class Duration {
 public:
  constexpr Duration() = default;

  static constexpr Duration fromNanoseconds(std::int64_t ns) { return Duration(ns); }
  static constexpr Duration fromMilliseconds(std::int64_t ms) { return Duration(ms * 1'000'000); }
  /// Rounds to the nearest nanosecond. The value must be finite and below 292 years.
  static Duration fromSeconds(double s) { return Duration(static_cast<std::int64_t>(std::llround(s * 1e9))); }

  constexpr std::int64_t nanoseconds() const { return ns_; }
  constexpr double seconds() const { return static_cast<double>(ns_) * 1e-9; }

  constexpr auto operator<=>(const Duration&) const = default;
  constexpr Duration operator+(Duration other) const { return Duration(ns_ + other.ns_); }
  constexpr Duration operator-(Duration other) const { return Duration(ns_ - other.ns_); }
  constexpr Duration operator-() const { return Duration(-ns_); }
  constexpr Duration operator*(std::int64_t n) const { return Duration(ns_ * n); }
  constexpr Duration operator/(std::int64_t n) const { return Duration(ns_ / n); }
  constexpr Duration& operator+=(Duration other) {
    ns_ += other.ns_;
    return *this;
  }

 private:
  explicit constexpr Duration(std::int64_t ns) : ns_(ns) {}
  std::int64_t ns_ = 0;
};

/// A point in time. The epoch depends on the source: the start of the run in the simulator, that of the log for a log.
class Time {
 public:
  constexpr Time() = default;

  static constexpr Time fromNanoseconds(std::int64_t ns) { return Time(ns); }
  static Time fromSeconds(double s) { return Time(Duration::fromSeconds(s).nanoseconds()); }

  constexpr std::int64_t nanoseconds() const { return ns_; }
  constexpr double seconds() const { return static_cast<double>(ns_) * 1e-9; }

  constexpr auto operator<=>(const Time&) const = default;
  constexpr Time operator+(Duration d) const { return Time(ns_ + d.nanoseconds()); }
  constexpr Time operator-(Duration d) const { return Time(ns_ - d.nanoseconds()); }
  constexpr Duration operator-(Time other) const { return Duration::fromNanoseconds(ns_ - other.ns_); }
  constexpr Time& operator+=(Duration d) {
    ns_ += d.nanoseconds();
    return *this;
  }

 private:
  explicit constexpr Time(std::int64_t ns) : ns_(ns) {}
  std::int64_t ns_ = 0;
};

/// Greatest distance from the epoch, before or after it, of a stamp that is read from a file. The Duration between any
/// two such stamps then fits 64 bits.
inline constexpr double kFarthestStamp_s = 4.6e9;

}  // namespace swiftlet::common
