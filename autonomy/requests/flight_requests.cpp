#include "autonomy/requests/flight_requests.hpp"

#include <utility>

#include <fmt/format.h>

#include "common/world/map_layer.hpp"
#include "common/world/vehicle_layer.hpp"

namespace swiftlet::autonomy {
namespace {

/// Ten frames of a camera at 5 Hz, the slowest that is flown.
constexpr double kFrameComes_s = 2.0;
constexpr const char* kFlight = "flight";

}  // namespace

std::optional<common::CommandResult> FlightRequests::take(const common::OperatorCommand& command,
                                                          const common::World& world) {
  if (std::holds_alternative<common::ClearKeepOutCommand>(command.kind)) {
    const std::size_t count = keep_out_.clearOperators();
    const std::size_t stay = keep_out_.zones()->size();
    std::string reason = count == 0 ? "there was no zone of the operator" : "";
    if (stay > 0) reason += fmt::format("{}{} of the mission stay", reason.empty() ? "" : "; ", stay);
    return common::CommandResult{command.id, true, std::move(reason)};
  }
  const auto* keep_out = std::get_if<common::KeepOutCommand>(&command.kind);
  if (keep_out == nullptr) return std::nullopt;
  std::string refusal = addZone(keep_out->area, KeepOutZones::Owner::kOperator, world);
  if (!refusal.empty()) return common::CommandResult{command.id, false, std::move(refusal)};
  const bool inside = keep_out->area.contains(world.vehicle->state.T_map_body_planar().position_m());
  return common::CommandResult{command.id, true, inside ? "the vehicle is in it, and leaves with its next path" : ""};
}

void FlightRequests::take(const common::MissionRequest& request, const common::World& world) {
  const auto* photograph = std::get_if<common::PhotographRequest>(&request.kind);
  if (photograph != nullptr && camera_)
    photograph_ = {request.id, photograph->name, world.stamp};
  else
    answers_.push_back(answerTo(request, world));
}

void FlightRequests::answered(common::MissionAnswer answer, common::Time now) {
  if (answer.done) log_.info(now, kFlight, answer.reason, "the mission asked for it");
  answers_.push_back(std::move(answer));
}

common::MissionAnswer FlightRequests::answerTo(const common::MissionRequest& request, const common::World& world) {
  if (const auto* zone = std::get_if<common::KeepOutRequest>(&request.kind)) {
    std::string refusal = addZone(zone->area, KeepOutZones::Owner::kMission, world);
    return {request.id, refusal.empty(), std::move(refusal)};
  }
  if (const auto* map = std::get_if<common::SaveMapRequest>(&request.kind)) {
    files_.push_back(SavedMap{map->name, world.map->grid});
    log_.info(world.stamp, kFlight, "map saved as map-" + map->name);
    return {request.id, true, {}};
  }
  return {request.id, false, "the vehicle has no RGB-D camera"};
}

void FlightRequests::addFrame(const std::shared_ptr<const common::RgbdFrame>& frame,
                              const common::VehicleState& state) {
  if (!photograph_ || frame->stamps.measured < photograph_->asked) return;
  files_.push_back(Photo{photograph_->name, frame, state.T_map_body() * *camera_});
  log_.info(frame->stamps.arrived, kFlight, "photograph " + photograph_->name);
  answers_.push_back({photograph_->id, true, {}});
  photograph_.reset();
}

/// Why it is refused; empty if it holds now.
std::string FlightRequests::addZone(const common::Polygon& zone, KeepOutZones::Owner owner,
                                    const common::World& world) {
  const common::PlaceNames names = world.map->names();
  std::string refusal = keep_out_.add(zone, owner, world.vehicle->home_map.position_m(), names);
  if (refusal.empty())
    log_.info(world.stamp, kFlight, "keep-out zone with " + toString(zone, names),
              owner == KeepOutZones::Owner::kMission ? "of the mission" : "of the operator");
  return refusal;
}

std::vector<common::MissionAnswer> FlightRequests::takeAnswers(common::Time now) {
  if (photograph_ && (now - photograph_->asked).seconds() > kFrameComes_s) {
    answers_.push_back(
        {photograph_->id, false, fmt::format("no usable frame of the camera for {:.0f} s", kFrameComes_s)});
    photograph_.reset();
  }
  return std::exchange(answers_, {});
}
std::vector<RunFile> FlightRequests::takeFiles() { return std::exchange(files_, {}); }
}  // namespace swiftlet::autonomy
