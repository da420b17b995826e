#include "control/estimate_watch.hpp"

#include <array>
#include <span>

#include <fmt/core.h>

namespace swiftlet::control {
namespace {

using Change = EstimateWatch::Change;

constexpr double kHorizontalLoss_s = 1.0;  ///< Without a horizontal estimate for this long the vehicle lands.
/// Without a vertical estimate for this long the emergency descent begins.
constexpr double kVerticalLoss_s = 0.3;
/// The emergency descent begins when inertial samples that cannot be used have been noticed for this long.
constexpr double kInertialLoss_s = 0.2;

Change changeOf(std::optional<common::Time>& lost, common::Time now, bool valid) {
  if (valid == !lost) return Change::kNone;
  lost = valid ? std::nullopt : std::optional(now);
  return valid ? Change::kBack : Change::kLost;
}

bool lostFor(const std::optional<common::Time>& lost, common::Time now, double seconds) {
  return lost && (now - *lost).seconds() >= seconds;
}

}  // namespace

Change EstimateWatch::observe(common::Time now, bool vertical_valid, std::string_view inertial_fault) {
  changeOf(vertical_lost_, now, vertical_valid);
  inertial_fault_ = inertial_fault;
  return changeOf(inertial_lost_, now, inertial_fault.empty());
}

Change EstimateWatch::observeHorizontal(common::Time now, bool valid) { return changeOf(horizontal_lost_, now, valid); }

const Failsafe* EstimateWatch::active(common::Time now, FlightPhase phase, bool diverged) const {
  std::array<FindingKind, 4> found{};
  std::size_t count = 0;
  if (diverged) found[count++] = FindingKind::kEstimateDiverged;
  if (lostFor(vertical_lost_, now, kVerticalLoss_s)) found[count++] = FindingKind::kHeightLost;
  if (lostFor(inertial_lost_, now, kInertialLoss_s)) found[count++] = FindingKind::kInertialUnusable;
  if (lostFor(horizontal_lost_, now, kHorizontalLoss_s)) found[count++] = FindingKind::kHorizontalLost;
  return activeFailsafe(std::span(found.data(), count), phase);
}

std::string EstimateWatch::reason(FindingKind finding) const {
  switch (finding) {
    case FindingKind::kEstimateDiverged:
      return "fusion diverged";
    case FindingKind::kHeightLost:
      return fmt::format("no valid height for {:.1f} s", kVerticalLoss_s);
    case FindingKind::kInertialUnusable:
      return fmt::format("{} for {:.1f} s", inertial_fault_, kInertialLoss_s);
    case FindingKind::kHorizontalLost:
      return fmt::format("no horizontal estimate for {:.1f} s", kHorizontalLoss_s);
    default:
      return std::string(toString(finding));
  }
}

}  // namespace swiftlet::control
