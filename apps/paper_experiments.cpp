#include "apps/paper_experiments.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <string_view>

#include <fmt/format.h>

#include "common/config.hpp"
#include "common/data_paths.hpp"
#include "common/error.hpp"
#include "common/validation.hpp"
#include "evaluation/figures.hpp"
#include "evaluation/trial.hpp"

namespace swiftlet::apps {
namespace {

namespace fs = std::filesystem;
using evaluation::TrialConfig;

/// By their names without "-system" and the like.
std::map<std::string, TrialConfig> allTrials() {
  std::map<std::string, TrialConfig> trials;
  for (const TrialConfig& trial : evaluation::readTrials(common::findData("trials"))) trials.emplace(trial.name, trial);
  return trials;
}

/// What a phase of a flight has at most; the heights of its levels are numbered.
bool isPhaseFigure(const TrialConfig& trial, std::string_view figure) {
  const std::string phase(figure.substr(0, figure.find('.')));
  const std::string name(figure.substr(std::min(figure.size(), phase.size() + 1)));
  const auto known = std::find_if(trial.phases.begin(), trial.phases.end(),
                                  [&](const evaluation::PhaseConfig& one) { return one.name == phase; });
  if (known == trial.phases.end()) return false;
  if (name.starts_with("level_") && name.ends_with("_height_m")) return true;
  const std::vector<std::string> names = evaluation::phaseFigureNames(*known);
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool isFigure(const TrialConfig& trial, std::string_view figure) {
  if (figure.starts_with("phases.")) return isPhaseFigure(trial, figure.substr(7));
  if (figure == "flights.open_loop_error_m" || figure == "collisions") return true;
  return evaluation::findTrialFigure(figure) != nullptr;
}

std::vector<common::Message> problemsOf(const PaperExperiment& row, const std::map<std::string, TrialConfig>& trials) {
  if (row.trial.empty()) return {};
  const auto found = trials.find(row.trial);
  if (found == trials.end()) return {common::Message("papers.no-such-trial", "there is no trial `{}`", row.trial)};
  const TrialConfig& trial = found->second;
  std::vector<common::Message> problems;
  if (!isFigure(trial, row.figure))
    problems.push_back(common::Message("papers.no-such-figure", "{} has no figure `{}`", row.trial, row.figure));
  const std::string& profile = row.profile.empty() ? row.own : row.profile;
  if (!trial.flies(profile))
    problems.push_back(common::Message("papers.not-flown", "{} does not fly `{}`", row.trial, profile));
  return problems;
}

}  // namespace

void PaperExperiment::describe(common::config::Fields& fields) {
  fields("paper", paper, "Author and year.");
  fields("item", item, "Figure, table or section.");
  fields("what", what, "What is shown.");
  fields("reported", reported, "What the paper reports.");
  fields("reported_at_most", reported_at_most, {0, 1e6},
         "The paper's value as the figure has it, if it is one of which less is better; 0: none.");
  fields("trial", trial, "The trial that repeats it; empty for none.");
  fields("figure", figure,
         "Figure of the trial in results.json; that of a phase as phases.NAME.FIGURE, the median of the flights' as "
         "flights.FIGURE.");
  fields("profile", profile, "The paper's profile among those that fly the trial; empty if only ours does.");
  fields("own", own, "Our profile.");
  fields("shown_by", shown_by, "A file or folder that shows it otherwise.");
  fields("code", code, "The files and folders of the algorithm.");
  fields("missing", missing, "What is not built yet.");
  fields("shortfall", shortfall, "Why the paper's profile falls short of its own paper by more than twice.");
}

std::vector<common::Problem> PaperExperiment::validate() const {
  const int given = (trial.empty() ? 0 : 1) + (shown_by.empty() ? 0 : 1) + (missing.empty() ? 0 : 1);
  return common::Validation()
      .require(given == 1, "item",
               common::Message("papers.not-one-proof", "has not one of `trial`, `shown_by` and `missing`"))
      .require(trial.empty() == figure.empty(), "figure",
               common::Message("papers.figure-of-trial", "goes with `trial`"))
      .require(!profile.starts_with("swiftlet"), "profile",
               common::Message("papers.own-profile", "is one of ours: give it as `own`"))
      .require(own.starts_with("swiftlet"), "own", common::Message("papers.other-profile", "is not one of ours"))
      .problems();
}

void Papers::describe(common::config::Fields& fields) {
  fields.list("experiments", experiments, "In the order of the page.");
}

Papers readPapers() {
  const std::string file = common::findData("config/papers.yaml").string();
  auto papers = common::config::readFile<Papers>(file);
  const auto trials = allTrials();
  std::vector<common::Problem> problems;
  for (const PaperExperiment& row : papers.experiments)
    for (const common::Message& problem : problemsOf(row, trials))
      problems.push_back({{file}, fmt::format("{}, {}", row.paper, row.item), problem, ""});
  if (!problems.empty()) throw common::InputError(std::move(problems));
  return papers;
}

}  // namespace swiftlet::apps
