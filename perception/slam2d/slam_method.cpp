#include "perception/slam2d/slam_method.hpp"

#include <algorithm>
#include <array>

#include "common/check.hpp"
#include "common/config_fields.hpp"
#include "perception/slam2d/slam2d.hpp"

namespace swiftlet::perception {
namespace {

struct NamedMethod {
  const char* name;
  const char* sentence;
};
/// In the order of SlamMethod.
constexpr std::array<NamedMethod, 3> kMethods{{
    {"graph", "key scans with constraints between them, and loop closures."},
    {"particles", "trajectories with a map each."},
    {"scan_to_map", "scans matched to one map, without loop closure."},
}};

}  // namespace

const std::vector<std::string>& slamMethodNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const NamedMethod& method : kMethods) all.emplace_back(method.name);
    return all;
  }();
  return names;
}

std::string slamMethodHelp() {
  std::string help;
  for (const NamedMethod& method : kMethods)
    help += (help.empty() ? "" : " ") + std::string(method.name) + ": " + method.sentence;
  return help;
}

SlamMethod slamMethodOf(const std::string& name) {
  const auto& names = slamMethodNames();
  const auto found = std::find(names.begin(), names.end(), name);
  SWIFTLET_CHECK(found != names.end(), name);
  return static_cast<SlamMethod>(found - names.begin());
}

void SlamMethodConfig::describe(common::config::Fields& fields) {
  fields.choice("method", method, slamMethodNames(), "Which method does the work.");
  Slam2dConfig::describe(fields);
}

std::unique_ptr<PlanarSlam> makeSlam(const SlamMethodConfig& config) {
  switch (config.method) {
    case SlamMethod::kParticles: {
      ParticleSlamConfig particles = config.particles;
      particles.grid = config.grid;
      return std::make_unique<ParticleSlam>(particles);
    }
    case SlamMethod::kScanToMap:
      return std::make_unique<ScanToMapSlam>(config.grid);
    case SlamMethod::kGraph:
      break;
  }
  return std::make_unique<Slam2d>(config);
}

}  // namespace swiftlet::perception
