#include "tests/console/fake_backend.hpp"

#include <pthread.h>

#include <chrono>
#include <ctime>

#include <fmt/format.h>

#include "tests/support/patience.hpp"

namespace swiftlet::testing {

common::Time unixTime() {
  return common::Time::fromNanoseconds(
      std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
          .count());
}

FakeBackend::FakeBackend(Setup setup) : setup_(std::move(setup)) {
  web::WebServer::Options options;
  options.address = setup_.address;
  options.port = setup_.port;
  options.token = setup_.token;
  options.title = "explore_and_return in example flat";
  options.command_timeout_s = 0.5 * test_support::patience();
  options.stall_timeout_s = setup_.stall_timeout_s;
  options.max_connections = setup_.max_connections;
  options.viewers_bytes_per_s = setup_.viewers_bytes_per_s;
  options.unix_time = unixTime;
  server_ =
      std::make_unique<web::WebServer>(io_, options, web::WebServer::Sources{world_, camera_, commands_, results_});
  if (setup_.maps3d) flight_.carryCamera();
  if (setup_.flies) {
    flight_.layers().mission.status.state = common::MissionState::kRunning;
    world_.post(flight_.advance(setup_.warm_up_s));
  }
  server_thread_ = std::jthread([this] { io_.run(); });
  if (setup_.flies) flight_thread_ = std::jthread([this](const std::stop_token& stop) { fly(stop); });
}

FakeBackend::~FakeBackend() {
  if (flight_thread_.joinable()) {
    flight_thread_.request_stop();
    flight_thread_.join();
  }
  server_->stop();
}

std::vector<common::OperatorCommand> FakeBackend::commandsSeen() const {
  const std::scoped_lock lock(seen_mutex_);
  return seen_;
}

double FakeBackend::serverCpu_s() const {
  clockid_t clock{};
  timespec used{};
  if (pthread_getcpuclockid(const_cast<std::jthread&>(server_thread_).native_handle(), &clock) != 0 ||
      clock_gettime(clock, &used) != 0)
    return 0.0;
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

common::CommandResult FakeBackend::carryOut(const common::OperatorCommand& command) {
  test::Layers& layers = flight_.layers();
  const auto say = [&](common::Severity severity, const std::string& text, const std::string& reason) {
    server_->postEvent({layers.stamp, severity, "mission", text, reason});
  };
  if (const auto* goal = std::get_if<common::GoalCommand>(&command.kind)) {
    if (!flight_.isKnownFree(goal->goal_map_m)) {
      const std::string reason =
          fmt::format("({:.2f}, {:.2f}) is not known to be free", goal->goal_map_m.x(), goal->goal_map_m.y());
      say(common::Severity::kWarning, common::toString(command) + " refused", reason);
      return {command.id, false, reason};
    }
    flight_.flyTo(goal->goal_map_m);
  } else if (std::holds_alternative<common::HoldCommand>(command.kind)) {
    layers.mission.status.state = common::MissionState::kHeld;
  } else if (std::holds_alternative<common::ResumeCommand>(command.kind)) {
    if (layers.mission.status.state != common::MissionState::kHeld) return {command.id, false, "nothing is on hold"};
    layers.mission.status.state = common::MissionState::kRunning;
  } else if (std::holds_alternative<common::HomeCommand>(command.kind)) {
    flight_.flyTo(layers.vehicle.home_map.position_m());
  }
  say(common::Severity::kInfo, common::toString(command), "the operator asked");
  return {command.id, true, ""};
}

void FakeBackend::fly(const std::stop_token& stop) {
  const auto period = std::chrono::duration<double>(1.0 / setup_.worlds_per_second);
  double camera_s = 0.0;
  while (!stop.stop_requested()) {
    std::this_thread::sleep_for(period);
    for (const common::OperatorCommand& command : commands_.takeAll()) {
      {
        const std::scoped_lock lock(seen_mutex_);
        seen_.push_back(command);
      }
      if (setup_.answers) results_.push(carryOut(command));
    }
    const bool held = flight_.layers().mission.status.state == common::MissionState::kHeld;
    if (!held) world_.post(flight_.advance(period.count()));
    if (held) world_.post(std::make_shared<const common::World>(flight_.layers().world()));
    camera_s += period.count();
    if (server_->cameraWanted())
      camera_.post(std::make_shared<const common::CameraFrame>(ExampleFlight::cameraFrame(camera_s, 640, 480)));
  }
}

}  // namespace swiftlet::testing
