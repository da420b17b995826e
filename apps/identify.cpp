// swiftlet identify: the model of a vehicle from its flights.
#include <cmath>
#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "apps/command.hpp"
#include "apps/output_file.hpp"
#include "apps/run_logs.hpp"
#include "apps/show.hpp"
#include "common/config.hpp"
#include "common/config_check.hpp"
#include "common/data_paths.hpp"
#include "common/error.hpp"
#include "common/read_bytes.hpp"
#include "common/rounding.hpp"
#include "common/table.hpp"
#include "control/identification/identify.hpp"
#include "flight/system.hpp"
#include "interfaces/files/atomic_file.hpp"
#include "interfaces/files/required.hpp"
#include "simulation/bench.hpp"
#include "simulation/nature.hpp"

namespace swiftlet::apps {
namespace {

using control::AxisModel;
using control::Identification;

struct IdentifyOptions {
  std::vector<std::string> runs;
  std::string vehicle = "cobra";
  bool truth = false;
  bool bench = false;
  std::string out;
  bool json = false;
};

control::FlightSamples samplesOf(const std::vector<interfaces::ControlRow>& rows, bool truth) {
  control::FlightSamples samples;
  samples.reserve(rows.size());
  for (const interfaces::ControlRow& row : rows)
    samples.push_back({row.stamp, row.roll_rad, row.pitch_rad, row.yaw_rate_rad_s, row.thrust,
                       truth ? row.true_velocity_map_m_s : row.velocity_odom_m_s,
                       truth ? row.true_yaw_map_rad : row.yaw_odom_rad, row.tilt_cos, row.battery_v, row.flying});
  return samples;
}

/// What marks a file as a model of ours.
const std::string kModelLine = "# Identified by `swiftlet identify`; a system profile names it as its vehicle_model.";

double rounded6(double value) { return std::round(value * 1e6) / 1e6; }

AxisModel roundedAxis(AxisModel axis) {
  for (double* value : {&axis.gain, &axis.gain_interval, &axis.offset, &axis.offset_interval, &axis.damping_1_s,
                        &axis.damping_interval_1_s, &axis.lag_s, &axis.residual})
    *value = rounded6(*value);
  return axis;
}

/// Throws common::InputError for a model that no profile could name.
std::string modelYaml(control::VehicleModel model, const common::VehicleConfig& vehicle) {
  for (AxisModel* axis : {&model.forward, &model.left, &model.up, &model.yaw}) *axis = roundedAxis(*axis);
  for (control::ThrustPoint& point : model.thrust)
    point = {common::rounded(point.voltage_v), rounded6(point.hover_command), common::rounded(point.seen_s)};
  std::vector<common::Problem> problems = model.problemsFor(vehicle);
  for (const common::Problem& problem : common::config::problemsOf(model))
    problems.push_back({{}, "", messageOf(problem), "the flights do not tell a model that could be flown"});
  if (!problems.empty()) throw common::InputError(std::move(problems));
  return kModelLine + "\n" + common::config::YamlPrinter(common::config::YamlPrinter::Comments::kNo).print(model);
}

common::Table axisTable(const Identification& found) {
  common::Table table{"Acceleration = k u + b (Bachrach 2009, equation 1) and k2 of equation 2; 95 % intervals",
                      {"axis", "k", "+-", "b", "+-", "lag (s)", "residual", "k2 (1/s)", "+-"},
                      {}};
  const control::VehicleModel& model = found.model;
  const auto row = [&](const char* name, const AxisModel& axis, const AxisModel& damped) {
    if (axis.gain == 0.0) return;
    const auto text = [](double value) { return common::TableCell{fmt::format("{:.3f}", value)}; };
    const bool has_damping = damped.gain != 0.0;
    table.rows.push_back({{name},
                          text(axis.gain),
                          text(axis.gain_interval),
                          text(axis.offset),
                          text(axis.offset_interval),
                          text(axis.lag_s),
                          text(axis.residual),
                          has_damping ? text(damped.damping_1_s) : common::TableCell{"-"},
                          has_damping ? text(damped.damping_interval_1_s) : common::TableCell{"-"}});
  };
  row("forward per pitch", model.forward, found.damped_forward);
  row("left per roll", model.left, found.damped_left);
  row("up per thrust", model.up, found.damped_up);
  row("yaw rate", model.yaw, AxisModel{});
  return table;
}

nlohmann::ordered_json axisJson(const AxisModel& axis) {
  return {{"k", rounded6(axis.gain)},         {"k_interval", rounded6(axis.gain_interval)},
          {"b", rounded6(axis.offset)},       {"b_interval", rounded6(axis.offset_interval)},
          {"k2", rounded6(axis.damping_1_s)}, {"k2_interval", rounded6(axis.damping_interval_1_s)},
          {"lag_s", rounded6(axis.lag_s)},    {"residual", rounded6(axis.residual)}};
}

std::string jsonOf(const Identification& found, const std::string& out) {
  const control::VehicleModel& model = found.model;
  nlohmann::ordered_json json = {{"vehicle", model.vehicle},
                                 {"forward", axisJson(model.forward)},
                                 {"left", axisJson(model.left)},
                                 {"up", axisJson(model.up)},
                                 {"yaw", axisJson(model.yaw)},
                                 {"forward_damped", axisJson(found.damped_forward)},
                                 {"left_damped", axisJson(found.damped_left)},
                                 {"up_damped", axisJson(found.damped_up)},
                                 {"thrust_rounds", found.thrust.rounds},
                                 {"thrust_sigma", rounded6(found.thrust.sigma)},
                                 {"problems", found.problems},
                                 {"doubts", found.doubts},
                                 {"model", out}};
  return json.dump(2) + "\n";
}

constexpr const char* kNatureFile = "nature.yaml";

/// Only the simulator knows the true plant: by a nature.yaml, or as the plant of the data sheet.
void requirePlant(const std::filesystem::path& run) {
  std::error_code failure;
  if (std::filesystem::exists(run / kNatureFile, failure)) return;
  const auto mission = nlohmann::json::parse(common::readBytes(run / "mission.json"), nullptr, false);
  const auto nature = mission.is_object() ? mission.find("nature") : mission.end();
  if (nature != mission.end() && *nature == simulation::Nature::calm().name()) return;
  throw common::InputError(
      {run.string()}, "--bench",
      common::Message("identify.no-plant", "has no nature.yaml, so that nobody knows which vehicle flew"),
      "put a run of the simulator first, or leave out --bench");
}

/// The plant that flew the run, fixed to one axis.
std::vector<control::CommandAngle> benchRows(const std::string& run, const common::VehicleConfig& vehicle,
                                             int axis_body) {
  simulation::Scenario scenario;
  scenario.vehicle = vehicle;
  const std::filesystem::path drawn = std::filesystem::path(run) / kNatureFile;
  if (std::filesystem::exists(drawn)) scenario = simulation::Nature::load(drawn.string()).drawn(scenario, 1);
  std::vector<control::CommandAngle> rows;
  for (const simulation::BenchRow& row : simulation::attitudeBench(scenario, axis_body))
    rows.push_back({common::rounded(row.command_deg), common::rounded(row.angle_deg)});
  return rows;
}

/// An incomplete model is written as well, if it has anything; its gaps are reported.
int identify(const IdentifyOptions& options) {
  const common::VehicleConfig vehicle = flight::loadVehicle(options.vehicle);
  if (!options.out.empty()) requireWritable(options.out, "--out", kModelLine);
  refuseRunsGivenTwice(options.runs, "run");
  const FlownVehicle flown{vehicle, "--vehicle"};
  std::vector<control::FlightSamples> flights;
  for (const std::string& run : options.runs)
    flights.push_back(
        samplesOf(readControlRows(run, flown, options.truth ? Truth::kNeeded : Truth::kUnused), options.truth));
  if (options.bench) requirePlant(options.runs.front());
  Identification found = control::identify(flights, vehicle);
  if (options.bench) {
    found.model.bench_roll = benchRows(options.runs.front(), vehicle, 0);
    found.model.bench_pitch = benchRows(options.runs.front(), vehicle, 1);
  }
  const control::VehicleModel& model = found.model;
  const bool anything = !model.thrust.empty() || model.forward.gain != 0.0 || model.up.gain != 0.0;
  const bool writes = anything && !options.out.empty();
  if (options.json) {
    showJson(jsonOf(found, writes ? options.out : ""));
  } else {
    show(fmt::format("{}\n", toText(axisTable(found))));
    if (!model.thrust.empty())
      show(fmt::format("C(U): {:.4f} at {:.2f} V to {:.4f} at {:.2f} V, {} rounds, sigma {:.4f}\n",
                       model.thrust.front().hover_command, model.thrust.front().voltage_v,
                       model.thrust.back().hover_command, model.thrust.back().voltage_v, found.thrust.rounds,
                       found.thrust.sigma));
    for (const std::string& doubt : found.doubts) show(fmt::format("not told well: {}\n", doubt));
    for (const std::string& problem : found.problems) show(fmt::format("not identified: {}\n", problem));
  }
  if (writes) required(interfaces::writeAtomically(options.out, modelYaml(model, vehicle)));
  if (writes && !options.json) show(fmt::format("model   {}\n", options.out));
  return found.problems.empty() ? kDone : kFailed;
}

}  // namespace

void addIdentify(Command& program) {
  auto options = std::make_shared<IdentifyOptions>();
  Command command =
      program.command("identify", "Identify a vehicle's model from its flights, by least squares and EM.");
  command.arguments("run", options->runs, "Folders of runs that were flown with --control-log.");
  command.option("--vehicle", options->vehicle, "The vehicle that flew: a file of config/vehicles, or a path.");
  command.flag("--truth", options->truth, "Use the true motion instead of the estimate, as from motion capture.");
  command.flag("--bench", options->bench,
               "Also put the vehicle of the first run on a simulated bench: which angle it takes for a command.");
  command.option("--out", options->out, "File of the model (YAML), which a profile names as vehicle_model.");
  command.flag("--json", options->json, "Print the parameters as JSON, nothing else.");
  command.footer("Example: swiftlet identify runs/first runs/second --vehicle cobra --out cobra_model.yaml");
  command.runs([options] { return identify(*options); });
}

}  // namespace swiftlet::apps
