#include "apps/run_logs.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/median_step.hpp"
#include "common/vehicle.hpp"
#include "flight/system.hpp"
#include "interfaces/files/text_file.hpp"

namespace swiftlet::apps {
namespace {

namespace fs = std::filesystem;

common::InputError unusableRun(const fs::path& place, const common::Message& message, const std::string& hint) {
  return common::InputError({place.string()}, "", message, hint);
}

/// A name alone is not enough: a sheet of the user may have that of another one.
void refuseOtherVehicle(const fs::path& config, const FlownVehicle& vehicle) {
  const flight::System system = flight::loadSystem(config.string());
  const common::VehicleConfig &flew = system.vehicle, &given = vehicle.sheet;
  const auto own = system.own_files.find("vehicle");
  const std::string hint =
      fmt::format("give {} {}", vehicle.option, own == system.own_files.end() ? system.config.vehicle : own->second);
  if (flew.name != given.name)
    throw unusableRun(config, common::Message("run.other-vehicle", "`{}` flew, not `{}`", flew.name, given.name), hint);
  struct Value {
    const char* key;
    double flew, given;
  };
  for (const Value& value : {Value{"mass_kg", flew.mass_kg, given.mass_kg},
                             {"max_thrust_n", flew.max_thrust_n, given.max_thrust_n},
                             {"battery_full_v", flew.battery_full_v, given.battery_full_v},
                             {"battery_empty_v", flew.battery_empty_v, given.battery_empty_v},
                             {"battery_capacity_ah", flew.battery_capacity_ah, given.battery_capacity_ah}})
    if (value.flew != value.given)
      throw unusableRun(config,
                        common::Message("run.other-sheet", "another `{}` flew: its {} is {}, not {}", flew.name,
                                        value.key, value.flew, value.given),
                        hint);
}

/// One row a tick: with stamps in another unit no step of a fit would be right.
void refuseOtherRate(const fs::path& log, const std::vector<interfaces::ControlRow>& rows) {
  constexpr double kMostOff = 2.0;
  const double tick_s = common::kControlPeriod.seconds();
  const double period_s = common::medianStep_s(rows, [](const interfaces::ControlRow& row) { return row.stamp; });
  if (rows.size() < 2 || (period_s > tick_s / kMostOff && period_s < tick_s * kMostOff)) return;
  throw unusableRun(log,
                    common::Message("run.other-rate", "its rows are {:g} s apart, and a flight writes one each {:g} s",
                                    period_s, tick_s),
                    "the column t has seconds");
}

}  // namespace

void refuseRunsGivenTwice(const std::vector<std::string>& runs, const std::string& argument) {
  for (std::size_t i = 0; i < runs.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      std::error_code failure;
      if (fs::equivalent(runs[i], runs[j], failure))
        throw common::InputError({}, argument,
                                 common::Message("run.twice", "{} is given twice, and counts as one flight", runs[i]),
                                 "give each flight once");
    }
}

std::vector<interfaces::ControlRow> readControlRows(const std::string& run, const FlownVehicle& vehicle, Truth truth) {
  const fs::path folder = run, log = folder / "control.tsv";
  std::error_code failure;
  if (!fs::is_directory(folder, failure))
    throw unusableRun(folder, common::Message("folder.none", "is not a folder"), "give the folder that a flight wrote");
  if (!interfaces::saysAtStart(folder / "mission.json", "swiftlet mission", 200))
    throw unusableRun(folder, common::Message("run.no-mission", "is not the folder of a run"),
                      "a run has a mission.json");
  if (!fs::exists(log, failure) && !failure)
    throw unusableRun(folder, common::Message("run.not-recorded", "has no {}", "control.tsv"),
                      "fly it with --control-log");
  refuseOtherVehicle(folder / "config.yaml", vehicle);
  std::vector<interfaces::ControlRow> rows = interfaces::readControlLog(log);
  refuseOtherRate(log, rows);
  const bool flew = std::any_of(rows.begin(), rows.end(), [](const auto& row) { return row.flying; });
  if (!flew)
    throw unusableRun(log, common::Message("run.never-flew", "the vehicle never flew in it"),
                      "a flight of a minute and more is needed");
  const auto blind =
      std::find_if(rows.begin(), rows.end(), [](const auto& row) { return row.flying && !row.has_truth; });
  if (truth == Truth::kNeeded && blind != rows.end())
    throw unusableRun(log,
                      common::Message("run.no-truth", "has no truth at {:.2f} s, in flight", blind->stamp.seconds()),
                      "only flights of the simulator or with motion capture have it");
  return rows;
}

std::vector<perception::FilterInput> readFilterTape(const std::string& run) {
  const fs::path file = fs::path(run) / "fusion.tsv";
  std::error_code failure;
  if (!fs::exists(file, failure) && !failure)
    throw unusableRun(run, common::Message("run.not-recorded", "has no {}", "fusion.tsv"), "fly it with --control-log");
  std::vector<perception::FilterInput> inputs;
  interfaces::LineReader reader(file);
  std::vector<interfaces::Word> words;
  std::vector<std::string_view> texts;
  while (interfaces::nextWords(reader, words)) {
    texts.clear();
    for (const interfaces::Word& word : words) texts.push_back(word.text);
    auto input = perception::filterInputOf(texts);
    if (!input)
      throw reader.problemAt(words.front().column, "",
                             common::Message("run.no-filter-input", "is no input of the filter"));
    inputs.push_back(std::move(*input));
  }
  return inputs;
}

perception::TapedFlight readTapedFlight(const std::string& run, const FlownVehicle& vehicle, double least_s) {
  perception::TapedFlight flight;
  for (const interfaces::ControlRow& row : readControlRows(run, vehicle, Truth::kNeeded))
    if (row.flying)
      flight.truth.push_back({row.stamp, row.true_yaw_map_rad, row.true_velocity_map_m_s, row.true_position_map_m});
  flight.inputs = readFilterTape(run);
  const double flown_s = (flight.truth.back().stamp - flight.truth.front().stamp).seconds();
  if (flown_s < least_s)
    throw unusableRun(run,
                      common::Message("run.too-short", "{:.1f} s of flight are too few, at least {:g} s are needed",
                                      flown_s, least_s),
                      "give a flight of a minute and more");
  return flight;
}

}  // namespace swiftlet::apps
