#include "simulation/nature_ranges.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "common/config.hpp"
#include "common/data_paths.hpp"
#include "common/error.hpp"
#include "common/read_bytes.hpp"
#include "common/yaml_problem.hpp"
#include "simulation/plant_keys.hpp"

namespace swiftlet::simulation {
namespace {

using common::InputError;
using common::Message;
using common::Problem;

constexpr const char* kBasedOn = "based_on";
constexpr const char* kLeastThrust = "least_thrust_over_weight";

/// The keys of a nature's file: the parts of a scenario that are the plant.
struct NatureKeys {
  std::string based_on = {};
  double least_thrust_over_weight = 0.0;
  Scenario scenario;

  void describe(common::config::Fields& fields) {
    fields(kBasedOn, based_on, "Another nature, or a file, of which this one differs in the keys that it names.");
    fields(kLeastThrust, least_thrust_over_weight, {0, 10}, "Thrust over weight that a draw must have.");
    describePlant(scenario, fields);
  }
};

/// The keys of a plant that count something.
std::set<std::string> wholeNumberKeys() {
  std::set<std::string> keys;
  for (PlantKey& one : plantKeys(Scenario{}))
    if (one.whole) keys.insert(std::move(one.key));
  return keys;
}

/// The `]` of the range that begins at `from`, and none in a comment.
std::size_t closeOf(std::string_view text, std::size_t from) {
  for (std::size_t i = from; i < text.size(); ++i) {
    if (text[i] == ']') return i;
    if (text[i] == '#') i = std::min(text.find('\n', i), text.size() - 1);
  }
  return text.size();
}

bool isWhole(double value) { return std::floor(value) == value; }

/// The node below `root` at "quadrotor.battery.capacity_ah", made if it is missing.
YAML::Node nodeAt(const YAML::Node& root, const std::string& key) {
  YAML::Node node = root;
  for (std::size_t begin = 0; begin <= key.size();) {
    const std::size_t end = std::min(key.find('.', begin), key.size());
    YAML::Node next = node[key.substr(begin, end - begin)];
    node.reset(next);
    begin = end + 1;
  }
  return node;
}

/// Whether the key, or a section that it is in, is one of them.
bool isAmong(const std::string& key, const std::vector<std::string>& keys) {
  return std::any_of(keys.begin(), keys.end(),
                     [&](const std::string& one) { return key == one || key.starts_with(one + "."); });
}

}  // namespace

/// Reads the text once into entries and collects what is wrong with ranges.
class NatureRanges::Reader {
 public:
  Reader(const std::string& text, const std::string& file) : text_(text), file_(file) {
    const YAML::Node root = common::loadYaml(text, file);
    if (root.IsMap()) readMap(root, "");
    if (!problems_.empty()) throw InputError(problems_);
  }

  Base base;
  std::vector<Entry> entries;

 private:
  void readMap(const YAML::Node& map, const std::string& prefix) {
    for (const auto& item : map) {
      const std::string key = prefix + (item.first.IsScalar() ? item.first.Scalar() : "?");
      if (key == kBasedOn) {
        readBase(item.second);
        continue;
      }
      if (item.second.IsMap()) readMap(item.second, key + ".");
      if (item.second.IsSequence()) readRange(item.second, key);
      if (item.second.IsScalar()) entries.push_back({.key = key, .value = item.second.Scalar()});
    }
  }

  void readBase(const YAML::Node& node) {
    if (!node.IsScalar() || node.Scalar().empty())
      return report(node, kBasedOn, Message("nature.no-name-of", "is not the name of a nature"),
                    "give calm, real, harsh, or a file");
    base = {node.Scalar(), {file_, node.Mark().line + 1, node.Mark().column + 1}};
  }

  void readRange(const YAML::Node& node, const std::string& key) {
    Entry entry{.key = key, .value = {}, .whole = whole_.contains(key)};
    const auto number = [](const YAML::Node& end, double& value) {
      return end.IsScalar() && YAML::convert<double>::decode(end, value) && std::isfinite(value);
    };
    entry.from = static_cast<std::size_t>(node.Mark().pos);
    const std::size_t close = closeOf(text_, entry.from);
    if (text_[entry.from] == '&')
      return report(node, key, Message("nature.anchor", "is a range with an anchor"),
                    "write the range out as [low, high], without anchors");
    if (node.size() != 2 || !number(node[0], entry.low) || !number(node[1], entry.high) || text_[entry.from] != '[')
      return report(node, key, Message("nature.no-range", "is not a range [low, high] of two numbers"),
                    "a range is drawn from uniformly");
    if (entry.low > entry.high)
      return report(node, key, Message("nature.upside-down", "is upside down: {} is above {}", entry.low, entry.high),
                    "the lower number stands first");
    if (entry.whole && !(isWhole(entry.low) && isWhole(entry.high)))
      return report(node, key, Message("nature.not-whole", "is not a range of two whole numbers"), "");
    entry.size = close + 1 - entry.from;
    entries.push_back(entry);
  }

  void report(const YAML::Node& node, const std::string& key, Message message, const char* hint) {
    problems_.push_back({{file_, node.Mark().line + 1, node.Mark().column + 1}, key, std::move(message), hint});
  }

  const std::string& text_;
  std::string file_;
  std::set<std::string> whole_ = wholeNumberKeys();
  std::vector<Problem> problems_;
};

/// The number, and behind it the blanks and lines that keep what follows in its place.
std::string NatureRanges::inPlaceOf(const Entry& entry, std::string_view text, const std::string& number) {
  const std::string_view range = text.substr(entry.from, entry.size);
  const auto lines = static_cast<std::size_t>(std::count(range.begin(), range.end(), '\n'));
  return lines > 0 ? number + std::string(lines, '\n') : fmt::format("{:<{}}", number, entry.size);
}

std::string NatureRanges::Entry::drawn(const Choose& choose) const {
  if (!isRange()) return value;
  if (whole) return fmt::format("{}", std::min(high, std::floor(choose(key, low, high + 1.0))));
  return fmt::format("{}", choose(key, low, high));
}

NatureRanges::NatureRanges(const std::string& given, const std::string& file, std::vector<std::string> chain)
    : file_(file) {
  const std::string text = common::yamlText(given);
  Reader reader(text, file);
  chain.push_back(file);
  if (!reader.base.name.empty()) readBase(reader.base, std::move(chain));
  check(text, reader.entries);
  merge(std::move(reader.entries));
}

void NatureRanges::readBase(const Base& base, std::vector<std::string> chain) {
  std::filesystem::path file;
  try {
    file = fileOf(base.name, std::filesystem::path(file_).parent_path());
  } catch (const InputError& missing) {
    const Problem& problem = missing.problems().front();
    throw InputError(base.place, kBasedOn, problem.message.behind(base.name + ": "), problem.hint);
  }
  // One file may be named in many ways, `a.yaml` and `./a.yaml`.
  std::error_code error;
  if (std::any_of(chain.begin(), chain.end(),
                  [&](const std::string& above) { return std::filesystem::equivalent(above, file, error); }))
    throw InputError(base.place, kBasedOn, Message("nature.circle", "{} is based on this nature itself", base.name),
                     "name another one, or leave based_on out");
  const NatureRanges read(textOf(file), file.string(), std::move(chain));
  entries_ = read.entries_;
  least_thrust_over_weight_ = read.least_thrust_over_weight_;
}

/// Reads the file with the lower and with the upper end of each range in its place, over those of the base, so that
/// every mistake is reported now, with its line, and not in some draw.
void NatureRanges::check(const std::string& text, const std::vector<Entry>& own) {
  NatureKeys keys;
  for (const bool low : {true, false}) {
    const auto end_of = [low](const std::string&, double a, double b) { return low ? a : b; };
    std::string with_numbers = text;
    for (auto entry = own.rbegin(); entry != own.rend(); ++entry)  // From behind, so that places stay.
      if (entry->isRange())
        with_numbers.replace(entry->from, entry->size, inPlaceOf(*entry, text, entry->drawn(end_of)));
    keys = {.least_thrust_over_weight = least_thrust_over_weight_, .scenario = {}};
    apply(keys.scenario, {}, end_of);
    common::config::YamlReader::fromText(with_numbers, file_).read(keys);
  }
  least_thrust_over_weight_ = keys.least_thrust_over_weight;
}

/// Its own keys replace those of the base.
void NatureRanges::merge(std::vector<Entry> own) {
  for (Entry& entry : own) {
    if (entry.key == kLeastThrust) continue;
    const auto same =
        std::find_if(entries_.begin(), entries_.end(), [&](const Entry& one) { return one.key == entry.key; });
    if (same == entries_.end())
      entries_.push_back(std::move(entry));
    else
      *same = std::move(entry);
  }
}

std::filesystem::path NatureRanges::fileOf(const std::filesystem::path& name, const std::filesystem::path& folder) {
  if (!name.has_extension())
    return common::findData(std::filesystem::path("config/nature") / (name.string() + ".yaml"));
  return folder.empty() ? common::findData(name) : common::findBeside(folder, name);
}

std::string NatureRanges::textOf(const std::filesystem::path& file) {
  constexpr std::size_t kMostBytes = std::size_t{1} << 20;
  return common::readText(file.string(), kMostBytes);
}

bool NatureRanges::has(const std::string& key) const {
  return std::any_of(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.key == key; });
}

void NatureRanges::narrow(const std::string& key, double low, double high) {
  for (Entry& entry : entries_) {
    if (entry.key != key || !entry.isRange()) continue;
    entry.low = low;
    entry.high = high;
  }
}

std::optional<NatureRange> NatureRanges::rangeOf(const std::string& key) const {
  for (const Entry& entry : entries_) {
    if (entry.key != key) continue;
    if (entry.isRange()) return NatureRange{entry.low, entry.high};
    double value = 0.0;
    if (YAML::convert<double>::decode(YAML::Node(entry.value), value)) return NatureRange{value, value};
  }
  return std::nullopt;
}

void NatureRanges::apply(Scenario& scenario, const std::vector<std::string>& written, const Choose& choose) const {
  YAML::Node values(YAML::NodeType::Map);
  for (const Entry& entry : entries_)
    if (!isAmong(entry.key, written)) nodeAt(values, entry.key) = entry.drawn(choose);
  NatureKeys keys{.scenario = std::move(scenario)};
  common::config::YamlReader::fromText(YAML::Dump(values), file_).read(keys);
  scenario = std::move(keys.scenario);
}

std::string NatureRanges::valuesIn(const Scenario& scenario) const {
  using common::config::YamlPrinter;
  const YAML::Node all = YAML::Load(YamlPrinter(YamlPrinter::Comments::kNo).print(NatureKeys{.scenario = scenario}));
  YAML::Node values(YAML::NodeType::Map);
  for (const Entry& entry : entries_) nodeAt(values, entry.key) = nodeAt(all, entry.key).Scalar();
  return YAML::Dump(values) + "\n";
}

}  // namespace swiftlet::simulation
