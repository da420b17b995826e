// swiftlet papers: one row for each experiment, table and figure of the five papers.
#include <algorithm>
#include <map>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/command.hpp"
#include "apps/paper_experiments.hpp"
#include "apps/required.hpp"
#include "apps/show.hpp"
#include "common/error.hpp"
#include "common/read_bytes.hpp"
#include "interfaces/files/atomic_file.hpp"

namespace swiftlet::apps {
namespace {

using Json = nlohmann::json;

/// The trials of all results; a later file replaces a trial of an earlier one.
std::vector<Json> readResults(const std::vector<std::string>& files) {
  std::vector<Json> trials;
  for (const std::string& file : files) {
    const Json json = Json::parse(common::readBytes(file, std::size_t{64} << 20), nullptr, false);
    if (!json.is_object() || !json.contains("trials") || !json["trials"].is_array())
      throw common::InputError(
          common::Problem{{file}, "", "is not the results.json of trials", "give one that `swiftlet trial` wrote"});
    for (const Json& trial : json["trials"]) trials.push_back(trial);
  }
  return trials;
}

std::optional<double> medianOf(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

struct Measured {
  double value = 0.0;
  std::size_t flights = 0;
};

std::optional<Measured> medianOverFlights(const std::vector<Json>& figures) {
  std::vector<double> values;
  for (const Json& figure : figures)
    if (figure.is_number()) values.push_back(figure.get<double>());
  const auto median = medianOf(values);
  return median ? std::optional(Measured{*median, values.size()}) : std::nullopt;
}

/// Of the whole trial, or the median over its flights.
std::optional<Measured> measured(const Json& trial, const std::string& figure) {
  const Json flights = trial.value("flights", Json::array());
  std::vector<Json> figures;
  if (figure.starts_with("phases.")) {
    const std::string name = figure.substr(7);
    const std::string phase = name.substr(0, name.find('.')), key = name.substr(name.find('.') + 1);
    for (const Json& flight : flights)
      figures.push_back(flight.value("phases", Json::object()).value(phase, Json::object()).value(key, Json()));
    return medianOverFlights(figures);
  }
  if (figure.starts_with("flights.")) {
    for (const Json& flight : flights) figures.push_back(flight.value(figure.substr(8), Json()));
    return medianOverFlights(figures);
  }
  const Json value = trial.value(figure, Json());
  if (!value.is_number()) return std::nullopt;
  return Measured{value.get<double>(), trial.value("runs", std::size_t{0})};
}

/// "0.031 (n = 5)" of each condition that was flown with the profile, with its name where there are several: a trial in
/// two natures has two figures. Of results with the same name the last counts.
std::string flownWith(const std::vector<Json>& trials, const PaperExperiment& experiment, const std::string& profile) {
  std::map<std::string, const Json*> conditions;
  for (const Json& trial : trials) {
    const std::string name = trial.value("name", "");
    const bool same = name == experiment.trial || name.starts_with(experiment.trial + "-");
    if (same && trial.value("system", "") == profile) conditions[name] = &trial;
  }
  std::string text;
  for (const auto& [name, trial] : conditions) {
    if (!text.empty()) text += "; ";
    const auto value = measured(*trial, experiment.figure);
    text += value ? fmt::format("{:.3f} (n = {})", value->value, value->flights) : "-";
    if (conditions.size() > 1) text += ", " + name.substr(std::min(name.size(), experiment.trial.size() + 1));
    constexpr double kShort = 2.0;
    const bool falls_short = value && experiment.reported_at_most > 0.0 && profile == experiment.profile &&
                             value->value > kShort * experiment.reported_at_most;
    if (falls_short)
      text += ": " +
              (experiment.shortfall.empty() ? "more than twice the paper's, why is not known" : experiment.shortfall);
  }
  return text;
}

std::string rowOf(const PaperExperiment& experiment, const std::vector<Json>& trials) {
  std::string its, own, where;
  if (!experiment.trial.empty()) {
    if (!experiment.profile.empty()) its = flownWith(trials, experiment, experiment.profile);
    own = flownWith(trials, experiment, experiment.own);
    if (!own.empty() && experiment.own != "swiftlet") own += fmt::format(", `{}`", experiment.own);
    where = fmt::format("`{}`, {}", experiment.trial, experiment.figure);
  } else if (!experiment.shown_by.empty()) {
    where = fmt::format("`{}`", experiment.shown_by);
  } else {
    where = "not built yet: " + experiment.missing;
  }
  return fmt::format("| {} | {} | {} | {} | {} | {} |\n", experiment.item, experiment.what, experiment.reported, its,
                     own, where);
}

std::string page(const Papers& papers, const std::vector<Json>& trials) {
  std::string text =
      "# The five papers, flown again\n\n"
      "Printed by `swiftlet papers`: one row for each experiment, table and figure. Figures are medians over flights "
      "in the "
      "simulator,\nin SI units, with the profile of the paper and with our own; an empty cell was not flown for this "
      "page.\n";
  std::string paper;
  for (const PaperExperiment& experiment : papers.experiments) {
    if (experiment.paper != paper) {
      paper = experiment.paper;
      text += fmt::format(
          "\n## {}\n\n| in the paper | what | it reports | its profile | `swiftlet` | where |\n"
          "| --- | --- | --- | --- | --- | --- |\n",
          paper);
    }
    text += rowOf(experiment, trials);
  }
  return text;
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
  command.option("--write", options->write, "Page to write instead of printing it.");
  command.footer("Example: swiftlet papers --results runs/papers/results.json --write docs/papers.md");
  command.runs([options] {
    const std::string text = page(readPapers(), readResults(options->results));
    if (options->write.empty())
      show(text);
    else
      required(interfaces::writeAtomically(options->write, text));
    return kDone;
  });
}

}  // namespace swiftlet::apps
