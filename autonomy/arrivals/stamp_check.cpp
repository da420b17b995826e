#include "autonomy/arrivals/stamp_check.hpp"

#include <string>

#include <fmt/format.h>

namespace swiftlet::autonomy {
namespace {

struct SensorName {
  std::string operator()(const common::ImuSample&) const { return "IMU"; }
  std::string operator()(const std::shared_ptr<const common::LaserScan>&) const { return "laser"; }
  std::string operator()(const common::BatterySample&) const { return "battery"; }
  std::string operator()(const common::PilotSample&) const { return "pilot"; }
  std::string operator()(const std::shared_ptr<const common::CameraFrame>&) const { return "observing camera"; }
  std::string operator()(const std::shared_ptr<const common::RgbdFrame>&) const { return "RGB-D camera"; }
  std::string operator()(const std::shared_ptr<const common::VerticalScan>&) const { return "upright laser"; }
};

}  // namespace

bool StampCheck::accepts(const common::SensorEvent& event) {
  const common::Stamps& stamps = common::stampsOf(event);
  const double ahead_s = (stamps.measured - stamps.arrived).seconds();
  const bool refused = stampFault(stamps, std::nullopt) != nullptr;
  if (refused_[event.index()].update(refused, stamps.arrived) == common::Edge::kEntered)
    log_.warn(stamps.arrived, "sensors", "measurement rejected: " + std::visit(SensorName{}, event),
              fmt::format("its stamp lies {:.3g} s in the future", ahead_s));
  return !refused;
}

}  // namespace swiftlet::autonomy
