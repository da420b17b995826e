#include "apps/shared_logs.hpp"

#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>

#include "common/config.hpp"
#include "common/data_paths.hpp"
#include "common/error.hpp"
#include "common/validation.hpp"

namespace swiftlet::apps {
namespace {

namespace fs = std::filesystem;

fs::path dataSets(const std::string& folder, const fs::path& list) {
  if (!folder.empty()) return folder;
  if (const char* told = std::getenv("SWIFTLET_DATASETS"); told != nullptr && *told != '\0') return told;
  return list.parent_path().parent_path() / "../shared/datasets";
}

}  // namespace

void SharedLog::describe(common::config::Fields& fields) {
  fields("name", name, "For people.");
  fields("log", log, "The log.");
  fields("relations", relations, "Known relations between its poses; empty if there are none.");
  fields("best_mean_m", best_mean_m, {0, 1},
         "The least mean error of the relations that anyone has measured, in translation; the map is right up to 1.5 "
         "times "
         "as much.");
  fields("poses", poses, "Reference poses by its stamps; empty if there are none.");
  fields("poses_in_log", poses_in_log, "The poses in the log are corrected: they are the reference, and no odometry.");
  fields("wheels", wheels, "It has odometry of wheels: it is mapped with it, and without.");
  fields("scans", scans, {0, 1e6}, "So many scans from its beginning; 0: all.");
  fields("short", short_part, "It is of the short part, which a test maps.");
}

std::vector<common::Problem> SharedLog::validate() const {
  const int given = (relations.empty() ? 0 : 1) + (poses.empty() ? 0 : 1) + (poses_in_log ? 1 : 0);
  return common::Validation()
      .require(!name.empty() && !log.empty(), "log", common::Message("logs.no-name-or-file", "needs a name and a file"))
      .require(
          given <= 1, "name",
          common::Message("logs.several-references", "has more than one of `relations`, `poses` and `poses_in_log`"))
      .require(relations.empty() == (best_mean_m == 0.0), "best_mean_m",
               common::Message("logs.mean-of-relations", "goes with `relations`"))
      .require(!(poses_in_log && wheels), "wheels",
               common::Message("logs.corrected-poses", "are not in a log whose poses are corrected"))
      .problems();
}

std::string SharedLog::part() const { return scans == 0 ? "whole" : fmt::format("first {} scans", scans); }

void SharedLogs::describe(common::config::Fields& fields) { fields.list("logs", logs, "In the order of the page."); }

std::vector<SharedLog> readSharedLogs(const std::string& folder) {
  const fs::path list = common::findData("config/logs.yaml");
  auto shared = common::config::readFile<SharedLogs>(list.string());
  const fs::path data_sets = dataSets(folder, list);
  for (SharedLog& log : shared.logs)
    for (std::string* file : {&log.log, &log.relations, &log.poses}) {
      if (file->empty()) continue;
      *file = (data_sets / *file).lexically_normal().string();
      if (!fs::exists(*file))
        throw common::InputError({*file}, "",
                                 common::Message("logs.missing", "is not there, where {} has it", list.string()),
                                 "give the folder of the data sets by --datasets or "
                                 "$SWIFTLET_DATASETS");
    }
  return std::move(shared.logs);
}

}  // namespace swiftlet::apps
