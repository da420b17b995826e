#include "evaluation/flight_score.hpp"

#include <utility>

#include <fmt/format.h>

#include "common/check.hpp"
#include "evaluation/figures.hpp"

namespace swiftlet::evaluation {
std::string FlightScore::collisionText() const {
  return fmt::format("collision ({}): {}", toString(verdict), collision);
}

std::optional<double>& FlightScore::operator[](std::string_view name) {
  SWIFTLET_CHECK(flightFigure(name).of == nullptr, name);
  return measured.try_emplace(std::string(name)).first->second;
}

std::optional<double> FlightScore::figure(std::string_view name) const {
  if (const auto of = flightFigure(name).of) return of(*this);
  const auto found = measured.find(name);
  return found == measured.end() ? std::nullopt : found->second;
}

std::vector<std::pair<std::string, double>> reportedFigures(const FlightScore& score) {
  using enum FigureGroup;
  std::vector<std::pair<std::string, double>> figures;
  const auto add = [&](std::initializer_list<FigureGroup> groups) {
    for (const FlightFigure* figure : figuresOf(groups)) {
      const auto value = score.figure(figure->name);
      if (value && figure->isNumber()) figures.emplace_back(figure->name, *value);
    }
  };
  add({kGoals, kEstimate, kRawFrame, kMap3d, kCamera, kVisualOdometry, kLocalization, kClearance, kSpace});
  figures.emplace_back("collisions", score.collisions);
  add({kConduct, kHomeEnergy, kLatency, kBehaviors});
  for (const PhaseScore& phase : score.phases)
    for (const auto& [name, figure] : phase.figures) figures.emplace_back(phase.name + "." + name, figure);
  return figures;
}

}  // namespace swiftlet::evaluation
