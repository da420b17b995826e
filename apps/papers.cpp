// swiftlet papers: one row for each experiment, table and figure of the five papers.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/command.hpp"
#include "apps/required.hpp"
#include "apps/show.hpp"
#include "common/config.hpp"
#include "common/data_paths.hpp"
#include "common/error.hpp"
#include "common/read_bytes.hpp"
#include "common/validation.hpp"
#include "interfaces/files/atomic_file.hpp"

namespace swiftlet::apps {
namespace {

struct Experiment {
  std::string paper, item, what, reported, trial, figure, profile, shown_by, missing;

  void describe(common::config::Fields& fields) {
    fields("paper", paper, "Author and year.");
    fields("item", item, "Figure, table or section.");
    fields("what", what, "What is shown.");
    fields("reported", reported, "What the paper reports.");
    fields("trial", trial, "The trial that repeats it; empty for none.");
    fields("figure", figure, "Its figure in results.json; that of a phase as phases.NAME.FIGURE.");
    fields("profile", profile, "The paper's profile among those that fly the trial.");
    fields("shown_by", shown_by, "A file or folder that shows it otherwise.");
    fields("missing", missing, "What is not built yet.");
  }
  std::vector<std::string> validate() const {
    const int given = (trial.empty() ? 0 : 1) + (shown_by.empty() ? 0 : 1) + (missing.empty() ? 0 : 1);
    return common::Validation()
        .require(given == 1, "item", "has not one of `trial`, `shown_by` and `missing`")
        .require(trial.empty() == figure.empty(), "figure", "goes with `trial`")
        .problems();
  }
};

struct Papers {
  std::vector<Experiment> experiments;
  void describe(common::config::Fields& fields) {
    fields.list("experiments", experiments, "In the order of the page.");
  }
};

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

/// "0.031 (n = 5)": of the whole trial, or the median of a phase's figure over the flights.
std::string measured(const Json& trial, const std::string& figure) {
  const std::size_t flights = trial.value("runs", 0U);
  if (!figure.starts_with("phases.")) {
    const Json value = trial.value(figure, Json());
    return value.is_number() ? fmt::format("{:.3f} (n = {})", value.get<double>(), flights) : "-";
  }
  const std::string name = figure.substr(7);
  const std::string phase = name.substr(0, name.find('.')), key = name.substr(name.find('.') + 1);
  std::vector<double> values;
  for (const Json& flight : trial.value("flights", Json::array())) {
    const Json value = flight.value("phases", Json::object()).value(phase, Json::object()).value(key, Json());
    if (value.is_number()) values.push_back(value.get<double>());
  }
  const auto median = medianOf(values);
  return median ? fmt::format("{:.3f} (n = {})", *median, values.size()) : "-";
}

std::string ours(const std::vector<Json>& trials, const Experiment& experiment, const std::string& profile) {
  std::string text;
  for (const Json& trial : trials) {
    const std::string name = trial.value("name", "");
    const bool same = name == experiment.trial || name.starts_with(experiment.trial + "-");
    if (same && trial.value("system", "") == profile) text = measured(trial, experiment.figure);
  }
  return text;
}

std::string rowOf(const Experiment& experiment, const std::vector<Json>& trials) {
  const std::string& profile = experiment.profile;
  std::string its, own, where;
  if (!experiment.trial.empty()) {
    its = profile == "swiftlet" ? "" : ours(trials, experiment, profile);
    own = ours(trials, experiment, "swiftlet");
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
  for (const Experiment& experiment : papers.experiments) {
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
    const auto papers = common::config::readFile<Papers>(common::findData("config/papers.yaml").string());
    const std::string text = page(papers, readResults(options->results));
    if (options->write.empty())
      show(text);
    else
      required(interfaces::writeAtomically(options->write, text));
    return kDone;
  });
}

}  // namespace swiftlet::apps
