// A trial: a mission flown by script, several times, with figures it must reach. Read from trials/*.yaml.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/config_fwd.hpp"
#include "common/error.hpp"
#include "evaluation/criteria.hpp"
#include "evaluation/event_order.hpp"
#include "evaluation/flight_score.hpp"
#include "evaluation/operator_script.hpp"
#include "evaluation/phase_metrics.hpp"
#include "evaluation/system_bounds.hpp"
#include "evaluation/target_score.hpp"
#include "evaluation/true_world.hpp"
#include "simulation/scenario.hpp"
#include "simulation/survey.hpp"

namespace swiftlet::evaluation {

/// A figure of the paper whose experiment the trial repeats.
struct PaperFigure {
  std::string figure;
  double value = 0.0;

  void describe(common::config::Fields& fields);
  std::vector<common::Problem> validate() const;
};

/// The map that the flights are given: a file, or one that a robot on wheels makes first.
struct TrialMap {
  std::string file;
  double x_m = 0.0;
  double y_m = 0.0;
  double yaw_deg = 0.0;
  simulation::SurveyConfig survey;

  bool surveyed() const { return !survey.path_world_m.empty(); }
  bool given() const { return surveyed() || !file.empty(); }

  void describe(common::config::Fields& fields);
  std::vector<common::Problem> validate() const;
};

struct TrialConfig {
  std::string name;
  std::string description;
  std::string mission;
  std::string system = "swiftlet";
  std::vector<std::string> systems;
  std::vector<std::string> natures = {"real"};
  std::vector<double> batteries;
  bool each_fault = false;
  bool visual_odometry_alone = false;
  std::string archive;
  int repeat = 1;
  double time_limit_s = 600.0;
  double clearance_m = kClearance_m;
  double reachable_area_max_m2 = kReachableAreaMax_m2;
  Criteria criteria;
  std::vector<PaperFigure> paper;
  TrialMap map;
  std::vector<OperatorStep> operator_steps;
  std::vector<PhaseConfig> phases;
  std::vector<EventOrderConfig> event_orders = {};
  std::vector<SystemBounds> asked_of;
  std::vector<TrialTarget> targets;
  simulation::Scenario scenario;
  std::filesystem::path folder;  ///< Of the file that it was read from; it is not read itself.
  std::map<std::string, common::SourceLocation> places = {};  ///< Of the values in that file, by their keys.

  void describe(common::config::Fields& fields);
  std::vector<common::Problem> validate() const;

  /// One trial for each of its systems, with each of them for each of its natures, in each of them for each of its
  /// batteries and, with `each_fault`, for each of these for each fault: these are then the only ones, and part of its
  /// name where there are several; the second of two faults with the same name has a 2 behind it. The charge is that of
  /// every vehicle, as if the scenario had written it out.
  std::vector<TrialConfig> byCondition() const;

  /// Flies with this profile in place of those that its file names.
  void setSystem(const std::string& profile);
  /// Where its file gives a value, "scenario.world"; without a file and a line if it does not.
  common::SourceLocation placeOf(const std::string& key) const;

  /// Whether one of its flights is with that profile.
  bool flies(const std::string& profile) const;
  /// The bounds of figures over all flights for its one system.
  std::vector<PhaseBound> figureBounds() const;

  /// Makes `world` and `model_paths` of the scenario absolute: below `unpacked`, the content of the archive, if there
  /// is such a file, otherwise below `root`, the installed or source tree.
  void resolvePaths(const std::filesystem::path& unpacked, const std::filesystem::path& root);

 private:
  std::vector<TrialConfig> bySystem() const;
  std::vector<TrialConfig> byNature() const;
  std::vector<TrialConfig> byCharge() const;
  std::vector<TrialConfig> byFault() const;
};

/// Throws common::InputError.
TrialConfig readTrial(const std::filesystem::path& file);

/// The trial of a file, or all trials of a folder and its subfolders, ordered by path. Throws common::InputError with
/// the problems of all files.
std::vector<TrialConfig> readTrials(const std::filesystem::path& file_or_folder);

/// The folder of data sets: the environment's SWIFTLET_DATASETS if it is set, otherwise ../shared/datasets beside
/// `root`. It need not exist.
std::filesystem::path dataSetsFolder(const std::filesystem::path& root);

/// An archive below the folder of data sets. Throws common::InputError that says how to get it.
std::filesystem::path findArchive(const std::string& archive, const std::filesystem::path& data_sets);

}  // namespace swiftlet::evaluation
