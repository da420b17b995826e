// swiftlet doctor: what is missing on this machine and how to get it.
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <thread>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "apps/command.hpp"
#include "apps/show.hpp"
#include "common/data_paths.hpp"
#include "common/error.hpp"
#include "evaluation/trial.hpp"
#include "flight/system.hpp"

namespace swiftlet::apps {
namespace {

struct Finding {
  std::string what;
  bool ok = true;
  std::string detail;
  std::string remedy;
};

Finding folderFinding(const std::string& name) {
  try {
    return {name, true, common::findData(name).string(), ""};
  } catch (const common::InputError&) {
    return {name, false, "not found", "run from the source tree, install the package, or set SWIFTLET_DATA"};
  }
}

Finding profilesFinding() {
  try {
    std::string names;
    for (const std::string& name : flight::systemNames()) {
      (void)flight::loadSystem(name);
      names += (names.empty() ? "" : ", ") + name;
    }
    return {"system profiles", true, names, ""};
  } catch (const common::InputError& e) {
    return {"system profiles", false, e.what(), "correct the file it names"};
  }
}

Finding coresFinding() {
  const unsigned cores = std::thread::hardware_concurrency();
  return {"processor cores", cores >= 2, fmt::format("{}", cores),
          "two or more are needed to fly faster than real time"};
}

Finding writableFinding() {
  const bool writable = access(".", W_OK) == 0;
  return {"this folder", writable, writable ? "writable, runs go to ./runs" : "not writable",
          "give fly and trial a folder by --out"};
}

Finding diskFinding() {
  std::error_code error;
  const auto space = std::filesystem::space(".", error);
  const double gib = error ? 0.0 : static_cast<double>(space.available) / (1 << 30);
  return {"free disk", gib > 0.5, fmt::format("{:.1f} GiB", gib), "a run takes some megabytes; free some room"};
}

Finding dataSetsFinding() {
  std::string found = "none (only trials in worlds by others need them; SWIFTLET_DATASETS names their folder)";
  try {
    const auto folder = evaluation::dataSetsFolder(common::findData("worlds").parent_path());
    if (std::filesystem::is_directory(folder)) found = folder.lexically_normal().string();
  } catch (const common::InputError&) {
    // Missing worlds are reported separately.
  }
  return {"data sets", true, found, ""};
}

int doctor(bool json) {
  const std::vector<Finding> findings{
      coresFinding(),          folderFinding("missions"), folderFinding("worlds"), folderFinding("config"),
      folderFinding("trials"), profilesFinding(),         writableFinding(),       diskFinding(),
      dataSetsFinding()};
  bool well = true;
  auto report = nlohmann::json::array();
  for (const Finding& finding : findings) {
    well = well && finding.ok;
    report.push_back({{"what", finding.what},
                      {"ok", finding.ok},
                      {"detail", finding.detail},
                      {"remedy", finding.ok ? "" : finding.remedy}});
    if (json) continue;
    show(fmt::format("{:<8}{:<18}{}\n", finding.ok ? "ok" : "missing", finding.what, finding.detail));
    if (!finding.ok) show(fmt::format("{:<26}-> {}\n", "", finding.remedy));
  }
  if (json)
    showJson(nlohmann::json{{"well", well}, {"findings", report}}.dump(2, ' ', false,
                                                                       nlohmann::json::error_handler_t::replace) +
             "\n");
  return well ? kDone : kFailed;
}

}  // namespace

void addDoctor(Command& program) {
  auto json = std::make_shared<bool>(false);
  Command command = program.command("doctor", "Say what is missing on this machine and how to get it.");
  command.flag("--json", *json, "Print as JSON.");
  command.footer("Example: swiftlet doctor");
  command.runs([json] { return doctor(*json); });
}

}  // namespace swiftlet::apps
