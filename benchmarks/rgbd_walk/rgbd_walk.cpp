// benchmark_rgbd_walk WORLD.sdf FOLDER [--seed N] [--rate HZ] [--length M] [--speed M_S] [--turn DEG_S] [--bare]
//
// Records what an RGB-D camera (config/sensors/xtion.yaml) sees that somebody carries through a simulated building,
// with the true poses, in the format of TUM RGB-D: for `swiftlet map3d` and benchmark_rgbd_peers.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "benchmarks/rgbd_walk/walker.hpp"
#include "common/config.hpp"
#include "common/random.hpp"
#include "common/rgbd_camera_config.hpp"
#include "interfaces/rgbd/rgbd_recorder.hpp"
#include "simulation/appearance/patterns.hpp"
#include "simulation/ray_caster.hpp"
#include "simulation/sensors/rgbd_camera.hpp"
#include "simulation/world_model.hpp"

namespace {

using namespace swiftlet;

struct Options {
  std::string world, folder;
  std::uint64_t seed = 1;
  double rate_Hz = 5.0;
  bool bare = false;
  rgbd_walk::WalkConfig walk;
};

/// A camera indoors: pictures are blurred by what moves while the shutter is open.
simulation::RgbdErrorsConfig errorsOfCamera() {
  simulation::RgbdErrorsConfig errors;
  errors.pixel_noise = 2.0;
  errors.exposure_s = 0.008;
  errors.exposure_lag_s = 0.3;
  errors.dark_range_m = 3.0;
  errors.glancing_deg = 80.0;
  errors.edge_hole_rate = 0.3;
  return errors;
}

/// Worlds for lasers have blank walls, before which no camera knows how it moves. Here everything has a texture, drawn
/// by the seed.
void cover(simulation::WorldModel& world, std::uint64_t seed) {
  using simulation::Pattern;
  constexpr std::array kPatterns{Pattern::kPosters, Pattern::kBrick, Pattern::kWood,
                                 Pattern::kCarpet,  Pattern::kTiles, Pattern::kPosters};
  for (simulation::Shape& shape : world.shapes) {
    common::RandomStream random(seed, "texture of " + nameOf(shape));
    if (!shape.pattern) shape.pattern = kPatterns[random.bits() % kPatterns.size()];
  }
}

common::Time timeOf(std::size_t step) {
  return common::Time::fromSeconds(rgbd_walk::kWalkStep_s * static_cast<double>(step));
}

void record(const Options& options) {
  auto sheet = common::config::readFile<common::RgbdCameraConfig>(SWIFTLET_SOURCE_DIR "/config/sensors/xtion.yaml");
  sheet.rate_hz = options.rate_Hz;
  sheet.mount = {.x_m = 0.0, .z_m = 0.0};
  simulation::WorldModel world = simulation::loadWorld(options.world);
  if (!options.bare) cover(world, options.seed);
  const simulation::RayCaster rays(world);
  const std::vector<common::Pose3> poses = rgbd_walk::walkThrough(world, rays, options.walk, options.seed);
  std::vector<simulation::Moment> track;
  for (std::size_t i = 0; i < poses.size(); ++i) track.push_back({timeOf(i), poses[i], {}});
  simulation::RgbdCamera camera(sheet, errorsOfCamera(), world, options.seed);
  auto recorder = interfaces::RgbdRecorder::create(options.folder);
  if (!recorder) throw std::runtime_error(options.folder + " cannot be made");
  const auto every = static_cast<std::size_t>(std::max(1.0, 1.0 / (options.rate_Hz * rgbd_walk::kWalkStep_s)));
  std::uint64_t number = 0;
  for (std::size_t i = 10; i + 10 < track.size(); i += every) {
    const common::RgbdFrame frame = camera.frame(number++, track[i].time, track, rays);
    if (!recorder->add(frame) || !recorder->addTruth(track[i].time, track[i].T_world_body))
      throw std::runtime_error(options.folder + " cannot be written");
  }
  std::printf("%zu frames in %s\n", recorder->frames(), options.folder.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App program("The recording of a walk with an RGB-D camera through a simulated building.");
  program.add_option("world", options.world, "World (SDF).")->required();
  program.add_option("folder", options.folder, "Folder to be made.")->required();
  program.add_option("--seed", options.seed, "Draws the places that are walked to.");
  program.add_option("--rate", options.rate_Hz, "Frames a second.");
  program.add_option("--length", options.walk.length_m, "Length of the walk, m.");
  program.add_option("--speed", options.walk.speed_m_s, "Speed, m/s.");
  program.add_flag("--bare", options.bare, "The world's own surfaces, some of which are blank.");
  double turn_deg_s = options.walk.turn_rate_rad_s / common::kRadPerDeg;
  program.add_option("--turn", turn_deg_s, "Fastest turn, deg/s.");
  CLI11_PARSE(program, argc, argv);
  options.walk.turn_rate_rad_s = turn_deg_s * common::kRadPerDeg;
  try {
    record(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  return 0;
}
