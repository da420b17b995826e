#include "simulation/nature.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "common/config.hpp"
#include "common/data_paths.hpp"
#include "common/error.hpp"
#include "common/random.hpp"
#include "common/read_bytes.hpp"

namespace swiftlet::simulation {
namespace {

using common::InputError;
using common::Problem;

constexpr std::uint64_t kMostDraws = 200;
constexpr const char* kLeastThrust = "least_thrust_over_weight";
constexpr double kLeastThrustOverWeight = 1.05;

bool isRange(const YAML::Node& node) { return node.IsSequence() && node.size() == 2 && node[0].IsScalar(); }

/// Replaces every range by what `choose(path, low, high)` makes of it.
template <typename Choose>
YAML::Node chosen(const YAML::Node& node, const std::string& path, const Choose& choose) {
  if (isRange(node))
    return YAML::Node(fmt::format("{:.17g}", choose(path, node[0].as<double>(), node[1].as<double>())));
  if (!node.IsMap()) return node;
  YAML::Node result(YAML::NodeType::Map);
  for (const auto& entry : node) {
    const auto key = entry.first.as<std::string>();
    result[key] = chosen(entry.second, path.empty() ? key : path + "." + key, choose);
  }
  return result;
}

void requireNumbersInOrder(const YAML::Node& node, const std::string& path, const std::string& file) {
  if (isRange(node)) {
    double low = 0.0, high = 0.0;
    const bool numbers = YAML::convert<double>::decode(node[0], low) && YAML::convert<double>::decode(node[1], high);
    if (!numbers || !(low <= high))
      throw InputError(Problem{{file, node.Mark().line + 1, node.Mark().column + 1},
                               path,
                               "is not a range [low, high] of two numbers",
                               "the lower number stands first"});
  } else if (node.IsMap()) {
    for (const auto& entry : node) {
      const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "?";
      requireNumbersInOrder(entry.second, path.empty() ? key : path + "." + key, file);
    }
  }
}

/// The same values without the keys that are written, or lie below one that is.
YAML::Node without(const YAML::Node& node, const std::string& path, const std::vector<std::string>& written) {
  if (!node.IsMap()) return node;
  YAML::Node result(YAML::NodeType::Map);
  for (const auto& entry : node) {
    const auto key = entry.first.as<std::string>();
    const std::string at = path.empty() ? key : path + "." + key;
    if (std::find(written.begin(), written.end(), at) == written.end())
      result[key] = without(entry.second, at, written);
  }
  return result;
}

/// A scenario that varies the charge says itself what the charge is.
std::vector<std::string> writtenOf(const Scenario& scenario) {
  std::vector<std::string> written = scenario.written;
  if (std::find(written.begin(), written.end(), "variation.battery_remaining") != written.end())
    written.emplace_back("battery_remaining");
  return written;
}

void readOver(Scenario& scenario, const YAML::Node& values, const std::string& file) {
  common::config::YamlReader::fromText(YAML::Dump(values), file).read(scenario);
}

}  // namespace

struct Nature::Template {
  YAML::Node values;
  double least_thrust_over_weight = kLeastThrustOverWeight;
};

Nature::Nature(std::string name, std::shared_ptr<const Template> values)
    : name_(std::move(name)), template_(std::move(values)) {}

Nature Nature::calm() { return {"calm", nullptr}; }

Nature Nature::load(const std::string& name) {
  namespace fs = std::filesystem;
  const fs::path given(name);
  const fs::path file =
      given.has_extension() ? common::findData(given) : common::findData(fs::path("config/nature") / (name + ".yaml"));
  constexpr std::size_t kMostBytes = std::size_t{1} << 20;
  Nature nature = fromText(common::readBytes(file.string(), kMostBytes), file.string());
  nature.name_ = given.stem().string();
  return nature;
}

Nature Nature::fromText(const std::string& text, const std::string& name) {
  auto made = std::make_shared<Template>();
  try {
    made->values = YAML::Load(text);
    if (const YAML::Node least = made->values[kLeastThrust]) {
      made->least_thrust_over_weight = least.as<double>();
      made->values.remove(kLeastThrust);
    }
  } catch (const YAML::Exception& e) {
    throw InputError(Problem{{name, e.mark.line + 1, e.mark.column + 1}, "", "not YAML: " + e.msg, ""});
  }
  requireNumbersInOrder(made->values, "", name);
  // Both ends of every range are read once, so that a key that does not exist is told now and not in some draw.
  for (const bool low : {true, false}) {
    Scenario scenario;
    readOver(scenario, chosen(made->values, "", [low](const auto&, double a, double b) { return low ? a : b; }), name);
  }
  return {name, made};
}

Scenario Nature::drawOnce(const Scenario& scenario, std::uint64_t seed, std::uint64_t draw) const {
  const auto uniform = [seed, draw](const std::string& path, double low, double high) {
    return common::RandomStream(seed, "nature " + path, draw).uniform(low, high);
  };
  Scenario result = scenario;
  readOver(result, chosen(without(template_->values, "", writtenOf(scenario)), "", uniform), name_);
  return result;
}

Scenario Nature::drawn(const Scenario& scenario, std::uint64_t seed) const {
  if (!template_) return scenario;
  const std::vector<std::string> written = writtenOf(scenario);
  const bool fixed_charge = std::find(written.begin(), written.end(), "battery_remaining") != written.end();
  for (std::uint64_t draw = 0; draw < kMostDraws; ++draw) {
    Scenario result = drawOnce(scenario, seed, draw);
    if (fixed_charge) return result;
    constexpr double kStep = 0.01;
    double& charge = result.battery_remaining;
    const auto flies = [&] {
      return thrustOverWeight(result.vehicle, result.quadrotor, charge, kFullThrottle) >=
             template_->least_thrust_over_weight;
    };
    while (!flies() && charge < 1.0) charge = std::min(1.0, charge + kStep);
    if (flies()) return result;
  }
  throw InputError(Problem{{name_},
                           kLeastThrust,
                           fmt::format("none of {} draws can lift the vehicle `{}`", kMostDraws, scenario.vehicle.name),
                           "draw a lighter vehicle, or more thrust"});
}

}  // namespace swiftlet::simulation
