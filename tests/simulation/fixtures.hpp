// Rooms and files the simulator's tests share.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "common/gravity.hpp"
#include "common/rgbd_frame.hpp"
#include "simulation/scenario.hpp"
#include "simulation/simulated_vehicle.hpp"
#include "simulation/triangulate.hpp"
#include "simulation/world_model.hpp"

namespace swiftlet::simulation {

inline Shape boxShape(const std::string& model, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  Shape shape;
  shape.model = model;
  const Triangles box = boxTriangles(high - low);
  const Eigen::Vector3f centre = (0.5 * (low + high)).cast<float>();
  for (const Eigen::Vector3f& vertex : box.vertices_m) shape.vertices_world_m.push_back(vertex + centre);
  shape.triangles = box.indices;
  return shape;
}

/// A room of x in [-5, 5], y in [-4, 4], z in [0, 3] between walls of 0.2 m; the start is its middle.
inline WorldModel boxRoom() {
  WorldModel world;
  world.file = "room.sdf";
  world.shapes = {
      boxShape("floor", {-5.2, -4.2, -0.2}, {5.2, 4.2, 0.0}), boxShape("ceiling", {-5.2, -4.2, 3.0}, {5.2, 4.2, 3.2}),
      boxShape("east", {5.0, -4.2, 0.0}, {5.2, 4.2, 3.0}),    boxShape("west", {-5.2, -4.2, 0.0}, {-5.0, 4.2, 3.0}),
      boxShape("north", {-5.0, 4.0, 0.0}, {5.0, 4.2, 3.0}),   boxShape("south", {-5.0, -4.2, 0.0}, {5.0, -4.0, 3.0})};
  return world;
}

/// A folder that is removed after the test.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(const std::string& name)
      : path_(std::filesystem::temp_directory_path() / (name + "_" + std::to_string(::getpid()))) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::string write(const std::string& file, const std::string& text) const {
    std::filesystem::create_directories((path_ / file).parent_path());
    std::ofstream(path_ / file) << text;
    return (path_ / file).string();
  }

 private:
  std::filesystem::path path_;
};

/// Flies the vehicle by the truth, so that the simulator can be tested without an autonomy.
class TruthPilot {
 public:
  explicit TruthPilot(SimulatedVehicle& vehicle) : vehicle_(vehicle), target_(vehicle.T_world_map().position_m) {}

  /// In the world's frame; the height is that of the body above the take-off floor.
  void flyTo(double x_m, double y_m, double height_m) {
    target_ = {x_m, y_m, vehicle_.T_world_map().position_m.z() + height_m};
    motors_on_ = true;
  }
  const SimulatedVehicle& vehicle() const { return vehicle_; }
  void cutMotors() { motors_on_ = false; }
  double yaw_rate_rad_s = 0.0;
  double max_speed_m_s = 1.0;

  /// Lets time pass and collects what the vehicle sends; false once it crashed.
  bool fly(double seconds) {
    const common::Time end = vehicle_.now() + common::Duration::fromSeconds(seconds);
    while (vehicle_.now() < end) {
      steer();
      if (!advance()) return false;
    }
    return true;
  }
  /// The two halves of a control period, for tests with several vehicles.
  void steer() { vehicle_.apply(setpoint()); }
  bool advance() { return vehicle_.advanceTo(vehicle_.now() + common::kControlPeriod, events); }

  std::vector<common::SensorEvent> events;

 private:
  common::Setpoint setpoint() {
    const Truth& truth = vehicle_.truth();
    const common::VehicleConfig& airframe = vehicle_.scenario().vehicle;
    const Eigen::Vector3d error = target_ - truth.T_world_body.position_m;
    Eigen::Vector3d velocity = 1.2 * error;
    if (velocity.norm() > max_speed_m_s) velocity *= max_speed_m_s / velocity.norm();
    Eigen::Vector3d acceleration = 2.0 * (velocity - truth.velocity_world_m_s);
    if (truth.airborne) lift_m_s2_ += 0.01 * acceleration.z();  // The acceleration lost to the sagging battery.
    acceleration.z() += lift_m_s2_;
    const Eigen::Vector2d level =
        Eigen::Rotation2Dd(-common::yawOf(truth.T_world_body.rotation)) * acceleration.head<2>();
    return {vehicle_.now(),
            motors_on_,
            -level.y() / common::kGravity_m_s2,
            level.x() / common::kGravity_m_s2,
            yaw_rate_rad_s,
            airframe.mass_kg * (common::kGravity_m_s2 + 2.0 * acceleration.z()) / airframe.max_thrust_n};
  }

  SimulatedVehicle& vehicle_;
  Eigen::Vector3d target_;
  bool motors_on_ = false;
  double lift_m_s2_ = 0.0;
};

template <typename Event>
std::vector<Event> eventsOf(const std::vector<common::SensorEvent>& events) {
  std::vector<Event> found;
  for (const common::SensorEvent& event : events)
    if (const Event* wanted = std::get_if<Event>(&event)) found.push_back(*wanted);
  return found;
}
using Scan = std::shared_ptr<const common::LaserScan>;
using Frame = std::shared_ptr<const common::CameraFrame>;
using Rgbd = std::shared_ptr<const common::RgbdFrame>;
using Sweep = std::shared_ptr<const common::VerticalScan>;

}  // namespace swiftlet::simulation
