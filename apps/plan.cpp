// swiftlet plan: a path between two places of a map, as a flight would plan it.
#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "apps/command.hpp"
#include "apps/listed_numbers.hpp"
#include "apps/map_kind.hpp"
#include "apps/map_png.hpp"
#include "apps/output_file.hpp"
#include "apps/plan_map.hpp"
#include "apps/plan_problems.hpp"
#include "apps/plan_search.hpp"
#include "apps/show.hpp"
#include "common/error.hpp"
#include "flight/system.hpp"
#include "interfaces/files/atomic_file.hpp"
#include "interfaces/files/required.hpp"
#include "rendering/map_picture.hpp"

namespace swiftlet::apps {
namespace {

using common::InputError;
using common::Message;
using Eigen::Vector2d;
using Eigen::Vector3d;

const std::map<std::string, PlannerName> kPlanners{
    {"dstar", PlannerName::kDStar}, {"wavefront", PlannerName::kWavefront}, {"sampling", PlannerName::kSampling}};

struct PlanOptions {
  PlanMapOptions map;
  std::string from, to;
  std::string planner;
  std::string problems;
  int drawn = 0;
  std::string system = "swiftlet";
  std::string out;
  double clearance_m = 0.10;
  int seed = 0;
  bool json = false;
};

/// "x;y", or in space "x;y;z", in the frame of the file.
Vector3d parsePlace(const std::string& text, const std::string& option, const PlanMap& map) {
  const std::vector<double> numbers = listedNumbers(text);
  const std::size_t wanted = map.space ? 3 : 2;
  if (numbers.size() != wanted)
    throw InputError(
        {}, option, Message("plan.no-place", "`{}` is no place of this map, {} finite numbers in metres", text, wanted),
        map.space ? "write \"x;y;z\"" : "write \"x;y\"");
  const Vector2d place_m = map.T_file_map.inverse() * Vector2d(numbers[0], numbers[1]);
  return {place_m.x(), place_m.y(), map.space ? numbers[2] : 0.0};
}

/// As the options take it.
std::string placeText(const Vector3d& place_map_m, const PlanMap& map) {
  const Vector2d place_m = map.T_file_map * Vector2d(place_map_m.head<2>());
  return map.space ? fmt::format("{:.2f};{:.2f};{:.2f}", place_m.x(), place_m.y(), place_map_m.z())
                   : fmt::format("{:.2f};{:.2f}", place_m.x(), place_m.y());
}

nlohmann::json placeJson(const Vector3d& place_map_m, const PlanMap& map) {
  const Vector2d place_m = map.T_file_map * Vector2d(place_map_m.head<2>());
  nlohmann::json place{place_m.x(), place_m.y()};
  if (map.space) place.push_back(place_map_m.z());
  return place;
}

std::string jsonOf(const PlanAnswer& answer, const PlanOptions& options, const PlanMap& map) {
  constexpr double kMilliseconds = 1e3;
  nlohmann::json json{{"map", options.map.from},
                      {"planner", options.planner},
                      {"nodes", answer.nodes},
                      {"map_ms", answer.map_s * kMilliseconds},
                      {"search_ms", answer.search_s * kMilliseconds}};
  if (answer.refusal.empty()) {
    json["length_m"] = answer.length_m;
    json["clearance_m"] = answer.clearance_m;
    for (const Vector3d& point_m : answer.points_map_m) json["points"].push_back(placeJson(point_m, map));
  } else {
    json["refusal"] = answer.refusal;
    if (answer.nearest_map_m) json["nearest"] = placeJson(*answer.nearest_map_m, map);
  }
  return json.dump(2) + "\n";
}

std::string planText(const PlanAnswer& answer, const PlanOptions& options, const PlanMap& map) {
  const std::string effort = fmt::format("{}: {} nodes, {:.2f} ms, and {:.1f} ms for the map\n", options.planner,
                                         answer.nodes, 1e3 * answer.search_s, 1e3 * answer.map_s);
  if (!answer.refusal.empty()) {
    const std::string nearest =
        answer.nearest_map_m ? fmt::format(", the nearest place is \"{}\"", placeText(*answer.nearest_map_m, map)) : "";
    return fmt::format("no path: {}{}\n{}", answer.refusal, nearest, effort);
  }
  return fmt::format("path: {:.2f} m with {} points, {}{:.2f} m from what is in the way\n{}", answer.length_m,
                     answer.points_map_m.size(), answer.clearance_is_more ? "at least " : "", answer.clearance_m,
                     effort);
}

void draw(const PlanAnswer& answer, const PlanQuestion& question, const std::string& file) {
  rendering::MapPicture picture;
  picture.grid = std::make_shared<const common::OccupancyGrid>(answer.plane);
  rendering::MapLine line{"path", {}, rendering::LineStyle::kTrail};
  for (const Vector3d& point_m : answer.points_map_m) line.points_map_m.push_back(point_m.head<2>());
  picture.lines.push_back(std::move(line));
  const auto mark = [&](const char* name, const Vector3d& at_m, rendering::MarkStyle style) {
    picture.marks.push_back({name, {at_m.x(), at_m.y(), 0.0}, style});
    picture.in_view_map_m.push_back(at_m.head<2>());
  };
  picture.in_view_map_m.clear();
  mark("start", question.start_map_m, rendering::MarkStyle::kHome);
  mark("goal", question.goal_map_m, rendering::MarkStyle::kGoal);
  interfaces::required(interfaces::writeAtomically(file, mapPng(picture)));
}

int planOne(PlanOptions& options) {
  const common::VehicleConfig vehicle = flight::loadSystem(options.system).vehicle;
  if (!options.out.empty()) requireWritable(options.out, "--out");
  const PlanMap map = readPlanMap(options.map);
  if (options.planner.empty()) options.planner = map.space ? "sampling" : "dstar";
  PlanQuestion question;
  question.planner = kPlanners.at(options.planner);
  question.start_map_m = parsePlace(options.from, "--from", map);
  question.goal_map_m = parsePlace(options.to, "--to", map);
  question.hull_radius_m = vehicle.hullRadius_m();
  question.hull_height_m = vehicle.hull_height_m;
  question.clearance_m = options.clearance_m;
  question.seed = options.seed;
  if (map.space && question.planner != PlannerName::kSampling && question.start_map_m.z() != question.goal_map_m.z())
    throw InputError({}, "--planner", Message("plan.one-height", "{} plans at one height", options.planner),
                     "give both places the same z, or --planner sampling");
  const PlanAnswer found = answer(map, question);
  if (options.json) {
    showJson(jsonOf(found, options, map));
  } else {
    for (const std::string& note : map.notes) show("note: " + note + "\n");
    show(planText(found, options, map));
  }
  if (!options.out.empty()) {
    draw(found, question, options.out);
    if (!options.json) show("written " + options.out + "\n");
  }
  return found.refusal.empty() ? kDone : kFailed;
}

int plan(PlanOptions& options) {
  if (!options.problems.empty()) {
    if (!options.from.empty() || !options.to.empty() || !options.planner.empty() || !options.out.empty())
      throw InputError({}, "--problems", Message("plan.problems-alone", "goes with no place, planner or picture"));
    return planProblems({options.map.from, options.problems, options.drawn, options.seed, options.json});
  }
  for (const auto& [option, text] : {std::pair{"--from", &options.from}, {"--to", &options.to}})
    if (text->empty()) throw InputError({}, option, Message("plan.place-missing", "is missing"), "give it as \"x;y\"");
  return planOne(options);
}

}  // namespace

void addPlan(Command& program) {
  auto options = std::make_shared<PlanOptions>();
  Command command = program.command("plan", "Plan a path between two places of a map, and draw it.");
  command.argument(
      "map", options->map.from,
      "Floor plan as map_server reads it (.yaml), octree of OctoMap (.bt, .ot), cloud of points (.ply, .pcd) "
      "or grid of the Moving AI benchmarks (.map), the last three also packed by gzip, bzip2 or xz.");
  command.option("--from", options->from,
                 "\"x;y\", or \"x;y;z\" in an octree or a cloud: the middle of the hull, in metres.");
  command.option("--to", options->to, "In the same way.");
  command.choice("--planner", options->planner, kPlanners,
                 "D* Lite when not given, in an octree or a cloud by sampling (RRT-Connect); the first two plan at the "
                 "height of --from.");
  command.option("--clearance", options->clearance_m, {0.0, 5.0},
                 "Between the hull and what is in the way, in metres.");
  command.option("--system", options->system, "Profile of the vehicle whose hull is planned for.");
  command.option("--out", options->out, "Picture of the path, .png.");
  command.option("--seed", options->seed, {0, 1e9}, "Of the samples, or of the problems that are drawn.");
  command.option("--resolution", options->map.resolution_m, {0.01, 2.0},
                 "Side of the voxels that a cloud becomes, in metres, chosen from the distance of its points when not "
                 "given; of the cells of a grid, 1 when not given.");
  command.option("--scale", options->map.scale, {1e-6, 1e6},
                 "Metres in one unit of a cloud's coordinates: 0.001 if they are in millimetres. 1 when not given.");
  command.option(
      "--problems", options->problems,
      "A .scen of the Moving AI benchmarks for a .map, or a .3dscen for a .3dmap: plan each with octile costs and no "
      "hull, by D* Lite or over voxels by A*, and compare the lengths with the optimal ones.");
  command.option("--drawn", options->drawn, {0, 1e6}, "Solve so many of the problems, drawn by --seed; all when 0.");
  command.flag("--json", options->json, "Print the result as JSON, nothing else.");
  command.footer(
      "What is unknown is not free. Without a path it says why and what is the nearest place, and exits with 1.\n\n"
      "Example: swiftlet plan plan.yaml --from \"0;0\" --to \"6.5;-2\" --out path.png");
  command.runs([options] { return plan(*options); });
}

}  // namespace swiftlet::apps
