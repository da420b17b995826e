// swiftlet papers: one row for each experiment, table and figure of the five papers.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/command.hpp"
#include "apps/output_file.hpp"
#include "apps/paper_experiments.hpp"
#include "apps/show.hpp"
#include "common/error.hpp"
#include "common/read_bytes.hpp"
#include "interfaces/files/atomic_file.hpp"
#include "interfaces/files/required.hpp"

namespace swiftlet::apps {
namespace {

using Json = nlohmann::json;

/// No figure of a flight is larger, in SI units.
constexpr double kGreatestFigure = 1e6;

/// One trial of a results.json.
struct FlownTrial {
  std::string file;
  std::size_t index = 0;
  Json json;
  mutable bool used = false;  ///< A row of the page shows it.

  /// `key` is within the trial, "flights[0]"; empty: the trial itself.
  common::InputError problem(const std::string& key, const common::Message& message) const {
    const std::string element = fmt::format("trials[{}]{}{}", index, key.empty() ? "" : ".", key);
    return common::InputError({file}, element, message, "give results that `swiftlet trial` wrote");
  }
};

common::Message noObject() { return common::Message("results.no-object", "is no object"); }

/// Throws common::InputError unless all that the page may read of the trial has its type.
void requireSound(const FlownTrial& trial) {
  const Json& json = trial.json;
  if (!json.is_object()) throw trial.problem("", noObject());
  for (const char* key : {"name", "system"})
    if (json.contains(key) && !json[key].is_string())
      throw trial.problem(key, common::Message("results.no-text", "is no text"));
  if (json.contains("runs") && !json["runs"].is_number_unsigned())
    throw trial.problem("runs", common::Message("results.no-count", "{} is no number of flights", json["runs"].dump()));
  const Json without = json.value("seeds_without", Json::object());
  if (!without.is_object()) throw trial.problem("seeds_without", noObject());
  for (const auto& [name, seeds] : without.items())
    if (!seeds.is_array())
      throw trial.problem("seeds_without." + name, common::Message("results.no-list", "is no list"));
  const Json flights = json.value("flights", Json::array());
  if (!flights.is_array()) throw trial.problem("flights", common::Message("results.no-list", "is no list"));
  for (std::size_t i = 0; i < flights.size(); ++i) {
    const std::string key = fmt::format("flights[{}]", i);
    if (!flights[i].is_object()) throw trial.problem(key, noObject());
    const Json phases = flights[i].value("phases", Json::object());
    if (!phases.is_object()) throw trial.problem(key + ".phases", noObject());
    for (const auto& [name, phase] : phases.items())
      if (!phase.is_object()) throw trial.problem(key + ".phases." + name, noObject());
  }
}

/// The trials of all results; a later file replaces a trial of an earlier one.
std::vector<FlownTrial> readResults(const std::vector<std::string>& files) {
  std::vector<FlownTrial> trials;
  for (const std::string& file : files) {
    const Json json = Json::parse(common::readBytes(file, std::size_t{64} << 20), nullptr, false);
    if (!json.is_object() || !json.contains("trials") || !json["trials"].is_array())
      throw common::InputError({file}, "",
                               common::Message("results.not-of-trials", "is not the results.json of trials"),
                               "give one that `swiftlet trial` wrote");
    if (json["trials"].empty())
      throw common::InputError({file}, "trials", common::Message("results.empty", "is empty"),
                               "give the results of flights");
    for (std::size_t i = 0; i < json["trials"].size(); ++i) {
      trials.push_back({file, i, json["trials"][i]});
      requireSound(trials.back());
    }
  }
  return trials;
}

std::optional<double> medianOf(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

/// A figure over all flights of a trial. Those that lack it or crashed have failed, and are counted too.
struct Measured {
  std::optional<double> value;
  std::size_t flights = 0, failed = 0;
};

/// nullopt if it is no number, as a figure that was not measured.
std::optional<double> figureOf(const FlownTrial& trial, const std::string& key, const Json& value) {
  if (!value.is_number()) return std::nullopt;
  const auto number = value.get<double>();
  if (!(std::abs(number) < kGreatestFigure))
    throw trial.problem(key,
                        common::Message("results.no-figure", "{} is no figure of a flight, in SI units", value.dump()));
  return number;
}

bool crashed(const Json& flight) {
  const Json collisions = flight.value("collisions", Json());
  return collisions.is_number() && collisions.get<double>() > 0.0;
}

/// The median over the flights that `read` finds the figure in, by its key in the flight.
Measured medianOverFlights(const FlownTrial& trial, const std::string& key,
                           const std::function<Json(const Json& flight)>& read) {
  std::vector<double> values;
  Measured measured;
  const Json flights = trial.json.value("flights", Json::array());
  measured.flights = flights.size();
  for (std::size_t i = 0; i < flights.size(); ++i) {
    const auto value = figureOf(trial, fmt::format("flights[{}].{}", i, key), read(flights[i]));
    if (value && !crashed(flights[i]))
      values.push_back(*value);
    else
      ++measured.failed;
  }
  measured.value = medianOf(std::move(values));
  return measured;
}

/// The flights that lack a figure of the whole trial, or that crashed.
std::size_t failedFlights(const FlownTrial& trial, const std::string& figure) {
  const Json without = trial.json.value("seeds_without", Json::object()).value(figure, Json::array());
  std::set<Json> seeds(without.begin(), without.end());
  for (const Json& flight : trial.json.value("flights", Json::array()))
    if (crashed(flight)) seeds.insert(flight.value("seed", Json()));
  return seeds.size();
}

/// Of the whole trial, or the median over its flights.
Measured measured(const FlownTrial& trial, const std::string& figure) {
  if (figure.starts_with("phases.")) {
    const std::string name = figure.substr(7);
    const std::string phase = name.substr(0, name.find('.')), key = name.substr(name.find('.') + 1);
    return medianOverFlights(trial, figure, [&](const Json& flight) {
      return flight.value("phases", Json::object()).value(phase, Json::object()).value(key, Json());
    });
  }
  if (figure.starts_with("flights.")) {
    const std::string key = figure.substr(8);
    return medianOverFlights(trial, key, [&](const Json& flight) { return flight.value(key, Json()); });
  }
  Measured all{figureOf(trial, figure, trial.json.value(figure, Json())), trial.json.value("runs", std::size_t{0}), 0};
  if (figure == "collisions") return all;  // It counts what failed itself.
  all.failed = all.value ? failedFlights(trial, figure) : all.flights;
  return all;
}

/// "0.031 (n = 5, 1 failed)"; no figure where half of the flights failed.
std::string shown(const Measured& measured) {
  const bool tells = measured.value && 2 * measured.failed < std::max<std::size_t>(measured.flights, 1);
  std::string text = tells ? fmt::format("{:.3f} (n = {}", *measured.value, measured.flights)
                           : fmt::format("- (n = {}", measured.flights);
  if (measured.failed > 0) text += fmt::format(", {} failed", measured.failed);
  return text + ")";
}

/// The figure of each condition that was flown with the profile, with its name where there are several: a trial in
/// two natures has two figures. Of results with the same name the last counts.
std::string flownWith(const std::vector<FlownTrial>& trials, const PaperExperiment& experiment,
                      const std::string& profile) {
  std::map<std::string, const FlownTrial*> conditions;
  for (const FlownTrial& trial : trials) {
    const std::string name = trial.json.value("name", "");
    const bool same = name == experiment.trial || name.starts_with(experiment.trial + "-");
    if (!same || trial.json.value("system", "") != profile) continue;
    conditions[name] = &trial;
    trial.used = true;
  }
  std::string text;
  for (const auto& [name, trial] : conditions) {
    if (!text.empty()) text += "; ";
    const Measured figure = measured(*trial, experiment.figure);
    text += shown(figure);
    if (conditions.size() > 1) text += ", " + name.substr(std::min(name.size(), experiment.trial.size() + 1));
    constexpr double kShort = 2.0;
    const bool falls_short = figure.value && experiment.reported_at_most > 0.0 && profile == experiment.profile &&
                             *figure.value > kShort * experiment.reported_at_most;
    if (falls_short)
      text += ": " +
              (experiment.shortfall.empty() ? "more than twice the paper's, why is not known" : experiment.shortfall);
  }
  return text;
}

/// The figures that a page of ours shows, by its row without them: what was not flown again keeps its cell, because all
/// flights together take hours.
class StandingCells {
 public:
  struct Cells {
    std::string its, own;
  };

  StandingCells() = default;
  explicit StandingCells(const std::string& page) {
    std::istringstream lines(page);
    for (std::string line; std::getline(lines, line);) {
      std::vector<std::string> cells;
      for (std::size_t begin = 2, end = 0; line.starts_with("| ") && end != std::string::npos; begin = end + 3) {
        end = line.find(" | ", begin);
        cells.push_back(line.substr(begin, end - begin));
      }
      if (cells.size() == 7) cells_[cells[0] + cells[1] + cells[5]] = {cells[3], cells[4]};
    }
  }

  Cells of(const PaperExperiment& experiment, const std::string& where) const {
    const auto found = cells_.find(experiment.item + experiment.what + where);
    return found == cells_.end() ? Cells{} : found->second;
  }

 private:
  std::map<std::string, Cells> cells_;
};

std::string rowOf(const PaperExperiment& experiment, const std::vector<FlownTrial>& trials,
                  const StandingCells& standing) {
  std::string its, own, where;
  if (!experiment.trial.empty()) {
    if (!experiment.profile.empty()) its = flownWith(trials, experiment, experiment.profile);
    own = flownWith(trials, experiment, experiment.own);
    if (!own.empty() && experiment.own != "swiftlet") own += fmt::format(", `{}`", experiment.own);
    where = fmt::format("`{}`, {}", experiment.trial, experiment.figure);
    if (its.empty()) its = standing.of(experiment, where).its;
    if (own.empty()) own = standing.of(experiment, where).own;
  } else if (!experiment.shown_by.empty()) {
    where = fmt::format("`{}`", experiment.shown_by);
  } else {
    where = "not built yet: " + experiment.missing;
  }
  std::string code;
  for (const std::string& file : experiment.code) code += fmt::format("{}`{}`", code.empty() ? "" : ", ", file);
  return fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", experiment.item, experiment.what, experiment.reported,
                     its, own, where, code);
}

/// The first line of the page, which marks it as one of ours.
constexpr const char* kTitle = "# The five papers, flown again";

std::string page(const Papers& papers, const std::vector<FlownTrial>& trials, const StandingCells& standing) {
  std::string text =
      std::string(kTitle) +
      "\n\n"
      "Printed by `swiftlet papers`: one row for each experiment, table and figure. Figures are over n flights in the "
      "simulator,\nin SI units (times of the processor in ms), with the profile of the paper and with our own; those "
      "of "
      "phases are medians. Flights that\ncrashed or lack the figure have failed; where half of them did, there is no "
      "figure. An empty cell was not flown; a full one stands until its trial is\nflown again.\n";
  std::string paper;
  for (const PaperExperiment& experiment : papers.experiments) {
    if (experiment.paper != paper) {
      paper = experiment.paper;
      text += fmt::format(
          "\n## {}\n\n| in the paper | what | it reports | its profile | `swiftlet` | where | code |\n"
          "| --- | --- | --- | --- | --- | --- | --- |\n",
          paper);
    }
    text += rowOf(experiment, trials, standing);
  }
  return text;
}

/// Results of other trials than the papers', or of other profiles, are not shown.
void tellUnused(const std::vector<FlownTrial>& trials) {
  for (const FlownTrial& trial : trials)
    if (!trial.used)
      showError(fmt::format("note: {}: trials[{}]: no row is of `{}` with the profile `{}`\n", trial.file, trial.index,
                            trial.json.value("name", ""), trial.json.value("system", "")));
}

}  // namespace

void addPapers(Command& program) {
  struct Options {
    std::vector<std::string> results;
    std::string write;
  };
  auto options = std::make_shared<Options>();
  Command command = program.command("papers", "Print what of the five papers is flown again, as Markdown.");
  command.option("--results", options->results, "The results.json of trials, whose figures are put into the table.");
  command.option(
      "--write", options->write,
      "Page to write instead of printing it; one that is there keeps the figures of trials that the results lack.");
  command.footer("Example: swiftlet papers --results runs/papers/results.json --write docs/papers.md");
  command.runs([options] {
    if (!options->write.empty()) requireWritable(options->write, "--write", kTitle);
    const std::vector<FlownTrial> trials = readResults(options->results);
    StandingCells standing;
    if (!options->write.empty() && std::filesystem::exists(options->write))
      standing = StandingCells(common::readBytes(options->write, std::size_t{16} << 20));
    const std::string text = page(readPapers(), trials, standing);
    tellUnused(trials);
    if (options->write.empty())
      show(text);
    else
      required(interfaces::writeAtomically(options->write, text));
    return kDone;
  });
}

}  // namespace swiftlet::apps
