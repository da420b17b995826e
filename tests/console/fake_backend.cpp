#include "tests/console/fake_backend.hpp"

#include <pthread.h>

#include <array>
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

std::string FakeShelf::list() {
  return R"([{"file": "missions/hop.xml", "name": "hop", "about": "Up and down.", "parameters": [
    {"key": "Hop/Sequence/TakeOff.height_m", "node": "TakeOff", "port": "height_m", "value": "1.0",
     "expected": "a number in metres from 0.3 to 100", "about": "Above the floor.", "choices": []},
    {"key": "Hop/Sequence/MoveToGoal.mode", "node": "MoveToGoal", "port": "mode", "value": "fast",
     "expected": "fast, careful, accurate or brisk", "about": "How fast.", "choices": ["fast", "careful", "accurate", "brisk"]}]},
    {"file": "missions/wait.xml", "name": "wait", "about": "", "parameters": []}])";
}

tl::expected<common::StartMissionCommand, std::string> FakeShelf::take(
    const std::string& file, const std::map<std::string, std::string>& parameters) {
  std::string changed;
  for (const auto& [key, value] : parameters) {
    if (value == "999") return tl::unexpected(key + ": `999` is out of range");
    changed += " " + key + "=" + value;
  }
  return common::StartMissionCommand{file, changed};
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
  options.public_urls = setup_.public_urls;
  options.viewers_bytes_per_s = setup_.viewers_bytes_per_s;
  options.unix_time = unixTime;
  options.missions = &shelf_;
  server_ =
      std::make_unique<web::WebServer>(io_, options, web::WebServer::Sources{world_, camera_, commands_, results_});
  if (setup_.maps3d) flight_.carryCamera();
  if (setup_.given) giveMap();
  if (setup_.flies) {
    flight_.layers().mission.status.state = common::MissionState::kRunning;
    flight_.layers().mission.status.name = "ExploreAndReturn";
    postWorld(true, setup_.warm_up_s);
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

/// A hall of 14 m by 10 m, whose frame lies turned by 40 degrees in `map`. The map of the flight lies inside it.
void FakeBackend::giveMap() {
  auto hall = std::make_shared<common::OccupancyGrid>(common::makeOccupancyGrid(0.05));
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 280; ++x) hall->set({x, y}, x < 3 || y < 3 || x > 276 || y > 196 ? 100 : -100);
  common::MapLayer& map = flight_.layers().map;
  map.given = std::make_shared<const common::GivenMap>(common::GivenMap{std::move(hall), {-7.0, -5.0, 0.0}, 1});
  map.T_map_given = common::Pose2{1.0, -0.5, 40.0 * common::kRadPerDeg};
  common::Localization& localization = map.localization.emplace();
  localization.state = common::LocalizationState::kLocalized;
  localization.T_given_body = {0.5, 0.25, 0.0};
  localization.covariance.diagonal() << 0.0009, 0.0016, 0.0004;
  localization.explained = 0.92;
  localization.places = 1;
}

common::CommandResult FakeBackend::carryOut(const common::OperatorCommand& command) {
  test::Layers& layers = flight_.layers();
  const auto say = [&](common::Severity severity, const std::string& text, const std::string& reason) {
    server_->postEvent({layers.stamp, severity, "mission", text, reason});
  };
  if (const auto* goal = std::get_if<common::GoalCommand>(&command.kind)) {
    const Eigen::Vector2d place_map_m =
        goal->goal_given_m ? *layers.map.T_map_given * *goal->goal_given_m : goal->goal_map_m;
    if (!flight_.isKnownFree(place_map_m)) {
      const std::string reason =
          fmt::format("({:.2f}, {:.2f}) is not known to be free", place_map_m.x(), place_map_m.y());
      say(common::Severity::kWarning, common::toString(command) + " refused", reason);
      return {command.id, false, reason};
    }
    flight_.flyTo(place_map_m);
  } else if (const auto* zone = std::get_if<common::KeepOutCommand>(&command.kind)) {
    common::Polygon area = zone->area;
    for (const Eigen::Vector2d& corner : zone->corners_given_m)
      area.corners_map_m.push_back(*layers.map.T_map_given * corner);
    layers.map.keep_out = std::make_shared<const std::vector<common::Polygon>>(1, area);
  } else if (std::holds_alternative<common::HoldCommand>(command.kind)) {
    layers.mission.status.state = common::MissionState::kHeld;
    layers.mission.status.flown_by = common::FlownBy::kOperator;
    layers.mission.status.phase = "hold";
  } else if (std::holds_alternative<common::ResumeCommand>(command.kind)) {
    if (layers.mission.status.state != common::MissionState::kHeld) return {command.id, false, "nothing is on hold"};
    layers.mission.status.state = common::MissionState::kRunning;
    layers.mission.status.flown_by = common::FlownBy::kMission;
    layers.mission.status.phase = "explore";
  } else if (const auto* mission = std::get_if<common::StartMissionCommand>(&command.kind)) {
    layers.mission.status.state = common::MissionState::kRunning;
    layers.mission.status.name = mission->name + mission->xml;
  } else if (std::holds_alternative<common::StopMissionCommand>(command.kind)) {
    layers.mission.status.state = common::MissionState::kReady;
  } else if (std::holds_alternative<common::HomeCommand>(command.kind)) {
    flight_.flyTo(layers.vehicle.home_map.position_m());
  }
  say(common::Severity::kInfo, common::toString(command), "the operator asked");
  return {command.id, true, ""};
}

void FakeBackend::postWorld(bool moves, double seconds) {
  if (moves) (void)flight_.advance(seconds);
  if (setup_.tree_nodes > 0) growTree();
  world_.post(std::make_shared<const common::World>(flight_.layers().world()));
}

/// A tree three wide, of which five nodes change in each world, and one that failed.
void FakeBackend::growTree() {
  constexpr std::array kStatuses = {"RUNNING", "SUCCESS", "SKIPPED", "SUSPENDED"};
  if (static_cast<int>(tree_.size()) != setup_.tree_nodes) {
    for (int i = 0; i < setup_.tree_nodes; ++i)
      tree_.push_back(
          {i, i == 0 ? -1 : (i - 1) / 3, fmt::format("node {}", i), "IDLE", i % 20 == 1 ? "SubTree" : "Sequence"});
    tree_[2].status = "FAILURE";
    tree_[2].reason = "no path to (3.00, -1.50)";
    tree_[2].ports = {{"goal", "door", "3;-1.5"}, {"mode", "", "fast"}};
  }
  ++worlds_;
  const double now_s = flight_.layers().stamp.seconds();
  for (int i = 0; i < 5; ++i) {
    common::TreeNodeView& node =
        tree_[3U + static_cast<unsigned>(worlds_ * 5 + i) % static_cast<unsigned>(setup_.tree_nodes - 3)];
    node.status = kStatuses[static_cast<std::size_t>(worlds_) % kStatuses.size()];
    node.began_s = now_s;
  }
  flight_.layers().mission.status.tree = tree_;
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
    postWorld(!held, period.count());
    camera_s += period.count();
    if (server_->cameraWanted())
      camera_.post(std::make_shared<const common::CameraFrame>(ExampleFlight::cameraFrame(camera_s, 640, 480)));
  }
}

}  // namespace swiftlet::testing
