#include "apps/run_logs.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "apps/system.hpp"
#include "common/error.hpp"
#include "interfaces/files/text_file.hpp"

namespace swiftlet::apps {
namespace {

namespace fs = std::filesystem;

common::InputError unusableRun(const fs::path& place, const std::string& message, const std::string& hint) {
  return common::InputError(common::Problem{{place.string()}, "", message, hint});
}

}  // namespace

std::vector<interfaces::ControlRow> readControlRows(const std::string& run, const common::VehicleConfig& vehicle,
                                                    Truth truth) {
  const fs::path folder = run, log = folder / "control.tsv";
  if (!fs::is_directory(folder))
    throw unusableRun(folder, "is no folder of a run", "give the folder that a flight wrote");
  if (!interfaces::saysAtStart(folder / "mission.json", "swiftlet mission", 200))
    throw unusableRun(folder, "is not the folder of a run", "a run has a mission.json");
  if (!fs::exists(log)) throw unusableRun(folder, "has no control.tsv", "fly it with --control-log");
  const System system = loadSystem((folder / "config.yaml").string());
  if (system.vehicle.name != vehicle.name)
    throw unusableRun(folder / "config.yaml", fmt::format("`{}` flew, not `{}`", system.vehicle.name, vehicle.name),
                      fmt::format("give --vehicle {}", system.config.vehicle));
  std::vector<interfaces::ControlRow> rows = interfaces::readControlLog(log);
  const bool flew = std::any_of(rows.begin(), rows.end(), [](const auto& row) { return row.flying; });
  if (!flew) throw unusableRun(log, "the vehicle never flew in it", "a flight of a minute and more is needed");
  const auto blind =
      std::find_if(rows.begin(), rows.end(), [](const auto& row) { return row.flying && !row.has_truth; });
  if (truth == Truth::kNeeded && blind != rows.end())
    throw unusableRun(log, fmt::format("has no truth at {:.2f} s, in flight", blind->stamp.seconds()),
                      "only flights of the simulator or with motion capture have it");
  return rows;
}

std::vector<perception::FilterInput> readFilterTape(const std::string& run) {
  const fs::path file = fs::path(run) / "fusion.tsv";
  if (!fs::exists(file)) throw unusableRun(run, "has no fusion.tsv", "fly it with --control-log");
  std::vector<perception::FilterInput> inputs;
  interfaces::LineReader reader(file);
  std::vector<interfaces::Word> words;
  std::vector<std::string_view> texts;
  while (interfaces::nextWords(reader, words)) {
    texts.clear();
    for (const interfaces::Word& word : words) texts.push_back(word.text);
    auto input = perception::filterInputOf(texts);
    if (!input) throw reader.problemAt(words.front().column, "", "is no input of the filter");
    inputs.push_back(std::move(*input));
  }
  return inputs;
}

perception::TapedFlight readTapedFlight(const std::string& run, const common::VehicleConfig& vehicle, double least_s) {
  perception::TapedFlight flight;
  for (const interfaces::ControlRow& row : readControlRows(run, vehicle, Truth::kNeeded))
    if (row.flying)
      flight.truth.push_back({row.stamp, row.true_yaw_map_rad, row.true_velocity_map_m_s, row.true_position_map_m});
  flight.inputs = readFilterTape(run);
  const double flown_s = (flight.truth.back().stamp - flight.truth.front().stamp).seconds();
  if (flown_s < least_s)
    throw unusableRun(run, fmt::format("{:.1f} s of flight are too few, at least {:g} s are needed", flown_s, least_s),
                      "give a flight of a minute and more");
  return flight;
}

}  // namespace swiftlet::apps
