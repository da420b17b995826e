// swiftlet explore-bench: explorers compared in buildings in the plane, by an ideal vehicle, or by the simulated one.
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/command.hpp"
#include "apps/explore_bench_flights.hpp"
#include "apps/explore_bench_report.hpp"
#include "apps/explore_bench_worlds.hpp"
#include "apps/listed_numbers.hpp"
#include "apps/show.hpp"
#include "common/error.hpp"
#include "common/geometry.hpp"
#include "evaluation/exploration/flat_building.hpp"
#include "evaluation/exploration/known_tour.hpp"
#include "flight/system.hpp"
#include "flight/wall_clock.hpp"
#include "simulation/scenario.hpp"

namespace swiftlet::apps {
namespace {

using common::InputError;
using common::Message;

struct ExploreBenchOptions {
  BenchWorldOptions worlds;
  std::string system = "swiftlet";
  std::string start;
  std::vector<std::string> explorers;
  double resolution_m = 0.05;
  double clearance_m = 0.10;
  std::optional<double> range_m;
  bool no_bound = false;
  bool json = false;
  bool fly = false;
  BenchFlightOptions flights;
};

const std::vector<std::pair<std::string, planning::ExplorerKind>> kExplorers{
    {"nearest_frontier", planning::ExplorerKind::kNearestFrontier},
    {"utility", planning::ExplorerKind::kUtility},
    {"tour", planning::ExplorerKind::kTour}};

/// All explorers when none is named.
std::vector<std::pair<std::string, planning::ExplorerKind>> chosenExplorers(const std::vector<std::string>& names) {
  if (names.empty()) return kExplorers;
  std::vector<std::pair<std::string, planning::ExplorerKind>> chosen;
  for (const std::string& name : names) {
    if (name == "camera_tour") {
      chosen.emplace_back(name, planning::ExplorerKind::kCameraTour);
      continue;
    }
    const auto found =
        std::find_if(kExplorers.begin(), kExplorers.end(), [&](const auto& e) { return e.first == name; });
    if (found == kExplorers.end())
      throw InputError({}, "--explorer", Message("explore-bench.explorer", "`{}` is no explorer", name),
                       "nearest_frontier, utility, tour or camera_tour");
    chosen.push_back(*found);
  }
  return chosen;
}

/// What the profile says of the vehicle, its laser and its planner.
evaluation::FlatFlightConfig flightConfigOf(const ExploreBenchOptions& options) {
  const flight::System system = flight::loadSystem(options.system);
  const auto& path = system.config.autonomy.control.path;
  const auto& planning = system.config.autonomy.execution.planning;
  evaluation::FlatFlightConfig config;
  config.explorer = planning.explorer;
  config.planner = planning.planner;
  config.cost_map = planning.cost_map;
  config.footprint = {system.vehicle.hullRadius_m(), options.clearance_m};
  config.speed_m_s = path.fast.speed_m_s;
  config.acceleration_m_s2 = path.fast.acceleration_m_s2;
  config.corner_deviation_m = path.fast.corner_deviation_m;
  config.yaw_rate_rad_s = path.yaw_rate_deg_s * common::kRadPerDeg;
  config.laser_range_m = options.range_m.value_or(system.laser.range_max_m);
  config.laser_field_of_view_deg = system.laser.field_of_view_deg;
  config.clock_s = [begin = flight::Clock::now()] { return flight::secondsSince(begin); };
  config.explorer.laser_range_m = std::min(config.explorer.laser_range_m, config.laser_range_m);
  return config;
}

std::optional<Eigen::Vector2d> askedStart(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const std::vector<double> numbers = listedNumbers(text);
  if (numbers.size() != 2)
    throw InputError({}, "--start",
                     Message("explore-bench.start", "`{}` is no place, two finite numbers in metres", text),
                     "write \"x;y\"");
  return Eigen::Vector2d(numbers[0], numbers[1]);
}

BenchResult compareIn(const std::string& file, const ExploreBenchOptions& options,
                      evaluation::FlatFlightConfig config) {
  const BenchWorld world = readBenchWorld(file, options.worlds);
  const evaluation::FlatBuilding building(world.plan, options.resolution_m);
  planning::CostMap::Config plain;
  plain.comfort_weight = 0.0;
  planning::CostMap map(plain, options.resolution_m);
  // A hull that starts with a cell to spare is never shut in by the cells of its map.
  planning::Footprint roomy = config.footprint;
  roomy.clearance_m += options.resolution_m;
  map.update(building.seen(), roomy);
  const auto asked = askedStart(options.start);
  const auto start = evaluation::startIn(map, asked ? *asked : world.start_m.value_or(Eigen::Vector2d::Zero()));
  if (!start) throw InputError({file}, "", Message("explore-bench.no-start", "the hull fits nowhere in it"));
  BenchResult result{world.name, *start, 0.0, {}};
  if (!options.no_bound) result.bound_m = evaluation::knownTour(building, map, *start, config.laser_range_m).length_m;
  for (const auto& [name, kind] : chosenExplorers(options.explorers)) {
    config.explorer.kind = kind;
    result.flights.push_back({name, evaluation::exploreFlat(building, *start, config)});
  }
  return result;
}

/// They fly with the profile that the comparison is for.
BenchFlightOptions flightsOf(const ExploreBenchOptions& options) {
  BenchFlightOptions flights = options.flights;
  flights.system = options.system;
  return flights;
}

int exploreBench(const ExploreBenchOptions& options) {
  const evaluation::FlatFlightConfig config = flightConfigOf(options);
  (void)chosenExplorers(options.explorers);
  (void)askedStart(options.start);
  std::vector<BenchResult> results;
  bool complete = true;
  const std::vector<std::string> files = benchFiles(options.worlds.places);
  for (const std::string& file : files) {
    try {
      if (options.fly) {
        for (BenchResult& flown :
             flyExplorers(file, chosenExplorers(options.explorers), flightsOf(options), options.json))
          results.push_back(std::move(flown));
      } else {
        results.push_back(compareIn(file, options, config));
      }
    } catch (const InputError& refused) {
      // One of many does not keep the others from being compared.
      if (files.size() == 1) throw;
      showError(std::string(refused.what()) + "\n");
      complete = false;
      continue;
    }
  }
  for (const BenchResult& result : results)
    for (const BenchFlight& entry : result.flights) complete = complete && entry.flight.complete;
  if (options.json)
    showJson(benchJson(results));
  else
    show(benchText(results));
  return complete ? kDone : kFailed;
}

}  // namespace

void addExploreBench(Command& program) {
  auto options = std::make_shared<ExploreBenchOptions>();
  Command command =
      program.command("explore-bench", "Compare the explorers in buildings: time, path, share of a bound.");
  command.arguments("maps", options->worlds.places,
                    "Floor plans as map_server reads them (.yaml), grids of the Moving AI benchmarks (.map), worlds "
                    "(.sdf, .world), or folders of them.");
  command.option(
      "--explorer", options->explorers,
      "Only this one: nearest_frontier, utility or tour; with --fly and a depth camera also camera_tour. May be "
      "repeated.");
  command.option("--system", options->system, "Profile of the vehicle, its laser, its speed and its planner.");
  command.option("--start", options->start,
                 "\"x;y\" in the map, in metres: the nearest place that the hull can fly from. \"0;0\", or the middle "
                 "of a map without it, when not given.");
  command.option("--clearance", options->clearance_m, {0.0, 5.0}, "Between the hull and walls, in metres.");
  command.option("--range", options->range_m, {0.5, 100.0}, "Of the laser, in metres; the profile's when not given.");
  command.option("--resolution", options->resolution_m, {0.02, 0.5}, "Side of the cells of the maps, in metres.");
  command.option("--cell", options->worlds.cell_m, {0.01, 10.0}, "Of a grid without metres, 1 when not given.");
  command.option("--models", options->worlds.model_paths, "Folder of the models of worlds.");
  command.flag("--no-bound", options->no_bound, "Do not search the short tour through the known map.");
  command.flag("--fly", options->fly,
               "Fly the simulated vehicle in worlds and trials, instead of an ideal one in floor plans.");
  command.option("--seed", options->flights.seed, {0, simulation::kGreatestSeed}, "With --fly: the first seed.");
  command.option("--repeat", options->flights.repeat, {1, 10'000},
                 "With --fly: flights of each explorer in each world, seeds S, S+1, ...");
  command.option("--out", options->flights.out, "With --fly: folder of the runs; default runs/<time>-explore-bench.");
  command.flag("--json", options->json, "Print the results as JSON, nothing else.");
  command.footer(
      "An ideal vehicle moves as fast as the profile allows, with an ideal laser and its true pose; explorer and "
      "planner are those of flights. The bound is the shortest tour found with the whole map known. Exits with 1 if an "
      "exploration is not complete.\n\n"
      "Example: swiftlet explore-bench plans/ --explorer utility --explorer tour\n"
      "Example: swiftlet explore-bench trials/papers/unb_case1.yaml --fly --seed 5101 --repeat 3");
  command.runs([options] { return exploreBench(*options); });
}

}  // namespace swiftlet::apps
