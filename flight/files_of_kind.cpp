#include "flight/files_of_kind.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "common/data_paths.hpp"
#include "common/error.hpp"
#include "common/lower_case.hpp"
#include "common/read_bytes.hpp"
#include "common/yaml_problem.hpp"
#include "interfaces/files/text_file.hpp"

namespace swiftlet::flight {
namespace fs = std::filesystem;

namespace {

/// What a file is for, and the words of the command line that use it.
struct Use {
  std::string what, hint;
};

/// Of a YAML file by the keys at its top: trials, maps and profiles end alike.
Use useOfYaml(const std::string& name, const fs::path& file) {
  const std::string text = common::yamlText(common::readBytes(file, common::kMostYamlBytes));
  const std::vector<std::string_view> lines = common::linesOf(text);
  const auto has = [&](std::string_view key) {
    return std::any_of(lines.begin(), lines.end(), [&](std::string_view line) { return line.starts_with(key); });
  };
  if (has("scenario:") || has("mission:") || has("criteria:"))
    return {"a trial", "`swiftlet trial " + name + "` flies a trial"};
  if (has("image:")) return {"a map", "`--map " + name + "` gives a map"};
  if (has("quadrotor:") || has("sensors:") || has("least_thrust_over_weight:"))
    return {"a nature", "`--nature " + name + "` flies in a nature"};
  if (has("based_on:") || has("vehicle:") || has("laser:") || has("autonomy:"))
    return {"a profile",
            "`--system " + name + "` flies with a profile, and `swiftlet config --system " + name + "` shows it"};
  return {"", ""};
}

Use useOf(const std::string& name, const fs::path& file) {
  const std::string ending = common::endingOf(file);
  if (ending == ".yaml" || ending == ".yml") return useOfYaml(name, file);
  constexpr std::size_t kTopBytes = std::size_t{1} << 16;
  const bool is_xml = ending == ".xml";
  if (ending == ".sdf" || ending == ".world" || (is_xml && interfaces::saysAtStart(file, "<sdf", kTopBytes)))
    return {"a world", "`swiftlet fly MISSION.xml --world " + name + "` flies in a world"};
  if (is_xml) return {"a mission", "`swiftlet fly " + name + "` flies a mission"};
  return {"", ""};
}

/// `folder` is where those of its kind are, and `ending` that of their names.
struct Kind {
  const char *what, *folder, *ending, *format;
};
constexpr Kind kMission{"a mission", "missions", ".xml", "an XML file"};
constexpr Kind kTrial{"a trial", "trials", ".yaml", "a YAML file"};
constexpr std::array kOtherKinds{Kind{"a world", "worlds", ".sdf", "a file of SDF"},
                                 Kind{"a map", "", ".yaml", "a YAML file of map_server"},
                                 Kind{"a profile", "config/systems", ".yaml", "a YAML file"}};

void refuseOtherUse(const std::string& name, const Use& use, const Kind& kind) {
  if (use.what.empty() || use.what == kind.what) return;
  throw common::InputError(
      {name}, "",
      common::Message("file.other-use", "is {}, and no {}, which is {}", use.what, kind.what + 2, kind.format),
      use.hint);
}

fs::path findNamed(const std::string& name, const Kind& kind) {
  try {
    return common::findData(name);
  } catch (const common::InputError& missing) {
    common::Problem problem = missing.problems().front();
    if (name.empty() || !problem.hint.empty() || fs::path(name).has_parent_path()) throw;
    const fs::path whole = fs::path(kind.folder) / fs::path(name).replace_extension(kind.ending);
    try {
      (void)common::findData(whole);
      problem.hint = fmt::format("did you mean `{}`?", whole.string());
    } catch (const common::InputError& other) {
      problem.hint = other.problems().front().hint;
    }
    throw common::InputError(problem);
  }
}

std::string findOfKind(const std::string& name, const Kind& kind) {
  const fs::path file = findNamed(name, kind);
  const Use use = fs::is_directory(file) ? Use() : useOf(name, file);
  refuseOtherUse(name, use, kind);
  const std::string ending = common::endingOf(file);
  if (use.what.empty() && ending != kind.ending && !fs::is_directory(file) && (ending == ".yaml" || ending == ".yml"))
    throw common::InputError({name}, "",
                             common::Message("file.not-of-kind", "is no {}, which is {}", kind.what + 2, kind.format));
  return file.string();
}

}  // namespace

std::string findMission(const std::string& name) {
  std::string file = findOfKind(name, kMission);
  if (fs::is_directory(file)) refuseOtherUse(name, {"a folder", "name a file of it"}, kMission);
  return file;
}

void refuseOtherKind(const std::string& file, std::string_view what) {
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return;  // Its reader reports it.
  const Use use = useOf(file, file);
  for (const Kind& kind : kOtherKinds)
    if (kind.what == what) refuseOtherUse(file, use, kind);
}

std::string findTrial(const std::string& name) { return findOfKind(name, kTrial); }

}  // namespace swiftlet::flight
