#include "control/estimate_watch.hpp"

#include <array>
#include <span>

#include <fmt/core.h>

namespace swiftlet::control {
namespace {

/// Without a horizontal estimate for this long the vehicle lands, and while its velocity is known: what keeps the laser
/// from measuring may be over within 3 s.
constexpr double kHorizontalLoss_s = 1.0, kCarriedLoss_s = 3.0;
/// Without a vertical estimate for this long the emergency descent begins.
constexpr double kVerticalLoss_s = 0.3;
/// The emergency descent begins when inertial samples that cannot be used have been noticed for this long.
constexpr double kInertialLoss_s = 0.2;

}  // namespace

void EstimateWatch::observe(common::Time now, bool vertical_valid, std::string_view inertial_fault) {
  vertical_lost_.update(!vertical_valid, now);
  inertial_fault_ = inertial_fault;
  const common::Edge edge = inertial_lost_.update(!inertial_fault.empty(), now);
  if (edge == common::Edge::kEntered) log_.warn(now, "flight", "inertial samples cannot be used", inertial_fault_);
  if (edge == common::Edge::kLeft) log_.info(now, "flight", "inertial samples can be used again");
}

const Failsafe* EstimateWatch::active(common::Time now, FlightPhase phase, bool diverged) const {
  std::array<FindingKind, 4> found{};
  std::size_t count = 0;
  if (diverged) found[count++] = FindingKind::kEstimateDiverged;
  if (vertical_lost_.active_s(now) >= kVerticalLoss_s) found[count++] = FindingKind::kHeightLost;
  if (inertial_lost_.active_s(now) >= kInertialLoss_s) found[count++] = FindingKind::kInertialUnusable;
  if (horizontal_lost_.active_s(now) >= horizontalLoss_s()) found[count++] = FindingKind::kHorizontalLost;
  return activeFailsafe(std::span(found.data(), count), phase);
}

double EstimateWatch::horizontalLoss_s() const { return carried_ ? kCarriedLoss_s : kHorizontalLoss_s; }

common::Edge EstimateWatch::observeHorizontal(common::Time now, bool valid, bool carried) {
  carried_ = carried;
  return horizontal_lost_.update(!valid, now);
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
      return fmt::format("no horizontal estimate for {:.1f} s", horizontalLoss_s());
    default:
      return std::string(toString(finding));
  }
}

}  // namespace swiftlet::control
